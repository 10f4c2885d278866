//! The common interface of integrations, used by the driver and the sections.

use crate::orbit::{Counters, DenseStep, StepFailure};

/// A boxed integration is an integration.
impl<O: Integration + ?Sized> Integration for Box<O> {
    fn advance(&mut self, limit: f64) -> Result<(), StepFailure> {
        (**self).advance(limit)
    }

    fn dense(&mut self) -> DenseStep<'_> {
        (**self).dense()
    }

    fn at(&mut self, t: f64, out: &mut [f64]) {
        (**self).at(t, out);
    }

    fn roughen(&mut self) {
        (**self).roughen();
    }

    fn step_to(&mut self, t: f64, out: &mut [f64]) {
        (**self).step_to(t, out);
    }

    fn end_step_at(&mut self, t: f64) {
        (**self).end_step_at(t);
    }

    fn restart(&mut self, u: &[f64]) {
        (**self).restart(u);
    }

    fn restart_with(&mut self, u: &[f64], rates: &[f64]) {
        (**self).restart_with(u, rates);
    }

    fn t(&self) -> f64 {
        (**self).t()
    }

    fn t_old(&self) -> f64 {
        (**self).t_old()
    }

    fn state(&self) -> &[f64] {
        (**self).state()
    }

    fn slope(&self) -> &[f64] {
        (**self).slope()
    }

    fn counters(&self) -> Counters {
        (**self).counters()
    }
}

/// An initial-value problem in progress, one accepted step at a time.
pub trait Integration {
    /// Takes one step, ending at `limit` (later than [`Integration::t`]) at the latest.
    ///
    /// # Errors
    /// [`StepFailure`]; the orbit is unchanged.
    fn advance(&mut self, limit: f64) -> Result<(), StepFailure>;

    /// The last step as a function of time. If the field corrects its states ([`crate::System::project`]) it is the
    /// flow before the correction, which is a jump at the very end of the step.
    fn dense(&mut self) -> DenseStep<'_>;

    /// Writes the state at `t` inside the last step, for a record of the motion: dense output, unless the path is not smooth.
    fn at(&mut self, t: f64, out: &mut [f64]) {
        self.dense().at(t, out);
    }

    /// From now on states are kicked: results may not rely on the smoothness of the past or on rates
    /// at the ends of steps.
    fn roughen(&mut self) {}

    /// Writes the state at `t` inside the last step by a true step of the method from its start.
    fn step_to(&mut self, t: f64, out: &mut [f64]);

    /// Moves the end of the last step back to `t` (by a true step from its start): the orbit continues from there. The
    /// state there lies inside the step, so it is not corrected ([`crate::System::project`]); the next step's end is.
    fn end_step_at(&mut self, t: f64);

    /// Continues from the state `u` at the same time: a jump after the last step. Step size, step grid and counters are
    /// kept, the last step is empty, and the field does not correct the state.
    ///
    /// # Shapes
    /// `u` has the length of [`Integration::state`].
    fn restart(&mut self, u: &[f64]);

    /// As [`Integration::restart`], if the caller knows the rates at `u`; an integration that does not use them computes
    /// its own.
    fn restart_with(&mut self, u: &[f64], _rates: &[f64]) {
        self.restart(u);
    }

    /// Current time.
    fn t(&self) -> f64;

    /// Time at the start of the last step.
    fn t_old(&self) -> f64;

    /// Current state.
    fn state(&self) -> &[f64];

    /// Rates at the current state.
    fn slope(&self) -> &[f64];

    /// The work done so far.
    fn counters(&self) -> Counters;
}
