//! An orbit as an [`Integration`] for the driver.

use super::Orbit;
use crate::interpolant::DenseStep;
use crate::stepping::{Counters, StepFailure};
use crate::{Integration, VectorField};

impl<F: VectorField<f64> + ?Sized> Integration for Orbit<'_, F> {
    fn advance(&mut self, limit: f64) -> Result<(), StepFailure> {
        self.advance(limit)
    }

    fn dense(&mut self) -> DenseStep<'_> {
        self.dense()
    }

    fn step_to(&mut self, t: f64, out: &mut [f64]) {
        self.step_to(t, out);
    }

    fn end_step_at(&mut self, t: f64) {
        self.end_step_at(t);
    }

    fn restart(&mut self, u: &[f64]) {
        self.restart(u);
    }

    fn restart_with(&mut self, u: &[f64], rates: &[f64]) {
        self.restart_with(u, rates);
    }

    fn t(&self) -> f64 {
        self.t
    }

    fn t_old(&self) -> f64 {
        self.t_old
    }

    fn state(&self) -> &[f64] {
        &self.u
    }

    fn slope(&self) -> &[f64] {
        self.slope()
    }

    fn counters(&self) -> Counters {
        self.counters
    }
}
