//! Coefficients against the sampling interval.

use crate::filter::Theta;
use crate::fit::refit_within;
use crate::observation::LEAST_FRAMES;
use crate::{Coefficient, Ending, Estimate, Fit, Result, Settings, Track, observation};
use motiform_dynamics::Watch;
use serde::{Deserialize, Serialize};

/// Promised gain of log-likelihood at which a fit of fewer frames ends: 0.14 standard errors.
const NEAR: f64 = 1e-2;
/// Most evaluations of it: where they are not enough the frames are too far apart for these equations, and it does not count.
const MOST: usize = 16;
/// Fewest frames for each coefficient.
const FRAMES_EACH: usize = 3;
/// Standard deviations from which on a change counts.
const CHANGED: f64 = 3.5;

/// A fit of every n-th frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DriftPoint {
    /// n.
    pub every: usize,
    /// Sampling interval.
    pub interval: f64,
    /// The coefficients, in the order of the fit's, or why these frames give none.
    pub estimates: std::result::Result<Vec<Estimate>, String>,
}

/// Coefficients against the sampling interval: if the model is right they are the same within errors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Drift {
    /// Names of the coefficients, `i z1: z1` of an imaginary part.
    pub coefficients: Vec<String>,
    /// Every second frame, every fourth.
    pub points: Vec<DriftPoint>,
    /// Largest change from the fit of all frames, in standard deviations of such a change; `None` where no fit of fewer frames counts.
    ///
    /// Its variance is the difference of both variances, as the fit of all frames is efficient (Hausman 1978,
    /// Econometrica 46, 1251); at least a quarter of the larger one.
    pub changes: Vec<Option<f64>>,
}

impl Drift {
    /// The coefficients that change by more than 3.5 standard deviations.
    pub fn names(&self) -> Vec<String> {
        let pairs = self.coefficients.iter().zip(&self.changes);
        pairs
            .filter(|(_, change)| change.is_some_and(|change| change > CHANGED))
            .map(|(name, _)| name.clone())
            .collect()
    }
}

/// Fits every second and every fourth frame again. Give the model that describes the cell, whether its coefficients are real or complex.
///
/// # Errors    of the input, as [`crate::fit()`]
/// # Checked by  `tests/all/warnings.rs`: what does not count; `tests/all/handed.rs`: complex coefficients
pub fn drift(tracks: &[Track], fit: &Fit, watch: &dyn Watch) -> Result<Drift> {
    observation::check(tracks, fit.library.modes)?;
    let interval = tracks.iter().map(Track::interval).fold(0.0, f64::max);
    let mut points = Vec::new();
    let mut start = fit.theta();
    for every in [2, 4] {
        let again = thinned(tracks, every, fit, &start, watch)?;
        start = again.as_ref().map_or(start, Fit::theta);
        let estimates = again.and_then(|again| match &again.ending {
            Ending::Converged { .. } => Ok(again.coefficients.iter().map(|c| c.estimate).collect()),
            Ending::Stopped { reason } => {
                Err(format!("the fit did not converge, and says nothing of the sampling: {reason}"))
            }
        });
        points.push(DriftPoint { every, interval: interval * every as f64, estimates });
    }
    let own = fit.coefficients.iter().enumerate();
    let changes = own.map(|(i, c)| change(&points, i, c.estimate)).collect();
    let name = |c: &Coefficient| format!("{}{}", if c.imaginary { "i " } else { "" }, c.name);
    Ok(Drift { coefficients: fit.coefficients.iter().map(name).collect(), points, changes })
}

/// The fit of every n-th frame, from these values on, or why there is none.
fn thinned(
    tracks: &[Track],
    every: usize,
    fit: &Fit,
    start: &Theta,
    watch: &dyn Watch,
) -> Result<std::result::Result<Fit, String>> {
    let tracks: Vec<Track> = tracks.iter().map(|track| track.thinned(every)).collect();
    let least = LEAST_FRAMES.max(FRAMES_EACH * fit.coefficients.len());
    let fewest = tracks.iter().map(|track| track.0.len()).min().unwrap_or(0);
    if fewest < least {
        let count = fit.coefficients.len();
        return Ok(Err(format!(
            "{fewest} frames are left, and {count} coefficients need {least}: track longer"
        )));
    }
    let settings = Settings { library: fit.library.clone(), handed: fit.handed, starts: Vec::new() };
    let again = refit_within(&tracks, &settings, &fit.scales, start, NEAR, MOST, watch)?;
    let apart = || "the frames are too far apart for the filter: it starts again at each of them".to_owned();
    Ok(if again.frames > 0 { Ok(again) } else { Err(apart()) })
}

fn change(points: &[DriftPoint], i: usize, first: Estimate) -> Option<f64> {
    let of = |other: &Estimate| {
        let (a, b) = (first.robust.max(first.error), other.robust.max(other.error));
        let variance = (b * b - a * a).max(0.25 * b * b);
        if variance > 0.0 { (other.value - first.value).abs() / variance.sqrt() } else { 0.0 }
    };
    points.iter().filter_map(|point| point.estimates.as_ref().ok()?.get(i)).map(of).reduce(f64::max)
}
