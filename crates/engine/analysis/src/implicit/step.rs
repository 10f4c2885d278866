//! One step of the implicit method.

use super::common::Common;
use super::tableau::{STAGES, Tableau};
use super::vectors::Vectors;
use super::{FEW, whole};
use crate::linear::norm;
use motiform_dynamics::VectorField;
use motiform_dynamics::tangent::{Differentiable, jacobian};
use nalgebra::DMatrix;

/// Iterations that the stages may take.
const ITERATIONS: usize = 15;

/// Part of the size of a state to which the stages are solved where round-off allows.
const SOLVED: f64 = 1e-14;

/// Above this part a stalled iteration is no solution.
const STALLED: f64 = 1e-11;

/// `U_i = u + h sum_j a_ij f(U_j)`: the states of the stages, column by column, and their equations' derivatives.
pub(super) struct Step<'f, F: ?Sized> {
    field: &'f F,
    h: f64,
    pub(super) stages: DMatrix<f64>,
}

impl<'f, F: VectorField<f64> + Differentiable + ?Sized> Step<'f, F> {
    /// The stages of a step of `h` from `u`, from the guess `stages`; `None` where they are not found.
    pub(super) fn solve(field: &'f F, h: f64, u: &[f64], stages: DMatrix<f64>) -> Option<Self> {
        let mut step = Self { field, h, stages };
        if u.len() > FEW {
            let guess = step.stages.clone();
            let middle = jacobian(field, guess.column(STAGES / 2).as_slice());
            let common = Common::new(h, &middle);
            if step.iterate(u, &|change| common.solve(change)) {
                return Some(step);
            }
            step.stages = guess;
        }
        let matrix = whole::factors(h, &step.jacobians());
        step.iterate(u, &|change| matrix.solve_mut(change)).then_some(step)
    }

    /// Newton's method with one matrix, whose equations `solve` solves in place; `false` where the stages are not found.
    fn iterate(&mut self, u: &[f64], solve: &dyn Fn(&mut DMatrix<f64>) -> bool) -> bool {
        let size = norm(u);
        let mut last = f64::INFINITY;
        for count in 0..ITERATIONS {
            let mut change = self.defect(u);
            if !solve(&mut change) {
                return false;
            }
            for (to, by) in self.stages.iter_mut().zip(&change) {
                *to -= by;
            }
            let moved = change.norm();
            if moved <= SOLVED * size || moved <= STALLED * size && moved > 0.2 * last {
                return true;
            }
            if !moved.is_finite() || count > 1 && moved > 0.9 * last {
                return false;
            }
            last = moved;
        }
        false
    }

    /// `U_i - u - h sum_j a_ij f(U_j)`, stage below stage.
    fn defect(&self, u: &[f64]) -> DMatrix<f64> {
        let dim = u.len();
        let mut rates = DMatrix::zeros(dim, STAGES);
        for (stage, mut rate) in self.stages.column_iter().zip(rates.column_iter_mut()) {
            VectorField::<f64>::eval(self.field, 0.0, stage.as_slice(), rate.as_mut_slice());
        }
        left(self.h, u, &self.stages, &rates)
    }

    /// The Jacobians at the stages.
    fn jacobians(&self) -> Vec<Vec<f64>> {
        self.stages.column_iter().map(|u| jacobian(self.field, u.as_slice())).collect()
    }

    /// Moves vectors along, with `forced(U_j)` on the last ones. These are the derivatives of the step itself, exactly. `false` where they
    /// do not exist; the vectors then stay as they are.
    pub(super) fn carry(&self, vectors: &mut DMatrix<f64>, forced: &dyn Fn(&[f64]) -> Vec<Vec<f64>>) -> bool {
        let forces: Vec<_> = self.stages.column_iter().map(|u| forced(u.as_slice())).collect();
        let step = Vectors { h: self.h, jacobians: &self.jacobians(), forces: &forces };
        let last = step.carried(vectors);
        last.inspect(|last| vectors.copy_from(last)).is_some()
    }

    /// The state at the end of the step.
    pub(super) fn end(&self) -> Vec<f64> {
        self.stages.column(STAGES - 1).as_slice().to_vec()
    }

    /// The polynomial through `u` and the stages at `times` (in steps), column by column.
    pub(super) fn continued(&self, u: &[f64], times: impl Iterator<Item = f64>) -> DMatrix<f64> {
        let columns: Vec<_> = times.map(|c| self.combined(u, &Tableau::get().lagrange(c))).collect();
        DMatrix::from_fn(u.len(), columns.len(), |k, i| columns[i][k])
    }

    /// The size of the polynomial's fifth power over the step.
    pub(super) fn roughness(&self, u: &[f64]) -> f64 {
        norm(&self.combined(u, &Tableau::get().leading))
    }

    fn combined(&self, u: &[f64], factors: &[f64; STAGES + 1]) -> Vec<f64> {
        let stage = |k: usize| (0..STAGES).map(|j| factors[j + 1] * self.stages[(k, j)]).sum::<f64>();
        u.iter().enumerate().map(|(k, x)| factors[0] * x + stage(k)).collect()
    }
}

/// The residual of the equations at stages and their rates.
fn left(h: f64, u: &[f64], stages: &DMatrix<f64>, rates: &DMatrix<f64>) -> DMatrix<f64> {
    let (dim, weights) = (u.len(), &Tableau::get().weights);
    DMatrix::from_fn(dim * STAGES, 1, |row, _| {
        let (i, k) = (row / dim, row % dim);
        let sum: f64 = (0..STAGES).map(|j| weights[i][j] * rates[(k, j)]).sum();
        stages[(k, i)] - u[k] - h * sum
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use motiform_dynamics::{Scalar, System};

    /// `z' = i z`.
    struct Turning;

    impl System for Turning {
        fn dim(&self) -> usize {
            2
        }
    }

    impl<T: Scalar> VectorField<T> for Turning {
        fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
            du.copy_from_slice(&[-u[1], u[0]]);
        }
    }

    /// After a step, how far the state is from the exact one.
    fn error_of_step(h: f64) -> f64 {
        let guess = DMatrix::from_fn(2, STAGES, |k, _| if k == 0 { 1.0 } else { 0.0 });
        let step = Step::solve(&Turning, h, &[1.0, 0.0], guess).expect("a linear field");
        let end = step.stages.column(STAGES - 1);
        (end[0] - h.cos()).hypot(end[1] - h.sin())
    }

    #[test]
    fn a_step_has_an_error_of_order_10() {
        let slope = (error_of_step(1.0) / error_of_step(0.7)).log(1.0 / 0.7);
        assert!((slope - 10.0).abs() < 0.1, "{slope}");
    }

    /// `u_k' = rate_k u_k + u_(k-1) u_(k+1)`, in a circle.
    struct Chain(Vec<f64>);

    impl System for Chain {
        fn dim(&self) -> usize {
            self.0.len()
        }
    }

    impl<T: Scalar> VectorField<T> for Chain {
        fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
            let dim = u.len();
            for (k, rate) in self.0.iter().enumerate() {
                du[k] = u[k] * *rate + u[(k + 1) % dim] * u[(k + dim - 1) % dim];
            }
        }
    }

    fn begun(chain: &Chain, h: f64) -> (Vec<f64>, Step<'_, Chain>) {
        let start: Vec<f64> = (0..chain.0.len()).map(|k| (1.0 + k as f64).sin()).collect();
        let stages = DMatrix::from_fn(start.len(), STAGES, |k, _| start[k]);
        (start, Step { field: chain, h, stages })
    }

    /// Rates up to a million times the step: what stays stiff is solved to round-off.
    #[test]
    fn stages_do_not_depend_on_the_elimination() {
        let stiff = Chain((0..21).map(|k| 1.0 - 10.0 * f64::from(k).powi(4)).collect());
        let (start, mut once) = begun(&stiff, 0.3);
        let quick = Step::solve(&stiff, 0.3, &start, once.stages.clone()).expect("stages");
        let matrix = whole::factors(0.3, &once.jacobians());
        assert!(once.iterate(&start, &|change| matrix.solve_mut(change)));
        assert!((&quick.stages - &once.stages).norm() < 1e-13 * once.stages.norm());
    }
}
