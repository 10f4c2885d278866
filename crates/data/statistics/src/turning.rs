//! Angles between successive displacements.

use crate::Tracks;
use crate::distribution::{Histogram, histogram};
use std::f64::consts::PI;

/// Bins of 10 degrees.
const BINS: usize = 36;

/// Turning angles at one lag.
#[derive(Debug, Clone, PartialEq)]
pub struct Turning {
    /// The lag (model time).
    pub lag: f64,
    /// Their histogram from -pi to pi (rad), positive anticlockwise.
    pub angles: Histogram,
    /// Pairs left out since one of the displacements is 0.
    pub at_rest: usize,
}

/// The distribution of the angle from r(t + tau) - r(t) to r(t + 2 tau) - r(t + tau), at three lags tau: one
/// sample, an eighth of the longest unit, and their geometric mean. Times t follow one another at tau/2 at
/// least, one sample at most: closer ones tell nothing new.
///
/// # Checked by  tests/all/distributions.rs: circle, Brownian motion (uniform)
pub fn turning_angles(tracks: &Tracks) -> Vec<Turning> {
    let longest = (tracks.longest_lag() / 4).max(1);
    let between = (longest as f64).sqrt().round() as usize;
    let mut lags = vec![1, between, longest];
    lags.dedup();
    lags.into_iter().map(|lag| at_lag(tracks, lag)).collect()
}

fn at_lag(tracks: &Tracks, lag: usize) -> Turning {
    let (mut samples, mut at_rest) = (Vec::new(), 0);
    for (unit, track) in tracks.units().iter().enumerate() {
        for window in track.position.windows(2 * lag + 1).step_by((lag / 2).max(1)) {
            match angle([window[0], window[lag], window[2 * lag]]) {
                Some(angle) if angle.is_nan() => {} // one of them is missing
                Some(angle) => samples.push((tracks.group(unit), angle)),
                None => at_rest += 1,
            }
        }
    }
    let angles = histogram(&samples, tracks.groups(), (-PI, PI), BINS);
    Turning { lag: lag as f64 * tracks.dt(), angles, at_rest }
}

/// The angle between both steps; `None` if one of them is 0.
fn angle([a, b, c]: [[f64; 2]; 3]) -> Option<f64> {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - b[0], c[1] - b[1]]);
    let (dot, cross) = (u[0] * v[0] + u[1] * v[1], u[0] * v[1] - u[1] * v[0]);
    (dot != 0.0 || cross != 0.0).then(|| libm::atan2(cross, dot))
}
