//! The settings of a classification: time spans, method and limits.

use crate::periodic::Flow;
use motiform_dynamics::steppers::Method;
use motiform_dynamics::{Outcome, Request, StepControl};

/// The settings of a classification.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// Stepper of the shape.
    pub method: Method,
    /// Its control.
    pub control: StepControl,
    /// Length of the first look (model time): some tens of the slowest ordinary time scale. Each further look is twice
    /// as long.
    pub first_look: f64,
    /// Most model time to spend on one motion.
    pub budget: f64,
    /// A shape beyond this norm has escaped.
    pub escape_norm: f64,
    /// Most steps in all.
    pub max_steps: u64,
}

impl Settings {
    /// A run to `t_end` on a state whose first `watched` entries are the shape.
    pub(super) fn request(&self, t_end: f64, watched: usize) -> Request<'static> {
        Request {
            max_steps: self.max_steps,
            escape_norm: self.escape_norm,
            watched,
            ..Request::until(t_end, watched)
        }
    }

    /// The same with a tolerance that is tighter by this factor (0 to 1), as far as rounding allows.
    pub fn tighter(&self, factor: f64) -> Self {
        let flow = self.flow().tighter(factor);
        flow.map_or(*self, |flow| Self { control: flow.control, ..*self })
    }

    /// The flow over one period.
    pub(super) fn flow(&self) -> Flow {
        Flow { method: self.method, control: self.control, max_steps: self.max_steps }
    }

    /// The relative accuracy of states that these settings give.
    pub(super) fn accuracy(&self) -> f64 {
        self.flow().accuracy()
    }

    /// The distance (against its size) from a stable equilibrium at which an orbit of these settings hovers:
    /// nearer than this it has arrived.
    pub(super) fn hovering(&self) -> f64 {
        match self.control {
            StepControl::Adaptive { rtol, .. } => (100.0 * rtol).max(1e-8),
            // the equilibrium of the scheme is not quite that of the flow
            StepControl::Fixed { .. } => self.accuracy(),
        }
    }

    /// Absolute tolerance of the states.
    pub(super) fn atol(&self) -> f64 {
        match self.control {
            StepControl::Adaptive { atol, .. } => atol,
            StepControl::Fixed { .. } => 0.0,
        }
    }
}

/// The outcome of a look or a test, if it did not reach its end.
pub(super) fn ended(outcome: &Outcome) -> Option<Outcome> {
    (!outcome.is_complete()).then_some(*outcome)
}

/// Looks of a large system whose exponent is nearly decided last for so many first looks at most.
pub(super) const NEARLY: f64 = 8.0;

/// A shape that differs from its image by less than this part of its size has the symmetry exactly.
pub(super) const EXACT: f64 = 1e-12;
