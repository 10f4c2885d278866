//! One step of the implicit method.

use super::tableau::{STAGES, Tableau};
use crate::linear::norm;
use motiform_dynamics::VectorField;
use motiform_dynamics::tangent::{Differentiable, jacobian};
use nalgebra::{DMatrix, Dyn, LU};

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
        let matrix = step.factors();
        let size = norm(u);
        let mut last = f64::INFINITY;
        for count in 0..ITERATIONS {
            let mut change = step.defect(u);
            if !matrix.solve_mut(&mut change) {
                return None;
            }
            for (to, by) in step.stages.iter_mut().zip(&change) {
                *to -= by;
            }
            let moved = change.norm();
            if moved <= SOLVED * size || moved <= STALLED * size && moved > 0.2 * last {
                return Some(step);
            }
            if !moved.is_finite() || count > 1 && moved > 0.9 * last {
                return None;
            }
            last = moved;
        }
        None
    }

    /// `U_i - u - h sum_j a_ij f(U_j)`, stage below stage.
    fn defect(&self, u: &[f64]) -> DMatrix<f64> {
        let dim = u.len();
        let mut rates = DMatrix::zeros(dim, STAGES);
        for (stage, mut rate) in self.stages.column_iter().zip(rates.column_iter_mut()) {
            VectorField::<f64>::eval(self.field, 0.0, stage.as_slice(), rate.as_mut_slice());
        }
        let weights = &Tableau::get().weights;
        DMatrix::from_fn(dim * STAGES, 1, |row, _| {
            let (i, k) = (row / dim, row % dim);
            let sum: f64 = (0..STAGES).map(|j| weights[i][j] * rates[(k, j)]).sum();
            self.stages[(k, i)] - u[k] - self.h * sum
        })
    }

    /// `I - h A (x) J`, each stage with its own Jacobian, as factors.
    fn factors(&self) -> LU<f64, Dyn, Dyn> {
        let (dim, weights) = (self.stages.nrows(), &Tableau::get().weights);
        let mut matrix = DMatrix::identity(dim * STAGES, dim * STAGES);
        for (j, stage) in self.stages.column_iter().enumerate() {
            let jacobian = jacobian(self.field, stage.as_slice());
            for (c, column) in jacobian.chunks_exact(dim).enumerate() {
                for (i, row) in weights.iter().enumerate() {
                    let mut to = matrix.view_mut((i * dim, j * dim + c), (dim, 1));
                    to.iter_mut().zip(column).for_each(|(to, x)| *to -= self.h * row[j] * x);
                }
            }
        }
        matrix.lu()
    }

    /// Moves vectors along: `W_i = w + h sum_j a_ij (J_j W_j + g_j)`, with `forced(U_j)` for the last ones. These are the derivatives of
    /// the step itself, exactly. `false` where they do not exist; the vectors then stay as they are.
    pub(super) fn carry(&self, vectors: &mut DMatrix<f64>, forced: &dyn Fn(&[f64]) -> Vec<Vec<f64>>) -> bool {
        let (dim, count) = vectors.shape();
        let forces: Vec<Vec<Vec<f64>>> = self.stages.column_iter().map(|u| forced(u.as_slice())).collect();
        let first = count - forces[0].len();
        let weights = &Tableau::get().weights;
        let mut all = DMatrix::from_fn(dim * STAGES, count, |row, c| {
            let (i, k) = (row / dim, row % dim);
            let force = |j: usize| weights[i][j] * forces[j][c - first][k];
            let sum = if c < first { 0.0 } else { (0..STAGES).map(force).sum() };
            vectors[(k, c)] + self.h * sum
        });
        let solved = self.factors().solve_mut(&mut all);
        if solved {
            vectors.copy_from(&all.rows(dim * (STAGES - 1), dim));
        }
        solved
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
}
