//! The statistics that are compared: curves over lags, and distributions as quantiles.
//!
//! Plain sums over the frames that are there, gaps included: the scatter between simulated cells takes the place of the intervals that
//! `motiform_statistics` computes for records without gaps.

use super::record::Record;
use crate::observe::step_of;
use motiform_dynamics::order::ascending;
use motiform_inference::Track;
use serde::{Deserialize, Serialize};

/// Lags per decade.
const PER_DECADE: f64 = 10.0;
/// The longest lag, as a part of the record.
const LONGEST: f64 = 0.25;
/// Lags on both sides of the correlation of shape and motion.
const SIDE: usize = 12;
/// Quantiles of distributions (%).
const QUANTILES: [f64; 9] = [5.0, 10.0, 20.0, 35.0, 50.0, 65.0, 80.0, 90.0, 95.0];

/// The variable that a statistic runs over.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// Lags, in units of time.
    Lag,
    /// Shares of the samples, in %: the values are quantiles.
    Share,
}

/// The statistics. Definitions: docs/cells.md.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// Mean-square displacement; errors of measurement are in it (length^2).
    Displacement,
    /// Autocorrelation of the velocity.
    Velocity,
    /// Autocorrelation of z2.
    SecondMode,
    /// Autocorrelation of z3, of models with z3.
    ThirdMode,
    /// Autocorrelation of z4, of models with z4.
    FourthMode,
    /// Elongation along (1) or across (-1) the motion, at times before or after it.
    Elongation,
    /// Quantiles of the speed (length/time).
    Speed,
    /// Quantiles of the turning angle (rad).
    Turning,
    /// Quantiles of |z2| (length).
    SecondSize,
    /// Quantiles of |z3| (length), of models with z3.
    ThirdSize,
    /// Quantiles of |z4| (length), of models with z4.
    FourthSize,
}

impl Kind {
    /// Its name in results and on pages.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Displacement => "mean-square displacement",
            Self::Velocity => "autocorrelation of the velocity",
            Self::SecondMode => "autocorrelation of z2",
            Self::ThirdMode => "autocorrelation of z3",
            Self::FourthMode => "autocorrelation of z4",
            Self::Elongation => "elongation along the motion",
            Self::Speed => "speed",
            Self::Turning => "turning angle",
            Self::SecondSize => "size of z2",
            Self::ThirdSize => "size of z3",
            Self::FourthSize => "size of z4",
        }
    }

    /// The variable that it runs over.
    #[must_use]
    pub fn axis(self) -> Axis {
        match self {
            Self::Displacement
            | Self::Velocity
            | Self::SecondMode
            | Self::ThirdMode
            | Self::FourthMode
            | Self::Elongation => Axis::Lag,
            Self::Speed | Self::Turning | Self::SecondSize | Self::ThirdSize | Self::FourthSize => {
                Axis::Share
            }
        }
    }
}

/// A statistic of a record.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Statistic {
    /// Which one.
    pub kind: Kind,
    /// Places on its axis.
    pub at: Vec<f64>,
    /// Its values there.
    pub values: Vec<f64>,
}

/// The lags that are asked of all records of a cell, in frames.
pub(super) struct Asked {
    lags: Vec<usize>,
    /// Frames over which displacements are taken, so that the observed cell's headings are clear.
    step: usize,
    dt: f64,
}

impl Asked {
    pub(super) fn of(observed: &Record, track: &Track) -> Self {
        let longest = (LONGEST * observed.frames.len() as f64) as usize;
        let ratio = libm::pow(10.0, 1.0 / PER_DECADE);
        let mut lags = vec![1];
        while let Some(&last) = lags.last().filter(|last| **last < longest) {
            lags.push(((last as f64 * ratio).round() as usize).max(last + 1).min(longest));
        }
        Self { lags, step: step_of(&track.0), dt: observed.dt }
    }

    /// All statistics of a record, always in the same order and at the same places.
    pub(super) fn all(&self, record: &Record) -> Vec<Statistic> {
        let moves = Moves::of(record, self.step);
        let shape = |at: usize| {
            let sizes = record.frames.iter().flatten().map(move |y| libm::hypot(y[at], y[at + 1]));
            sizes.collect::<Vec<f64>>()
        };
        let part = |y: &Vec<f64>, at: usize| [y[at], y[at + 1]];
        let mode = |at: usize| {
            let parts = record.frames.iter().map(|y| y.as_ref().map(|y| part(y, at)));
            parts.collect::<Vec<_>>()
        };
        let second = mode(2);
        let speeds: Vec<f64> = moves.0.iter().flatten().map(|v| libm::hypot(v[0], v[1])).collect();
        let mut all = vec![
            self.over_lags(Kind::Displacement, |lag| square(record, lag)),
            self.over_lags(Kind::Velocity, |lag| correlation(&moves.0, lag)),
            self.over_lags(Kind::SecondMode, |lag| correlation(&second, lag)),
            self.alignment(&moves, &second),
            quantiles(Kind::Speed, speeds),
            quantiles(Kind::Turning, moves.turns(self.step)),
            quantiles(Kind::SecondSize, shape(2)),
        ];
        if record.modes() > 2 {
            let third = mode(4);
            all.push(self.over_lags(Kind::ThirdMode, |lag| correlation(&third, lag)));
            all.push(quantiles(Kind::ThirdSize, shape(4)));
        }
        if record.modes() > 3 {
            let fourth = mode(6);
            all.push(self.over_lags(Kind::FourthMode, |lag| correlation(&fourth, lag)));
            all.push(quantiles(Kind::FourthSize, shape(6)));
        }
        all
    }

    fn over_lags(&self, kind: Kind, value: impl Fn(usize) -> f64) -> Statistic {
        let at = self.lags.iter().map(|&lag| lag as f64 * self.dt).collect();
        Statistic { kind, at, values: self.lags.iter().map(|&lag| value(lag)).collect() }
    }

    /// `<Re z2(t + lag) exp(2 i heading(t))> / <|z2|>`: whether, and how long before or after, the body is elongated along (1) or across
    /// (-1) its motion.
    fn alignment(&self, moves: &Moves, shape: &[Option<[f64; 2]>]) -> Statistic {
        let side = SIDE.min(shape.len() / 8).cast_signed();
        let size = mean(shape.iter().flatten().map(|z| libm::hypot(z[0], z[1])));
        let value = |lag: isize| {
            let pairs = (0..moves.0.len()).filter_map(|at| {
                // the middle of the displacement
                let place = at.checked_add_signed(lag)? + self.step / 2;
                Some((moves.0[at]?, (*shape.get(place)?)?))
            });
            mean(pairs.map(|(v, z)| {
                let square = (v[0] * v[0] + v[1] * v[1]).max(f64::MIN_POSITIVE);
                let double = [(v[0] * v[0] - v[1] * v[1]) / square, 2.0 * v[0] * v[1] / square];
                z[0] * double[0] - z[1] * double[1]
            })) / size
        };
        let lags: Vec<isize> = (-side..=side).collect();
        let at = lags.iter().map(|&lag| lag as f64 * self.dt).collect();
        let values = lags.into_iter().map(value).collect();
        Statistic { kind: Kind::Elongation, at, values }
    }
}

fn quantiles(kind: Kind, mut samples: Vec<f64>) -> Statistic {
    ascending(&mut samples);
    let quantile = |share: &f64| {
        let place = (share / 100.0 * samples.len() as f64) as usize;
        samples.get(place.min(samples.len().saturating_sub(1))).copied().unwrap_or(f64::NAN)
    };
    let values = QUANTILES.iter().map(quantile).collect();
    Statistic { kind, at: QUANTILES.to_vec(), values }
}

/// Velocities by displacements over some frames, from each frame on.
struct Moves(Vec<Option<[f64; 2]>>);

impl Moves {
    fn of(record: &Record, step: usize) -> Self {
        let time = step as f64 * record.dt;
        let later = record.frames.get(step..).unwrap_or_default();
        let velocity = |(a, b): (&Option<Vec<f64>>, &Option<Vec<f64>>)| {
            let (a, b) = (a.as_ref()?, b.as_ref()?);
            Some([(b[0] - a[0]) / time, (b[1] - a[1]) / time])
        };
        Self(record.frames.iter().zip(later).map(velocity).collect())
    }

    /// Angles between displacements that follow one another (rad, positive anticlockwise).
    fn turns(&self, step: usize) -> Vec<f64> {
        let later = self.0.get(step..).unwrap_or_default();
        let angle = |(a, b): (&Option<[f64; 2]>, &Option<[f64; 2]>)| {
            let (a, b) = ((*a)?, (*b)?);
            Some(libm::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]))
        };
        self.0.iter().zip(later).filter_map(angle).collect()
    }
}

/// Mean-square displacement; its errors are in it.
fn square(record: &Record, lag: usize) -> f64 {
    mean(record.pairs(lag).map(|(a, b)| {
        let [x, y] = [b[0] - a[0], b[1] - a[1]];
        x * x + y * y
    }))
}

/// `<a(t) . a(t + lag)> / <a^2>`.
fn correlation(series: &[Option<[f64; 2]>], lag: usize) -> f64 {
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let later = series.get(lag..).unwrap_or_default();
    let pairs = series.iter().zip(later).filter_map(|(a, b)| Some(dot((*a)?, (*b)?)));
    mean(pairs) / mean(series.iter().flatten().map(|a| dot(*a, *a)))
}

/// Mean; NaN of nothing.
fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0_usize), |(sum, count), value| (sum + value, count + 1));
    sum / count as f64
}
