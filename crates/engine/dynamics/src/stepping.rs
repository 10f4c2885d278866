//! The parts that all orbits share: counts of steps, reasons for failed ones, the grid of fixed steps.

use crate::{Error, Obstacle};

/// The work done so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Accepted steps.
    pub steps: u64,
    /// Rejected steps.
    pub rejected: u64,
}

/// The reason why a step could not be taken. The orbit stays at the last accepted state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepFailure {
    /// The step required by error control is below the resolution of time.
    Underflow {
        /// That step.
        step: f64,
    },
    /// A fixed step led to a state that is not finite.
    NotFinite,
    /// The model gives the reason why no step is possible: the next state would have no rates.
    Obstacle(Obstacle),
}

/// Checks an initial time and state.
pub(crate) fn check_start(dim: usize, t: f64, u: &[f64]) -> Result<(), Error> {
    if u.len() != dim {
        return Err(Error::Shape { what: "the initial state", expected: dim, got: u.len() });
    }
    for (name, value) in std::iter::once(("t", t)).chain(u.iter().map(|&x| ("initial state", x))) {
        if !value.is_finite() {
            return Err(Error::OutOfRange { name, value, range: "that is finite" });
        }
    }
    Ok(())
}

/// End and size of the fixed step number `count + 1` from `start`, ending at `limit` at the latest.
///
/// Times are multiples of the step from the start, so that they carry no accumulated rounding.
pub(crate) fn fixed_step(step: f64, t: f64, (start, count): (f64, u64), limit: f64) -> (f64, f64) {
    let grid = start + step * (count + 1) as f64;
    let t_new = if grid > limit - 1e-9 * step { limit } else { grid };
    let h = if (t_new - t - step).abs() < 1e-9 * step { step } else { t_new - t };
    (t_new, h)
}
