//! Repetitions of shape and motion, with rotations and the mirror divided out.

use super::measures::{Measures, Series, mean, scatter};
use serde::Serialize;

/// Correlation after one period, and after two, of a motion that repeats.
const LIKE: [f64; 2] = [0.75, 0.5];
/// Largest share of turns above a right angle within one step: beyond it the heading is not resolved.
const UNRESOLVED: f64 = 0.02;
/// Longest period, as a part of the record.
const LONGEST: f64 = 0.4;

/// Least likeness and largest scatter of the amplitude of a motion that is regular within its errors.
const REGULAR: (f64, f64) = (0.99, 0.02);
/// Fewest memories of a record, and largest scatter of the amplitude, of an oscillation that sustains itself under noise.
const MEMORIES: f64 = 8.0;
const MOST_SCATTER: f64 = 0.25;

/// The repetition of a motion after a period, with how alike two periods are.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Repeats {
    /// Its period (unit of time).
    pub period: f64,
    /// The number seen.
    pub periods: f64,
    /// Correlation of the invariants with themselves one period later.
    pub likeness: f64,
    /// Mean rotation of the heading per period (rad), and its standard error.
    pub rotation: f64,
    /// See `rotation`.
    pub rotation_error: f64,
    /// Scatter of the amplitude from period to period, relative to its mean.
    #[serde(skip)]
    scatter: f64,
    /// Duration of the record over the time in which the likeness decays by a factor e.
    #[serde(skip)]
    memories: f64,
}

impl Repeats {
    /// The shortest period after which all invariants are alike; `None` without one.
    pub(super) fn of(measures: &Measures) -> Option<Self> {
        let series = &measures.series;
        let invariants = invariants(series);
        let count = invariants.first()?.len();
        let most = (LONGEST * count as f64) as usize;
        let like: Vec<f64> = (0..=most).map(|lag| likeness(&invariants, lag)).collect();
        let fallen = like.iter().position(|&value| value < 0.5)?;
        let peak = (fallen + 1..most)
            .filter(|&lag| like[lag] >= like[lag - 1] && like[lag] >= like[lag + 1] && like[lag] > LIKE[0]);
        let lag = peak.min()?;
        if 2 * lag < most && like[2 * lag - 1..=2 * lag + 1].iter().copied().fold(0.0, f64::max) < LIKE[1] {
            return None;
        }
        let turned: Vec<f64> = series.headings.windows(lag + 1).map(|pair| pair[lag] - pair[0]).collect();
        let sharp =
            series.headings.windows(2).filter(|pair| (pair[1] - pair[0]).abs() > std::f64::consts::FRAC_PI_2);
        if sharp.count() as f64 > UNRESOLVED * count as f64 {
            return None;
        }
        let independent = (count as f64 / lag as f64).max(1.0);
        Some(Self {
            period: lag as f64 * series.dt,
            periods: independent,
            likeness: like[lag],
            rotation: mean(turned.iter().copied()),
            rotation_error: scatter(&turned) / independent.sqrt(),
            scatter: amplitude_scatter(&invariants, lag),
            memories: memories(&like, lag) * independent,
        })
    }

    /// `true` if the oscillation sustains itself: it is regular within the errors, or keeps its amplitude for many times longer than its
    /// phase. One that noise sustains about a steady motion forgets both alike: then the amplitude scatters by half of its mean.
    pub(super) fn is_sustained(&self) -> bool {
        let regular = self.likeness >= REGULAR.0 && self.scatter <= REGULAR.1;
        regular || (self.memories >= MEMORIES && self.scatter <= MOST_SCATTER)
    }
}

/// Standard deviation of the root mean square of all series over a period, relative to its mean.
fn amplitude_scatter(series: &[Vec<f64>], lag: usize) -> f64 {
    let square = |period: usize| -> f64 {
        series.iter().flat_map(|one| &one[period * lag..(period + 1) * lag]).map(|value| value * value).sum()
    };
    let count = series.first().map_or(0, |one| one.len() / lag);
    let sizes: Vec<f64> = (0..count).map(|period| square(period).sqrt()).collect();
    scatter(&sizes) / mean(sizes.iter().copied()).max(f64::MIN_POSITIVE)
}

/// Logarithm of the ratio of the likeness after one period to that after two, near their lags: errors of the samples lower both alike.
fn memories(like: &[f64], lag: usize) -> f64 {
    let near = |lag: usize| {
        let within = lag - lag.div_ceil(8)..=(lag + lag.div_ceil(8)).min(like.len() - 1);
        like[within].iter().copied().fold(f64::MIN_POSITIVE, f64::max)
    };
    if 2 * lag < like.len() { libm::log(near(lag) / near(2 * lag)).max(0.0) } else { 0.0 }
}

/// Invariants of rotations: speed, |z2|, and z2 against the direction of motion, along and across (which the mirror reverses).
fn invariants(series: &Series) -> Vec<Vec<f64>> {
    let (mut along, mut across, mut size) = (Vec::new(), Vec::new(), Vec::new());
    let half = series.lag / 2;
    let (before, after) = (&series.frames[half..], &series.frames[series.lag - half..]);
    for ((a, b), heading) in before.iter().zip(after).zip(&series.headings) {
        // z2 is turned by -2 angle: multiplied with exp(2 i heading) it is that of a body that moves along x
        let (sin, cos) = (libm::sin(2.0 * heading), libm::cos(2.0 * heading));
        // at the middle of the displacement, so that the record played backwards has the same series
        let (re, im) = (0.5 * (a.y[2] + b.y[2]), 0.5 * (a.y[3] + b.y[3]));
        along.push(re * cos - im * sin);
        across.push(re * sin + im * cos);
        size.push(libm::hypot(re, im));
    }
    vec![series.speeds.clone(), size, along, across]
        .into_iter()
        .map(|s| standard(&s))
        .filter(|s| !s.is_empty())
        .collect()
}

/// A series of mean 0, with its own weight: its variance relative to its mean square.
fn standard(series: &[f64]) -> Vec<f64> {
    let centre = mean(series.iter().copied());
    let unit = mean(series.iter().map(|value| value * value)).sqrt();
    if unit == 0.0 { Vec::new() } else { series.iter().map(|value| (value - centre) / unit).collect() }
}

/// Correlation of all series with themselves `lag` later, together.
fn likeness(series: &[Vec<f64>], lag: usize) -> f64 {
    let mut sums = [0.0; 3];
    for one in series {
        for (a, b) in one.iter().zip(&one[lag..]) {
            sums = [sums[0] + a * b, sums[1] + a * a, sums[2] + b * b];
        }
    }
    let unit = (sums[1] * sums[2]).sqrt();
    if unit > 0.0 { sums[0] / unit } else { 0.0 }
}
