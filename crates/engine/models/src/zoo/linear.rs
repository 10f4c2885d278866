//! A linear field.

use motiform_dynamics::{Scalar, VectorField};

/// A linear field u' = A u.
///
/// The exponents are the real parts of the eigenvalues of A; u(t) = exp(A t) u(0).
///
/// Source: elementary.
///
/// # Checked by  tests/all/zoo.rs: a Jordan block (exact), a spiral
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear<const N: usize> {
    /// Rows of A.
    pub rows: [[f64; N]; N],
}

crate::plain!(Linear<N>, N, const N);

impl<T: Scalar, const N: usize> VectorField<T> for Linear<N> {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        for (rate, row) in du.iter_mut().zip(&self.rows) {
            *rate = u[0].zero(); // N = 0 has no row
            for (&x, &a) in u.iter().zip(row) {
                *rate += x * a;
            }
        }
    }
}
