//! Products and inverses of matrices of some tens of rows, with the same bits on every processor.

use nalgebra::DMatrix;

/// Rows and columns of a part of a product that stays in registers.
const TILE: usize = 4;

/// `c += factor a b`. Each entry is one sum in the order of the columns of `a`.
pub(super) fn add_product(c: &mut DMatrix<f64>, factor: f64, a: &DMatrix<f64>, b: &DMatrix<f64>) {
    let (rows, inner) = a.shape();
    for (to, from) in c.as_mut_slice().chunks_mut(TILE * rows).zip(b.as_slice().chunks(TILE * inner)) {
        if from.len() == TILE * inner {
            tiles(to, factor, a.as_slice(), from, (rows, inner));
        } else {
            for (to, from) in to.chunks_exact_mut(rows).zip(from.chunks_exact(inner)) {
                column(to, factor, a.as_slice(), from);
            }
        }
    }
}

/// `a b`.
pub(super) fn product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let mut c = DMatrix::zeros(a.nrows(), b.ncols());
    add_product(&mut c, 1.0, a, b);
    c
}

/// As many columns as a tile has.
fn tiles(c: &mut [f64], factor: f64, a: &[f64], b: &[f64], (rows, inner): (usize, usize)) {
    let whole = rows - rows % TILE;
    for row in (0..whole).step_by(TILE) {
        let mut sums = [[0.0; TILE]; TILE];
        for k in 0..inner {
            let part: [f64; TILE] = std::array::from_fn(|i| a[k * rows + row + i]);
            for (j, sum) in sums.iter_mut().enumerate() {
                let x = b[j * inner + k];
                sum.iter_mut().zip(&part).for_each(|(sum, a)| *sum += a * x);
            }
        }
        for (j, sum) in sums.iter().enumerate() {
            let to = &mut c[j * rows + row..][..TILE];
            to.iter_mut().zip(sum).for_each(|(to, sum)| *to += factor * sum);
        }
    }
    for row in whole..rows {
        for j in 0..TILE {
            let sum: f64 = (0..inner).map(|k| a[k * rows + row] * b[j * inner + k]).sum();
            c[j * rows + row] += factor * sum;
        }
    }
}

fn column(c: &mut [f64], factor: f64, a: &[f64], b: &[f64]) {
    let mut sums = vec![0.0; c.len()];
    for (part, &x) in a.chunks_exact(c.len()).zip(b) {
        sums.iter_mut().zip(part).for_each(|(sum, a)| *sum += a * x);
    }
    c.iter_mut().zip(&sums).for_each(|(to, sum)| *to += factor * sum);
}

/// The inverse of a square matrix, by Gauss-Jordan elimination in place with partial pivoting; `None` where it is singular or not finite.
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
        eliminate(a.as_mut_slice(), dim, k);
    }
    for (k, &pivot) in swaps.iter().enumerate().rev() {
        a.swap_columns(k, pivot);
    }
    Some(a)
}

/// Exchanges the `k`-th unknown with the `k`-th right side.
fn eliminate(a: &mut [f64], dim: usize, k: usize) {
    let (before, rest) = a.split_at_mut(k * dim);
    let (own, after) = rest.split_at_mut(dim);
    let pivot = own[k];
    own[k] = 0.0;
    for column in before.chunks_exact_mut(dim).chain(after.chunks_exact_mut(dim)) {
        let factor = column[k] / pivot;
        column.iter_mut().zip(&*own).for_each(|(to, by)| *to -= factor * by);
        column[k] = factor;
    }
    own.iter_mut().for_each(|x| *x /= -pivot);
    own[k] = 1.0 / pivot;
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
