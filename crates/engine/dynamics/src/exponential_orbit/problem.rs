//! The equations that an exponential orbit solves: the shape, and the position if it has one.

use crate::Semilinear;
use crate::steppers::ExponentialTableau;
use crate::steppers::exponential::{self, Stages, StepTable};

/// Velocity and its derivative along the flow: `(shape, rate) -> (v, v')`, with the field they belong to.
pub(super) type DriftOf<'f, F> = fn(&'f F, &[f64], &[f64]) -> ([f64; 2], [f64; 2]);

/// State, rates and acceleration at one end of a step.
#[derive(Clone, Debug)]
pub(super) struct End {
    pub(super) state: Vec<f64>,
    pub(super) slope: Vec<f64>,
    pub(super) acceleration: [f64; 2],
}

/// The start of a step and its size.
pub(super) struct Start<'e> {
    pub(super) t: f64,
    pub(super) h: f64,
    pub(super) end: &'e End,
}

/// The equations: shape, and drift if there is a position.
pub(super) struct Problem<'f, F: ?Sized> {
    pub(super) field: &'f F,
    pub(super) drift: Option<DriftOf<'f, F>>,
    pub(super) lambda: Vec<f64>,
    /// `true` if states are kicked ([`crate::Integration::roughen`]): the position then is the trapezoidal rule.
    pub(super) rough: bool,
}

impl<F: Semilinear<f64> + ?Sized> Problem<'_, F> {
    /// One step of shape and position, with the rates at its end.
    pub(super) fn step(
        &self,
        tableau: &ExponentialTableau,
        table: &StepTable,
        at: &Start<'_>,
        stages: &mut Stages,
        out: &mut End,
    ) {
        let dim = self.lambda.len();
        let (from, to) = (&at.end.state[..dim], &mut out.state[..dim]);
        exponential::step(tableau, self.field, at.t, from, table, stages, to);
        self.evaluate(at.t + at.h, stages.get_mut(tableau.stages()), out);
        out.travel(at.end, at.h, dim);
    }

    /// The rates at `end`: `N` into `nonlinear`, `Lambda u + N` and the velocity into its slope.
    pub(super) fn evaluate(&self, t: f64, nonlinear: &mut [f64], end: &mut End) {
        let dim = self.lambda.len();
        self.field.nonlinear(t, &end.state[..dim], nonlinear);
        let (slope, velocity) = end.slope.split_at_mut(dim);
        for (((x, &l), &n), &u) in slope.iter_mut().zip(&self.lambda).zip(&*nonlinear).zip(&end.state) {
            *x = l * u + n;
        }
        if let Some(drift) = self.drift {
            let (v, acceleration) = drift(self.field, &end.state[..dim], slope);
            velocity.copy_from_slice(&v);
            end.acceleration = if self.rough { [0.0; 2] } else { acceleration };
        }
    }
}

impl End {
    /// Sets the entries from `dim` on, the position, from those at the step's start: Euler-Maclaurin.
    fn travel(&mut self, start: &Self, h: f64, dim: usize) {
        for (axis, place) in (dim..self.state.len()).enumerate() {
            let mean = 0.5 * (start.slope[place] + self.slope[place]);
            let bend = (start.acceleration[axis] - self.acceleration[axis]) / 12.0;
            self.state[place] = start.state[place] + h * (mean + h * bend);
        }
    }
}
