//! The equations of all stages in one matrix.

use super::tableau::{STAGES, Tableau};
use nalgebra::{DMatrix, Dyn, LU};

/// `I - h A (x) J` with a Jacobian for each stage, column by column, as factors.
pub(super) fn factors(h: f64, jacobians: &[Vec<f64>]) -> LU<f64, Dyn, Dyn> {
    let (dim, weights) = (jacobians[0].len().isqrt(), &Tableau::get().weights);
    let mut matrix = DMatrix::identity(dim * STAGES, dim * STAGES);
    for (j, jacobian) in jacobians.iter().enumerate() {
        for (c, column) in jacobian.chunks_exact(dim).enumerate() {
            for (i, row) in weights.iter().enumerate() {
                let mut to = matrix.view_mut((i * dim, j * dim + c), (dim, 1));
                to.iter_mut().zip(column).for_each(|(to, x)| *to -= h * row[j] * x);
            }
        }
    }
    matrix.lu()
}
