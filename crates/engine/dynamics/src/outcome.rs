//! The end of a run, as part of every result.

use crate::digits::decimals;
use serde::{Deserialize, Serialize};

/// The reason why a state has no rates (see [`crate::System::obstacle`]).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Obstacle {
    /// The boundary could not be closed, so the body has no velocity.
    Closure {
        /// The residual of the closing condition, relative to the length of the boundary.
        residual: f64,
    },
}

/// The end of a run. Only [`Outcome::Completed`] reached its end; all others state when and why the run ended.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Outcome {
    /// Reached the end of the time span.
    Completed {
        /// End time.
        t: f64,
    },
    /// Exceeded the escape bound.
    Escaped {
        /// The blow-up time `t*` where `singular`, else the time at which the norm passed the bound.
        t: f64,
        /// Norm of the last finite state.
        norm: f64,
        /// `true` if the growth was that of a finite-time singularity (see [`crate::escape`]).
        singular: bool,
        /// Time of the last finite state; `t - t_last` is the extrapolated part.
        t_last: f64,
    },
    /// The error control required steps below the resolution of time: the field is not smooth here, or not finite.
    StepUnderflow {
        /// Time reached.
        t: f64,
        /// The required step.
        step: f64,
    },
    /// The boundary of the body could not be closed: the shape has no velocity there.
    ClosureFailed {
        /// Time of the last state that has one.
        t: f64,
        /// The residual of the closing condition, relative to the length of the boundary.
        residual: f64,
    },
    /// The budget of steps was used up.
    StepBudget {
        /// Time reached.
        t: f64,
        /// Steps taken.
        steps: u64,
    },
    /// Stopped at a terminal section.
    Stopped {
        /// Time of the crossing.
        t: f64,
    },
    /// Stopped from outside (Ctrl-C).
    Interrupted {
        /// Time reached.
        t: f64,
    },
}

impl Outcome {
    /// Returns `true` if the run reached its requested end.
    pub fn is_complete(&self) -> bool {
        matches!(self, Self::Completed { .. } | Self::Stopped { .. })
    }

    /// The same, with its times counted from a moment that lies earlier by `shift`.
    #[must_use]
    pub fn later(mut self, shift: f64) -> Self {
        match &mut self {
            Self::Escaped { t, t_last, .. } => {
                *t += shift;
                *t_last += shift;
            }
            Self::Completed { t }
            | Self::StepUnderflow { t, .. }
            | Self::ClosureFailed { t, .. }
            | Self::StepBudget { t, .. }
            | Self::Stopped { t }
            | Self::Interrupted { t } => *t += shift,
        }
        self
    }

    /// The time of the last state, which is before that of a singularity.
    pub fn t_last(&self) -> f64 {
        match *self {
            Self::Escaped { t_last, .. } => t_last,
            other => other.t(),
        }
    }

    /// The time of the outcome.
    pub fn t(&self) -> f64 {
        match *self {
            Self::Completed { t }
            | Self::Escaped { t, .. }
            | Self::StepUnderflow { t, .. }
            | Self::ClosureFailed { t, .. }
            | Self::StepBudget { t, .. }
            | Self::Stopped { t }
            | Self::Interrupted { t } => t,
        }
    }
}

impl std::fmt::Display for Outcome {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let time = decimals(self.t(), 9);
        match *self {
            Self::Completed { t } => write!(f, "completed at t = {t}"),
            Self::Escaped { singular: true, .. } => write!(f, "blew up at t* = {time}"),
            Self::Escaped { norm, .. } => write!(f, "left every bound at t = {time} (norm {norm:.3e})"),
            Self::StepUnderflow { step, .. } => {
                write!(f, "step size fell to {step:.3e} at t = {time}: the solution is not smooth there")
            }
            Self::ClosureFailed { residual, .. } => {
                write!(f, "the boundary could not be closed at t = {time} (residual {residual:.3e})")
            }
            Self::StepBudget { steps, .. } => {
                write!(f, "step budget used up at t = {time} ({steps} steps accepted)")
            }
            Self::Stopped { .. } => write!(f, "stopped at a section at t = {time}"),
            Self::Interrupted { .. } => write!(f, "interrupted at t = {time}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_has_its_digits_in_any_unit() {
        let said = [0.25, 3.465_735_9e-7].map(|t| Outcome::Stopped { t }.to_string());
        assert_eq!(
            said,
            ["stopped at a section at t = 0.250000000", "stopped at a section at t = 3.465735900e-7"]
        );
    }
}
