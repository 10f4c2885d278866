//! The fit: maximum likelihood of the coefficients and the noise.

mod ascend;
mod covariance;
mod likelihood;
mod memory;
mod optimise;
mod result;
mod setup;
mod trust;

pub use likelihood::{Likelihood, Parameters, likelihood};
pub use optimise::Ending;
pub use result::{CellScatter, Coefficient, Estimate, Fit, Natural, Noise};

use crate::filter::{NO_CENTRE_NOISE, Problem, Theta};
use crate::{Error, Library, Result, Scales, Track};
pub(crate) use ascend::MOST;
use ascend::{polish, polish_within};
pub(crate) use memory::WithMemory;
use motiform_dynamics::Watch;
use optimise::{Point, climb, prior, roughly};
use serde::{Deserialize, Serialize};
pub(crate) use setup::{check_library, problem};

/// From this many frames on, starts are compared on a half of them.
const LONG: usize = 400;
/// Most first steps of a search whose end may not be needed.
const MOST_ROUGH: usize = 16;

/// The settings of a fit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// The terms, of two to four modes.
    pub library: Library,
    /// `true` if coefficients are complex: the motion and its mirror image may differ.
    pub handed: bool,
    /// Process noise (of velocity and shape, natural units) that the search begins with, from zero coefficients. Empty: 0.4 and 0.1, at
    /// sampling coarser than one natural time also 1 and 0.03.
    pub starts: Vec<f64>,
}

impl Default for Settings {
    /// The 22 terms of the tensor model with real coefficients.
    fn default() -> Self {
        Self { library: Library::tensor(), handed: false, starts: Vec::new() }
    }
}

/// Fits one model to all tracks: maximum likelihood through an extended Kalman filter.
///
/// From zero coefficients with large process noise, by Fisher scoring with damping; the best of the starts is
/// kept (of 400 frames and more, the best on the first half of each stretch). The same
/// coefficients and noise hold for all tracks: the sum of their log-likelihoods is maximised.
///
/// # Errors
/// Those of the input ([`crate::Error`]); [`Error::Interrupted`] where the watch stops it. A search that does not
/// converge is [`Ending::Stopped`] in the result.
/// # Checked by  `tests/all/fit.rs`: errors and coverage on simulated cells
pub fn fit(tracks: &[Track], settings: &Settings, watch: &dyn Watch) -> Result<Fit> {
    let scales = setup::check(tracks, settings)?;
    setup::check_seen(&scales)?;
    let problem = setup::checked(tracks, settings, &scales)?;
    let starts = starts(tracks, settings, &scales);
    let head = problem.head(LONG);
    let of = head.as_ref().unwrap_or(&problem);
    let mut rough = best(of, &starts, watch);
    if head.is_some() {
        rough = climb(&problem, &rough.theta, 1.0, 12, watch);
        if !rough.evaluation.value.is_finite() {
            rough = roughly(&problem, &zero(&problem, 0.4), watch);
        }
    }
    finished(&problem, settings, &scales, &polish(&problem, &rough.theta, scales.time, watch), watch)
}

/// Fits from given values of the coefficients and the noise (as [`Parameters`]) rather than from zero.
///
/// # Errors    as [`fit`]
pub fn fit_from(tracks: &[Track], settings: &Settings, start: &Parameters, watch: &dyn Watch) -> Result<Fit> {
    let scales = setup::check(tracks, settings)?;
    let problem = setup::checked(tracks, settings, &scales)?;
    let theta = likelihood::natural(&problem, settings, &scales, start)?;
    finished(&problem, settings, &scales, &polish(&problem, &theta, scales.time, watch), watch)
}

/// Fits from given natural values: used where a fit is the neighbour of another one. Where the filter diverges there, from zero.
pub(crate) fn refit(
    tracks: &[Track],
    settings: &Settings,
    scales: &Scales,
    start: &Theta,
    watch: &dyn Watch,
) -> Result<Fit> {
    let problem = problem(tracks, settings, scales);
    let mut rough = climb(&problem, start, 1.0, 8, watch);
    if !rough.evaluation.value.is_finite() {
        rough = roughly(&problem, &zero(&problem, 0.4), watch);
    }
    finished(&problem, settings, scales, &polish(&problem, &rough.theta, scales.time, watch), watch)
}

/// As [`refit`], by exact steps alone, at most `most`, and only until they promise less than `enough` log-likelihood: used where the
/// start is that of a neighbour whose estimates are near.
pub(crate) fn refit_within(
    tracks: &[Track],
    settings: &Settings,
    scales: &Scales,
    start: &Theta,
    enough: f64,
    most: usize,
    watch: &dyn Watch,
) -> Result<Fit> {
    let problem = problem(tracks, settings, scales);
    let point = polish_within(&problem, start, scales.time, enough, most, watch);
    if !point.evaluation.value.is_finite() {
        return refit(tracks, settings, scales, start, watch);
    }
    finished(&problem, settings, scales, &point, watch)
}

/// First steps from given natural values, until they promise less than `enough` log-likelihood: where they end, and the log-likelihood
/// there, if they end by themselves. Of 400 frames and more they go to their end on the first half of each stretch first.
pub(crate) fn reached(
    tracks: &[Track],
    settings: &Settings,
    scales: &Scales,
    start: &Theta,
    enough: f64,
    watch: &dyn Watch,
) -> Result<(Theta, Option<f64>)> {
    let problem = problem(tracks, settings, scales);
    let ahead = problem.head(LONG).map(|head| climb(&head, start, enough, MOST_ROUGH, watch));
    let start = ahead.as_ref().filter(|at| at.evaluation.value.is_finite()).map_or(start, |at| &at.theta);
    let Point { theta, evaluation, ending } = climb(&problem, start, enough, MOST_ROUGH, watch);
    if watch.stopped() {
        return Err(Error::Interrupted);
    }
    let value = evaluation.value + prior(&theta) + problem.frames() as f64 * scales.log_density();
    Ok((theta, matches!(ending, Ending::Converged { .. }).then_some(value)))
}

/// The fit at this point, unless the watch stopped the search before.
fn finished(
    problem: &Problem,
    settings: &Settings,
    scales: &Scales,
    point: &Point,
    watch: &dyn Watch,
) -> Result<Fit> {
    if watch.stopped() { Err(Error::Interrupted) } else { Ok(result::make(problem, settings, scales, point)) }
}

fn zero(problem: &Problem, noise: f64) -> Theta {
    let log = libm::log(noise);
    Theta { coefficients: vec![0.0; problem.parts.len()], logs: [0.0, log, log, NO_CENTRE_NOISE] }
}

fn starts(tracks: &[Track], settings: &Settings, scales: &Scales) -> Vec<f64> {
    if !settings.starts.is_empty() {
        return settings.starts.clone();
    }
    let dt = tracks.iter().map(Track::interval).fold(0.0, f64::max);
    if dt > scales.time { vec![0.4, 0.1, 1.0, 0.03] } else { vec![0.4, 0.1] }
}

/// The best of these starts on a problem.
fn best(problem: &Problem, starts: &[f64], watch: &dyn Watch) -> Point {
    let mut best = roughly(problem, &zero(problem, starts[0]), watch);
    for &noise in &starts[1..] {
        let other = roughly(problem, &zero(problem, noise), watch);
        if other.evaluation.value > best.evaluation.value {
            best = other;
        }
    }
    best
}
