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

/// The times of fixed steps: multiples of the step from a start, so that they carry no accumulated rounding.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FixedGrid {
    start: f64,
    /// Steps from the start.
    count: u64,
}

impl FixedGrid {
    pub(crate) fn from(start: f64) -> Self {
        Self { start, count: 0 }
    }

    /// End and size of the next step from time `t`, ending at `limit` at the latest.
    pub(crate) fn next(self, step: f64, t: f64, limit: f64) -> (f64, f64) {
        let grid = self.start + step * (self.count + 1) as f64;
        let t_new = if grid > limit - 1e-9 * step { limit } else { grid };
        let h = if (t_new - t - step).abs() < 1e-9 * step { step } else { t_new - t };
        (t_new, h)
    }

    /// The grid after a step to `t`: at a limit another one begins.
    pub(crate) fn after(self, t: f64, limit: f64) -> Self {
        if t == limit { Self::from(limit) } else { Self { count: self.count + 1, ..self } }
    }
}
