//! Vectors over a step.

use super::blocks::Blocks;
use super::tableau::{STAGES, Tableau};
use super::{FEW, whole};
use nalgebra::DMatrix;

/// Vectors that a step of `h` carries along: `W_i = w + h sum_j a_ij (J_j W_j + g_j)`, with the Jacobians of the stages, column by
/// column, and the forces of each stage on the last vectors.
pub(super) struct Vectors<'v> {
    pub(super) h: f64,
    pub(super) jacobians: &'v [Vec<f64>],
    pub(super) forces: &'v [Vec<Vec<f64>>],
}

impl Vectors<'_> {
    /// The last stage; `None` where the equations have no solution.
    pub(super) fn carried(&self, vectors: &DMatrix<f64>) -> Option<DMatrix<f64>> {
        let last = if vectors.nrows() > FEW { self.by_blocks(vectors) } else { None };
        last.or_else(|| self.at_once(vectors))
    }

    /// Stage by stage.
    fn by_blocks(&self, vectors: &DMatrix<f64>) -> Option<DMatrix<f64>> {
        let first = vectors.ncols() - self.forces[0].len();
        let side = |i: usize| {
            let mut side = vectors * Tableau::get().inverse[i].iter().sum::<f64>();
            for (c, force) in self.forces[i].iter().enumerate() {
                side.column_mut(first + c).iter_mut().zip(force).for_each(|(to, x)| *to += self.h * x);
            }
            side
        };
        Blocks::new(self.h, self.jacobians).last_stage(&std::array::from_fn::<_, STAGES, _>(side))
    }

    /// With all equations in one matrix.
    fn at_once(&self, vectors: &DMatrix<f64>) -> Option<DMatrix<f64>> {
        let (dim, count) = vectors.shape();
        let first = count - self.forces[0].len();
        let weights = &Tableau::get().weights;
        let mut all = DMatrix::from_fn(dim * STAGES, count, |row, c| {
            let (i, k) = (row / dim, row % dim);
            let force = |j: usize| weights[i][j] * self.forces[j][c - first][k];
            let sum = if c < first { 0.0 } else { (0..STAGES).map(force).sum() };
            vectors[(k, c)] + self.h * sum
        });
        let matrix = whole::factors(self.h, self.jacobians);
        matrix.solve_mut(&mut all).then(|| all.rows(dim * (STAGES - 1), dim).into_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sine(k: usize) -> f64 {
        (1.0 + k as f64).sin()
    }

    /// Rates up to a million times the step: what stays stiff is solved to round-off.
    #[test]
    fn vectors_do_not_depend_on_the_elimination() {
        const DIM: usize = 21;
        let jacobian = |stage: usize| {
            let entry = |k: usize| {
                let (row, column) = (k % DIM, k / DIM);
                let rate = if row == column { 1.0 - 10.0 * (row as f64).powi(4) } else { 0.0 };
                rate + sine(k + 7 * stage)
            };
            (0..DIM * DIM).map(entry).collect()
        };
        let jacobians: Vec<Vec<f64>> = (0..STAGES).map(jacobian).collect();
        let force: Vec<f64> = (0..DIM).map(sine).collect();
        let forces = vec![vec![force, vec![1.0; DIM]]; STAGES];
        let step = Vectors { h: 0.3, jacobians: &jacobians, forces: &forces };
        let vectors = DMatrix::identity(DIM, DIM + 2);
        let blocks = step.by_blocks(&vectors).expect("vectors");
        let all = step.at_once(&vectors).expect("vectors");
        assert!((&blocks - &all).norm() < 1e-12 * all.norm(), "{:e}", (blocks - all).norm());
    }

    /// A growth at which a stage alone has no solution, or none with many digits: all of them together do.
    #[test]
    fn a_small_pivot_costs_no_digits() {
        const DIM: usize = FEW + 1;
        for off in [0.0, 1e-13, 1e-9, 1e-5] {
            let rate = Tableau::get().inverse[0][0] * (1.0 + off);
            let jacobians = vec![DMatrix::from_diagonal_element(DIM, DIM, rate).as_slice().to_vec(); STAGES];
            let forces = vec![Vec::new(); STAGES];
            let step = Vectors { h: 1.0, jacobians: &jacobians, forces: &forces };
            let vectors = DMatrix::identity(DIM, DIM);
            let (found, all) = (step.carried(&vectors), step.at_once(&vectors));
            let (found, all) = (found.expect("vectors"), all.expect("vectors"));
            assert!((&found - &all).norm() < 1e-9 * all.norm(), "{off:e}: {:e}", (found - all).norm());
        }
    }
}
