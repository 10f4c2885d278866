//! The state inside a step, without computing the step again.

use crate::steppers::Tableau;
use crate::steppers::runge_kutta::Slopes;

/// The coefficients of one step's interpolant (see [`crate::steppers::tableau::Dense`]), over `f64`.
#[derive(Clone, Debug)]
pub(crate) struct Interpolant {
    dim: usize,
    coefficients: Vec<f64>,
}

/// The two ends of a step.
#[derive(Clone, Copy)]
pub(crate) struct Ends<'u> {
    pub(crate) h: f64,
    pub(crate) old: &'u [f64],
    pub(crate) new: &'u [f64],
}

impl Interpolant {
    pub(crate) fn new(tableau: &Tableau, dim: usize) -> Self {
        Self { dim, coefficients: vec![0.0; tableau.dense.terms() * dim] }
    }

    /// Cubic Hermite interpolation.
    pub(crate) fn hermite(dim: usize) -> Self {
        Self { dim, coefficients: vec![0.0; 3 * dim] }
    }

    /// Fills the coefficients; all slopes of the step must be there, the extra stages included.
    pub(crate) fn prepare(&mut self, tableau: &Tableau, slopes: &Slopes<f64>, ends: &Ends<'_>) {
        self.prepare_hermite(slopes.get(0), slopes.get(tableau.stages()), ends);
        let rest = &mut self.coefficients[3 * self.dim..];
        for (row, weights) in rest.chunks_exact_mut(self.dim).zip(tableau.dense.weights) {
            slopes.combine(weights, row);
            for x in row {
                *x *= ends.h;
            }
        }
    }

    /// Fills the first three coefficients, from the slopes at the two ends.
    pub(crate) fn prepare_hermite(&mut self, first: &[f64], last: &[f64], ends: &Ends<'_>) {
        let (difference, rest) = self.coefficients.split_at_mut(self.dim);
        let (tangent, rest) = rest.split_at_mut(self.dim);
        for i in 0..self.dim {
            difference[i] = ends.new[i] - ends.old[i];
            tangent[i] = ends.h * first[i] - difference[i];
            rest[i] = 2.0 * difference[i] - ends.h * (first[i] + last[i]);
        }
    }

    /// Writes the state at the fraction `x` of the step, `0 <= x <= 1`.
    pub(crate) fn evaluate(&self, old: &[f64], x: f64, out: &mut [f64]) {
        let blocks = self.dim / BLOCK * BLOCK;
        for first in (0..blocks).step_by(BLOCK) {
            self.block::<BLOCK>(first, old, x, out);
        }
        for first in blocks..self.dim {
            self.block::<1>(first, old, x, out);
        }
    }

    /// `W` components from `first` on, which stay in registers.
    #[inline(always)]
    fn block<const W: usize>(&self, first: usize, old: &[f64], x: f64, out: &mut [f64]) {
        let mut values = [0.0; W];
        for (term, row) in self.coefficients.chunks_exact(self.dim).enumerate().rev() {
            let factor = if term % 2 == 0 { x } else { 1.0 - x };
            for (value, f) in values.iter_mut().zip(&row[first..first + W]) {
                *value = (*value + f) * factor;
            }
        }
        for i in first..first + W {
            out[i] = values[i - first] + old[i];
        }
    }
}

/// Components of a state that are evaluated together.
const BLOCK: usize = 6;

/// The last step of an orbit as a function of time.
pub struct DenseStep<'o> {
    pub(crate) t_old: f64,
    pub(crate) t: f64,
    pub(crate) old: &'o [f64],
    pub(crate) new: &'o [f64],
    pub(crate) interpolant: &'o Interpolant,
}

impl DenseStep<'_> {
    /// Start and end of the step.
    pub fn span(&self) -> (f64, f64) {
        (self.t_old, self.t)
    }

    /// Writes the state at time `t` within the span (outside it the interpolant is extrapolated).
    pub fn at(&self, t: f64, out: &mut [f64]) {
        if t == self.t {
            out.copy_from_slice(self.new);
        } else {
            self.interpolant.evaluate(self.old, (t - self.t_old) / (self.t - self.t_old), out);
        }
    }
}
