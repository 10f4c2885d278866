//! Small dense linear systems: the Karush-Kuhn-Tucker matrix of the closure.

use motiform_dynamics::Scalar;

/// Maximum number of unknowns: two per mode of the error function, and two multipliers.
pub(super) const MAX_UNKNOWNS: usize = 26;

/// A square matrix of up to [`MAX_UNKNOWNS`] rows.
pub(super) type Matrix = [[f64; MAX_UNKNOWNS]; MAX_UNKNOWNS];

/// The factors of a matrix by Gaussian elimination with row exchanges.
#[derive(Clone, Debug)]
pub(super) struct Factors {
    n: usize,
    rows: Matrix,
    exchanges: [usize; MAX_UNKNOWNS],
}

impl Factors {
    /// Factors the leading `n` rows and columns; `None` if the matrix is singular or not finite.
    #[inline(always)]
    pub(super) fn new(mut rows: Matrix, n: usize) -> Option<Self> {
        let mut exchanges = [0; MAX_UNKNOWNS];
        for column in 0..n {
            let pivot =
                (column..n).max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs()))?;
            if rows[pivot][column] == 0.0 || !rows[pivot][column].is_finite() {
                return None;
            }
            rows.swap(column, pivot);
            exchanges[column] = pivot;
            let top = rows[column];
            for row in &mut rows[column + 1..n] {
                let factor = row[column] / top[column];
                row[column] = factor;
                for (x, &y) in row[column + 1..n].iter_mut().zip(&top[column + 1..n]) {
                    *x -= factor * y;
                }
            }
        }
        Some(Self { n, rows, exchanges })
    }

    /// Solves for a right-hand side over any scalar, in place.
    #[inline(always)]
    pub(super) fn solve<T: Scalar>(&self, b: &mut [T]) {
        for row in 0..self.n {
            b.swap(row, self.exchanges[row]);
        }
        for row in 0..self.n {
            for below in row + 1..self.n {
                let change = b[row] * self.rows[below][row];
                b[below] -= change;
            }
        }
        for row in (0..self.n).rev() {
            for right in row + 1..self.n {
                let change = b[right] * self.rows[row][right];
                b[row] -= change;
            }
            b[row] = b[row] * (1.0 / self.rows[row][row]);
        }
    }
}
