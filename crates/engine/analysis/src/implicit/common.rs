//! The equations of the stages with one Jacobian for all of them.

use super::modes::Mode;
use super::tableau::STAGES;
use nalgebra::{Complex, DMatrix, DVector, Dyn, LU};

/// `I - h A (x) J` in the basis of the eigenvectors of `A^-1`. There it is block diagonal, with a block `(lambda - h J) / lambda` for
/// each eigenvalue `lambda`. One eigenvalue is real; the others are two complex conjugate pairs, and the block of a conjugate needs no
/// factorisation of its own.
///
/// Source: Hairer and Wanner, Solving Ordinary Differential Equations II, section IV.8.
pub(super) struct Common {
    real: LU<f64, Dyn, Dyn>,
    pairs: [LU<Complex<f64>, Dyn, Dyn>; 2],
}

impl Common {
    /// For a step of `h` and the Jacobian `J`, column by column.
    pub(super) fn new(h: f64, jacobian: &[f64]) -> Self {
        let dim = jacobian.len().isqrt();
        let shifted = |value: Complex<f64>| {
            let of = |k: usize| Complex::new(-h * jacobian[k], 0.0);
            DMatrix::from_fn(dim, dim, |i, j| of(j * dim + i) + if i == j { value } else { 0.0.into() })
        };
        let [real, first, second] = Mode::all();
        Self {
            real: shifted(real.value).map(|entry| entry.re).lu(),
            pairs: [shifted(first.value).lu(), shifted(second.value).lu()],
        }
    }

    /// Replaces `right`, stage below stage, by the solution; `false` where there is none.
    pub(super) fn solve(&self, right: &mut DMatrix<f64>) -> bool {
        let dim = right.len() / STAGES;
        let [real, first, second] = Mode::all();
        let projected = |mode: &Mode| {
            let at = |k: usize| (0..STAGES).map(|i| mode.left[i] * right[i * dim + k]).sum::<Complex<f64>>();
            DVector::from_fn(dim, |k, _| mode.value * at(k))
        };
        let mut own = projected(real).map(|entry| entry.re);
        let mut pairs = [projected(first), projected(second)];
        let solved = self.real.solve_mut(&mut own);
        if !solved || !self.pairs.iter().zip(&mut pairs).all(|(matrix, side)| matrix.solve_mut(side)) {
            return false;
        }
        for (row, to) in right.iter_mut().enumerate() {
            let (i, k) = (row / dim, row % dim);
            let part = |mode: &Mode, of: &DVector<Complex<f64>>| 2.0 * (mode.right[i] * of[k]).re;
            *to = real.right[i].re * own[k] + part(first, &pairs[0]) + part(second, &pairs[1]);
        }
        true
    }
}
