//! Lives of chaos that ends: their mean with exact limits, and its law against a parameter.

mod answer;
mod laws;
mod memory;

pub use answer::{LifeLaws, compare_life_laws};
pub use laws::{Critical, ExponentialLife, Goodness, PowerLawLife};
pub use memory::{Memory, memory};

use crate::{Result, Stay, checks, escape_limits, sort_by_number};
use serde::Serialize;

/// The mean life of a set that loses its orbits at a constant rate, with its exact 95 % limits.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MeanLife {
    /// Ends of lives after the delay.
    pub events: usize,
    /// Time watched after the delay, summed over the runs (model time).
    pub watched: f64,
    /// Lives that ended within the delay: they do not count.
    pub early: usize,
    /// The mean life (model time); `None` without events.
    pub value: Option<f64>,
    /// Its lower limit; 0 if nothing was watched.
    pub lower: f64,
    /// Its upper limit; `None` without events.
    pub upper: Option<f64>,
}

/// Mean life of the runs that stay longer than `delay`, by maximum likelihood with censoring.
///
/// tau = W / d,   limits  2 W / chi2(0.975; 2 d + 2)  and  2 W / chi2(0.025; 2 d):   d ends of lives after `delay`,
/// W = sum of max(time - delay, 0)
///
/// The delay is the way onto the chaotic set: an exponential law has no memory, so what is left of a life has the same
/// law, and a time that is added to all lives (until an end is noticed) changes nothing as long as it is shorter than the delay.
///
/// No event is a value: then only the lower limit W / 3.69 is known.
///
/// Source: Cox and Oakes (1984), Analysis of Survival Data, ch. 3; limits of Garwood (1936), Biometrika 28, 437.
///
/// # Units   of the times
/// # Errors    [`crate::Error::NotFinite`]; [`crate::Error::OutOfRange`] for a negative time
/// # Not       a test that the lives are exponential
/// # Checked by  tests/all/lifetime.rs: coverage with and without censoring, an offset
pub fn mean_life(stays: &[Stay], delay: f64) -> Result<MeanLife> {
    checks::argument("delay", delay, delay >= 0.0, "of at least 0")?;
    checks::finite(&stays.iter().map(|stay| stay.time).collect::<Vec<_>>())?;
    for stay in stays {
        checks::argument("time of a stay", stay.time, stay.time >= 0.0, "of at least 0")?;
    }
    let mut late: Vec<&Stay> = stays.iter().filter(|stay| stay.time > delay).collect();
    sort_by_number(&mut late, |a| a.time); // the sum does not depend on the order of the runs
    let watched: f64 = late.iter().map(|stay| stay.time - delay).sum();
    let events = late.iter().filter(|stay| stay.escaped).count();
    let early = stays.iter().filter(|stay| stay.escaped && stay.time <= delay).count();
    if watched <= 0.0 {
        return Ok(MeanLife { events, watched: 0.0, early, value: None, lower: 0.0, upper: None });
    }
    let (slow, fast) = escape_limits(events, watched)?;
    let some = |value: f64| (events > 0).then_some(value);
    let (value, upper) = (some(watched / events as f64), some(1.0 / slow));
    Ok(MeanLife { events, watched, early, value, lower: 1.0 / fast, upper })
}

/// Ends of lives at one value of a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LifeCount {
    /// Value of the parameter.
    pub parameter: f64,
    /// Ends of lives.
    pub events: usize,
    /// Time watched, summed over the runs (model time).
    pub watched: f64,
}
