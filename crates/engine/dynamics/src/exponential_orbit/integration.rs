//! An exponential orbit as an [`Integration`] for the driver.

use super::ExponentialOrbit;
use crate::control::Tolerance;
use crate::interpolant::{DenseStep, Ends};
use crate::stepping::{Counters, FixedGrid, StepFailure};
use crate::{Integration, Semilinear, StepControl};

impl<F: Semilinear<f64> + ?Sized> Integration for ExponentialOrbit<'_, F> {
    fn advance(&mut self, limit: f64) -> Result<(), StepFailure> {
        match self.control {
            StepControl::Fixed { step } => self.advance_fixed(step, limit),
            StepControl::Adaptive { rtol, atol } => self.advance_adaptive(Tolerance { rtol, atol }, limit),
        }
    }

    fn dense(&mut self) -> DenseStep<'_> {
        if !self.prepared {
            let new = if self.jumped { &self.landed } else { &self.new };
            let ends = Ends { h: self.t - self.t_old, old: &self.old.state, new: &new.state };
            self.interpolant.prepare_hermite(&self.old.slope, &new.slope, &ends);
            self.prepared = true;
        }
        let (old, new) = (&self.old.state[..], &self.new.state[..]);
        DenseStep { t_old: self.t_old, t: self.t, old, new, interpolant: &self.interpolant }
    }

    fn roughen(&mut self) {
        self.problem.rough = true;
        self.new.acceleration = [0.0; 2];
    }

    fn step_to(&mut self, t: f64, out: &mut [f64]) {
        self.restep_to(t);
        out.copy_from_slice(&self.trial.state);
    }

    fn end_step_at(&mut self, t: f64) {
        self.restep_to(t);
        self.restep.copy_to(self.tableau.stages(), &mut self.stages);
        std::mem::swap(&mut self.new, &mut self.trial);
        self.t = t;
        self.grid = FixedGrid::from(t);
        self.jumped = false;
        self.prepared = false;
    }

    fn restart(&mut self, u: &[f64]) {
        self.new.state.copy_from_slice(u);
        self.problem.evaluate(self.t, self.stages.get_mut(self.tableau.stages()), &mut self.new);
        self.old.clone_from(&self.new);
        self.t_old = self.t;
        self.accepted = true;
        self.jumped = false;
        self.prepared = false;
    }

    fn t(&self) -> f64 {
        self.t
    }

    fn t_old(&self) -> f64 {
        self.t_old
    }

    fn state(&self) -> &[f64] {
        &self.new.state
    }

    fn slope(&self) -> &[f64] {
        &self.new.slope
    }

    fn counters(&self) -> Counters {
        self.counters
    }
}
