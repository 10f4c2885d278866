//! Coefficients against the sampling interval.

use crate::fit::refit_within;
use crate::observation::LEAST_FRAMES;
use crate::{Estimate, Fit, Result, Settings, Track, observation};
use motiform_dynamics::Watch;
use serde::{Deserialize, Serialize};

/// Promised gain of log-likelihood at which a fit of fewer frames ends: 0.14 standard errors.
const NEAR: f64 = 1e-2;
/// Most evaluations of it: where they are not enough the frames are too far apart for these equations, and it does not count.
const MOST: usize = 16;
/// Standard deviations from which on a change counts.
const CHANGED: f64 = 3.5;

/// A fit of every n-th frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DriftPoint {
    /// n.
    pub every: usize,
    /// Sampling interval.
    pub interval: f64,
    /// `true` if the fit converged.
    pub converged: bool,
    /// The coefficients, in the order of the fit's.
    pub estimates: Vec<Estimate>,
}

/// Coefficients against the sampling interval: if the model is right they are the same within errors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Drift {
    /// Names of the coefficients.
    pub coefficients: Vec<String>,
    /// All frames, every second, every fourth.
    pub points: Vec<DriftPoint>,
    /// Largest change from the fit of all frames, in standard deviations of such a change.
    ///
    /// Its variance is the difference of both variances, as the fit of all frames is efficient (Hausman 1978,
    /// Econometrica 46, 1251); at least a quarter of the larger one.
    pub changes: Vec<f64>,
}

impl Drift {
    /// The coefficients that change by more than 3.5 standard deviations.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        let pairs = self.coefficients.iter().zip(&self.changes);
        pairs.filter(|(_, change)| **change > CHANGED).map(|(name, _)| name.clone()).collect()
    }
}

/// Fits every second and every fourth frame again. Give the fit of selected terms.
///
/// # Errors    of the input, as [`crate::fit()`]; too few frames leave a point out
pub fn drift(tracks: &[Track], fit: &Fit, watch: &dyn Watch) -> Result<Drift> {
    observation::check(tracks, fit.library.modes)?;
    let interval = tracks.iter().map(Track::interval).fold(0.0, f64::max);
    let mut points = vec![point(fit, 1, interval)];
    let settings = Settings { library: fit.library.clone(), handed: fit.handed, starts: Vec::new() };
    let mut start = fit.theta();
    for every in [2, 4] {
        let thinned: Vec<Track> = tracks.iter().map(|track| track.thinned(every)).collect();
        let least = LEAST_FRAMES.max(3 * fit.coefficients.len());
        if thinned.iter().all(|track| track.0.len() >= least) {
            let again = refit_within(&thinned, &settings, &fit.scales, &start, (NEAR, MOST), watch)?;
            if again.frames > 0 {
                points.push(point(&again, every, interval * every as f64));
                start = again.theta();
            }
        }
    }
    let changes = (0..fit.coefficients.len()).map(|i| change(&points, i)).collect();
    Ok(Drift { coefficients: fit.coefficients.iter().map(|c| c.name.clone()).collect(), points, changes })
}

fn point(fit: &Fit, every: usize, interval: f64) -> DriftPoint {
    let estimates = fit.coefficients.iter().map(|c| c.estimate).collect();
    DriftPoint { every, interval, converged: fit.converged(), estimates }
}

fn change(points: &[DriftPoint], i: usize) -> f64 {
    let first = points[0].estimates[i];
    let of = |point: &DriftPoint| {
        let other = point.estimates[i];
        let (a, b) = (first.robust.max(first.error), other.robust.max(other.error));
        let variance = (b * b - a * a).max(0.25 * b * b);
        if variance > 0.0 { (other.value - first.value).abs() / variance.sqrt() } else { 0.0 }
    };
    points[1..].iter().filter(|point| point.converged).map(of).fold(0.0, f64::max)
}
