//! Steady motions that a record is long enough to show.

use crate::driven::{states, without};
use crate::natural::{STEP, model, noise};
use motiform_dynamics::Normal;
use motiform_inference::{Fit, Track};

/// Largest standard deviation of the speed and of the size of each mode, in natural units, of a motion that is steady.
const STEADY: f64 = 0.1;
/// Most natural times that are followed.
const MOST_TIME: f64 = 1000.0;

/// Natural times from the middle of the longest track, where the equations begin, to its end.
pub(crate) fn time_left(tracks: &[Track], fit: &Fit) -> f64 {
    let longest = tracks.iter().max_by_key(|track| track.0.len());
    let left = longest.and_then(|track| Some(track.0.last()?.t - track.0.get(track.0.len() / 2)?.t));
    left.unwrap_or(0.0) / fit.scales.time
}

/// `true` if equations that end in a steady motion reach it within this time: without noise, from these coordinates, speed and sizes of
/// the modes keep their values in the last half of it. Otherwise the steady motion is not what the cell showed, but what the equations
/// foretell for later.
pub(crate) fn settles(fit: &Fit, values: &[f64], start: &[f64], time: f64) -> bool {
    let steps = (time.min(MOST_TIME) / STEP) as usize;
    let run = || {
        let model = model(fit, values)?;
        let still = without(noise(fit, model.as_ref(), STEP));
        states(model.as_ref(), start, still, Normal::new(0, 0), steps)
    };
    run().is_some_and(|states| states.len() >= 2 && scatter(&states[states.len() / 2..]) <= STEADY)
}

/// The largest standard deviation of the speed and of the size of each mode.
fn scatter(states: &[Vec<f64>]) -> f64 {
    let of = |pair: usize| {
        let sizes = states.iter().map(|at| libm::hypot(at[2 * pair], at[2 * pair + 1]));
        let count = states.len() as f64;
        let mean = sizes.clone().sum::<f64>() / count;
        (sizes.map(|size| (size - mean) * (size - mean)).sum::<f64>() / count).sqrt()
    };
    (0..states[0].len() / 2).map(of).fold(0.0, f64::max)
}
