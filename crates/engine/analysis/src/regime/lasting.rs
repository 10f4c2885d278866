//! Does a closed curve of returns keep its size?
//!
//! A torus lasts. Beside an unstable torus, and where two tori have just vanished, an orbit stays for
//! thousands of turns on a curve that is closed, dense and without chaos, and that slowly changes: by less
//! than a hundredth from look to look. What tells the two apart is the trend of mean values over time. On a
//! torus those of a smooth function, smoothly weighted, converge faster than any power of the time; those of
//! returns need not, for the number of extremes per turn may change along the torus.

use super::case::Case;
use super::chaos::stated;
use super::look::Look;
use super::returns;
use super::verdict::Verdict;
use super::words::lasting;
use crate::Estimate;
use crate::gauge::Gauge;
use motiform_dynamics::drive::drive;
use motiform_dynamics::{Request, Sink};

/// Parts of a run whose mean values are compared.
const PARTS: usize = 8;

/// 99.5 % quantile of Student's t with `PARTS - 2` degrees of freedom: a trend beyond so many of its standard errors is one.
const ERRORS: f64 = 3.707;

/// Samples per return,
const SAMPLES: f64 = 32.0;
/// and most samples in all.
const MOST_SAMPLES: f64 = 1e6;

/// Change, against the size of the curve, that a torus shows at most in a run, error included: the nearest
/// that an orbit may be, by chance, to an unstable torus without being seen to leave. Beside a resonance
/// means over a part are off by several times as much, until parts are longer.
const CHANGE: f64 = 1e-3;

/// Change that counts as none: the last of an exponential approach.
const NONE: f64 = 1e-5;

/// The relative change of the size of a curve of returns in a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Change {
    /// The trend, and its 99 % error.
    value: f64,
    error: f64,
    /// Length of the run.
    time: f64,
}

impl Change {
    /// Over a run from `shape` that is as long as the look; `None` where it ends early, or has too few
    /// returns. The width of the returns is that of the look.
    pub(super) fn along(case: Case<'_>, shape: &[f64], look: &Look) -> Option<Self> {
        let minima = look.minima();
        let time = look.end - look.start;
        let every = time / (SAMPLES * minima.len() as f64).min(MOST_SAMPLES);
        let mut orbit = case.orbit(shape).ok()?;
        let request = Request { sample_every: Some(every), ..case.request(time) };
        let mut sizes = Sizes { gauge: Gauge::of(case.body), values: Vec::new() };
        let outcome = drive(orbit.as_mut(), &request, &mut sizes).ok()?;
        outcome.is_complete().then(|| Self::of(&sizes.values, returns::width(&minima), time)).flatten()
    }

    /// From sizes at equal intervals over `time`. They have the variance `base + width^2`, and the base is
    /// the same on all curves around one orbit: the change of the width is that of the variance divided by
    /// `2 width^2`.
    fn of(sizes: &[f64], width: f64, time: f64) -> Option<Self> {
        let length = sizes.len() / PARTS;
        if length < 2 {
            return None;
        }
        let variances: Vec<f64> = sizes.chunks_exact(length).take(PARTS).map(variance).collect();
        let (trend, error) = trend(&variances);
        let scale = PARTS as f64 / (2.0 * width * width);
        let change = Self { value: trend * scale, error: ERRORS * error * scale, time };
        (change.value.is_finite() && change.error.is_finite()).then_some(change)
    }

    /// The verdict on a torus with this evidence beside the other, or what is missing.
    pub(super) fn judges(&self, mut torus: Verdict) -> Result<Verdict, String> {
        let Self { value, error, time } = *self;
        let most = value.abs() + error;
        let change = stated(Estimate { value, error });
        let said = format!("changes by {change} of itself in a time of {}", lasting(time));
        if value.abs() > error.max(NONE) || most > CHANGE {
            return Err(format!("the returns lie on a closed curve whose size {said}: no torus was shown"));
        }
        torus.why = format!("{}, whose size {said}", torus.why);
        torus.margin = torus.margin.map(|margin| margin.min(CHANGE / most.max(NONE)));
        Ok(torus)
    }
}

/// The variance of a part of the sizes.
///
/// Means are weighted by `exp(-1/(x (1 - x)))`, x from 0 to 1 along the part: on a torus they converge faster
/// than any power of the number of samples, plain ones as 1/n.
///
/// Source: Das, Saiki, Sander and Yorke (2017), Nonlinearity 30, 4111.
fn variance(part: &[f64]) -> f64 {
    let count = part.len() as f64;
    let weight = |i: usize| {
        let x = (i as f64 + 0.5) / count;
        libm::exp(-1.0 / (x * (1.0 - x)))
    };
    let weights: Vec<f64> = (0..part.len()).map(weight).collect();
    let sum: f64 = weights.iter().sum();
    let mean = part.iter().zip(&weights).map(|(size, weight)| weight * size).sum::<f64>() / sum;
    let squares = part.iter().zip(&weights).map(|(size, weight)| weight * (size - mean) * (size - mean));
    squares.sum::<f64>() / sum
}

/// The slope of a line through these values at 0, 1, 2 .., with its standard error.
fn trend(values: &[f64]) -> (f64, f64) {
    let count = values.len() as f64;
    let middle = 0.5 * (count - 1.0);
    let mean = values.iter().sum::<f64>() / count;
    let points = || values.iter().enumerate().map(|(i, value)| (i as f64 - middle, value - mean));
    let width: f64 = points().map(|(x, _)| x * x).sum();
    let slope = points().map(|(x, y)| x * y).sum::<f64>() / width;
    let rest: f64 = points().map(|(x, y)| (y - slope * x) * (y - slope * x)).sum();
    (slope, libm::sqrt(rest / (count - 2.0) / width))
}

/// Samples of the size that returns are watched by.
struct Sizes {
    gauge: Gauge,
    values: Vec<f64>,
}

impl Sink for Sizes {
    fn sample(&mut self, _t: f64, u: &[f64]) {
        self.values.push(self.gauge.size(u));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line has its slope without an error; what is off it has one.
    #[test]
    fn trends_are_those_of_lines() {
        let (slope, error) = trend(&[1.0, 3.0, 5.0, 7.0]);
        assert!((slope - 2.0).abs() < 1e-14 && error < 1e-14, "{slope} {error}");
        let (slope, error) = trend(&[0.0, 1.0, 0.0, 1.0]);
        assert!(
            (slope - 0.2).abs() < 1e-14 && (error - libm::sqrt(0.8 / 2.0 / 5.0)).abs() < 1e-14,
            "{slope} {error}"
        );
    }

    /// Two oscillations: a width that grows by a thousandth is seen, and one that stays is exact to 1e-6.
    #[test]
    fn a_width_that_changes_is_seen() {
        for growth in [0.0, 1e-3, -1e-2] {
            let size = |i: u32| {
                let x = f64::from(i) / 5e4;
                let width = libm::exp(growth * x);
                let t = 1e4 * x;
                2.0 * libm::sin(t) + width * libm::sin(0.5 * (1.0 + libm::sqrt(5.0)) * t)
            };
            let sizes: Vec<f64> = (0..50_000).map(size).collect();
            let change = Change::of(&sizes, libm::sqrt(0.5), 1e4).expect("enough samples");
            let off = (change.value - growth).abs();
            assert!(off < 1e-6 + 0.01 * growth.abs() && change.error < 1e-4, "{growth}: {change:?}");
        }
    }
}
