//! Products and inverses of matrices of some tens of rows, with the same bits on every processor.

use motiform_dynamics::simd::{self, Kernel};
use nalgebra::DMatrix;

/// Columns of a part of a product that stays in registers.
const COLUMNS: usize = 4;

/// `c += factor a b`. Each entry is one sum in the order of the columns of `a`.
pub(super) fn add_product(c: &mut DMatrix<f64>, factor: f64, a: &DMatrix<f64>, b: &DMatrix<f64>) {
    let (rows, inner) = a.shape();
    simd::run(Product { c: c.as_mut_slice(), factor, a: a.as_slice(), b: b.as_slice(), rows, inner });
}

/// `a b`.
#[inline(never)]
pub(super) fn product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let mut c = DMatrix::zeros(a.nrows(), b.ncols());
    add_product(&mut c, 1.0, a, b);
    c
}

struct Product<'m> {
    c: &'m mut [f64],
    factor: f64,
    a: &'m [f64],
    b: &'m [f64],
    rows: usize,
    inner: usize,
}

impl Kernel for Product<'_> {
    type Output = ();

    #[inline(always)]
    fn run(mut self) {
        let columns = self.c.len() / self.rows.max(1);
        let whole = columns - columns % COLUMNS;
        for column in (0..whole).step_by(COLUMNS) {
            self.rows_of::<COLUMNS>(column);
        }
        for column in whole..columns {
            self.rows_of::<1>(column);
        }
    }
}

impl Product<'_> {
    /// All rows of so many columns, as many at a time as registers hold.
    #[inline(always)]
    fn rows_of<const C: usize>(&mut self, column: usize) {
        let mut row = 0;
        while row + 8 <= self.rows {
            self.tile::<8, C>(row, column);
            row += 8;
        }
        while row + 2 <= self.rows {
            self.tile::<2, C>(row, column);
            row += 2;
        }
        if row < self.rows {
            self.tile::<1, C>(row, column);
        }
    }

    #[inline(always)]
    fn tile<const R: usize, const C: usize>(&mut self, row: usize, column: usize) {
        let mut sums = [[0.0; R]; C];
        let b = &self.b[column * self.inner..][..C * self.inner];
        for k in 0..self.inner {
            let a = &self.a[k * self.rows + row..][..R];
            for j in 0..C {
                let x = b[j * self.inner + k];
                for i in 0..R {
                    sums[j][i] += a[i] * x;
                }
            }
        }
        for j in 0..C {
            let to = &mut self.c[(column + j) * self.rows + row..][..R];
            for i in 0..R {
                to[i] += self.factor * sums[j][i];
            }
        }
    }
}

/// The inverse of a square matrix, by Gauss-Jordan elimination in place with partial pivoting; `None` where it is singular or not finite.
#[inline(never)]
pub(super) fn inverse(mut a: DMatrix<f64>) -> Option<DMatrix<f64>> {
    let dim = a.nrows();
    let mut swaps = Vec::with_capacity(dim);
    for k in 0..dim {
        let pivot = (k..dim).max_by(|&i, &j| a[(i, k)].abs().total_cmp(&a[(j, k)].abs()))?;
        let value = a[(pivot, k)];
        if value == 0.0 || !value.is_finite() {
            return None;
        }
        a.swap_rows(k, pivot);
        swaps.push(pivot);
        simd::run(Exchange { a: a.as_mut_slice(), dim, k });
    }
    for (k, &pivot) in swaps.iter().enumerate().rev() {
        a.swap_columns(k, pivot);
    }
    Some(a)
}

/// Exchanges the `k`-th unknown with the `k`-th right side.
struct Exchange<'m> {
    a: &'m mut [f64],
    dim: usize,
    k: usize,
}

impl Kernel for Exchange<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { a, dim, k } = self;
        let (before, rest) = a.split_at_mut(k * dim);
        let (own, after) = rest.split_at_mut(dim);
        let pivot = own[k];
        own[k] = 0.0;
        for part in [before, after] {
            for column in part.chunks_exact_mut(dim) {
                let factor = column[k] / pivot;
                for (to, by) in column.iter_mut().zip(&*own) {
                    *to -= factor * by;
                }
                column[k] = factor;
            }
        }
        for x in &mut *own {
            *x /= -pivot;
        }
        own[k] = 1.0 / pivot;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(rows: usize, columns: usize, mut seed: u64) -> DMatrix<f64> {
        DMatrix::from_fn(rows, columns, |_, _| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) as f64 / f64::from(1_u32 << 30) - 1.0
        })
    }

    #[test]
    fn products_and_inverses_are_those_of_the_library() {
        for (rows, inner, columns) in [(1, 1, 1), (4, 4, 4), (7, 5, 9), (42, 42, 43)] {
            let (a, b) = (random(rows, inner, 1), random(inner, columns, 2));
            assert!((product(&a, &b) - &a * &b).norm() < 1e-13 * (rows * columns) as f64);
        }
        for dim in [1, 2, 5, 42] {
            let a = random(dim, dim, 3);
            let unit = product(&inverse(a.clone()).unwrap(), &a);
            assert!((unit - DMatrix::identity(dim, dim)).norm() < 1e-11, "{dim}");
        }
    }

    #[test]
    fn a_singular_matrix_has_no_inverse() {
        assert!(inverse(DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 2.0, 4.0])).is_none());
        assert!(inverse(DMatrix::from_row_slice(1, 1, &[f64::NAN])).is_none());
    }
}
