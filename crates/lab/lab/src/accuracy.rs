//! The errors of the recorded numbers of a run.

use motiform_dynamics::Model;
use motiform_study::Manifest;
use motiform_study::plan::Control;

/// Samples lie between steps, on the interpolant of the method: over the long steps of a steady motion its error is up to about so many
/// tolerances of a step (a straight tensor body at a relative tolerance of 1e-9: 6e-8 of the speed, 1.1e-7 of |U|).
const BETWEEN_STEPS: f64 = 100.0;

/// A difference of numbers is known from so many of their errors on.
const KNOWN: f64 = 10.0;

/// The absolute error of a step of fixed length (model units): what is left of terms of size 1 that cancel.
const ROUNDING: f64 = 1e-12;

/// Errors of the numbers of a run: a part of their size, and one that is there at 0, too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Accuracy {
    relative: f64,
    absolute: f64,
}

impl Accuracy {
    /// Of a run.
    pub(crate) fn of(manifest: &Manifest) -> Self {
        Self::with(manifest.plan.computation.control, manifest.step_error)
    }

    /// From the tolerances of the steps; of fixed ones from the error of one of them, if it is known.
    pub(crate) fn with(control: Control, step_error: Option<f64>) -> Self {
        match control {
            Control::Adaptive { rtol, atol } => Self { relative: rtol, absolute: atol },
            Control::Fixed { .. } => {
                Self { relative: step_error.unwrap_or(ROUNDING).max(ROUNDING), absolute: ROUNDING }
            }
        }
    }

    /// The least difference of sampled numbers of this size that is known; that of numbers at 0 is the least size that is known not to
    /// be 0.
    pub(crate) fn least(self, size: f64) -> f64 {
        KNOWN * BETWEEN_STEPS * (self.relative * size.abs() + self.absolute)
    }

    /// Returns `true` if sampled values differ beyond their errors. Values that are not a number are left out.
    pub(crate) fn varies(self, values: impl IntoIterator<Item = f64>) -> bool {
        let range = |(low, high): (f64, f64), x: f64| (low.min(x), high.max(x));
        let (low, high) = values.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), range);
        high - low > self.least(high.abs().max(low.abs()))
    }

    /// The speed from which a body of this shape is known to move: one that is an unknown has the errors of the unknowns, one that
    /// follows from the shape the resolution that the model states.
    pub(crate) fn least_speed(self, model: &dyn Model, shape: &[f64]) -> f64 {
        match model.velocities() {
            0 => model.speed_resolution(shape, self.absolute),
            _ => self.least(0.0),
        }
    }

    /// The least difference as a part of numbers of this size; 1 at most.
    pub(crate) fn part(self, size: f64) -> f64 {
        (self.least(size) / size.abs()).min(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_no_variation() {
        let run = Accuracy { relative: 1e-9, absolute: 1e-12 };
        assert!(run.varies([1.0, 1.0 + 2e-6]) && !run.varies([1.0, 1.0 + 5e-7, f64::NAN]));
        assert!(run.varies([0.0, 2e-9]) && !run.varies([1e-25, 1e-24]));
        assert!(!run.varies([f64::NAN]) && !run.varies([]));
    }
}
