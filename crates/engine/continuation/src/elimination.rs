//! Linear equations whose matrix is mostly zeros.

use super::problem::Linear;

/// The last columns are dense: time, angle, parameter.
const TAIL: usize = 4;

/// Rows of a square system with two right sides behind them.
struct Rows {
    values: Vec<f64>,
    width: usize,
    dim: usize,
    /// Number of columns before the tail.
    body: usize,
    /// One after the last entry before the tail that is not 0, row by row.
    ends: Vec<usize>,
}

/// `x` and `y` with `matrix x = -residual`, `row . x = 0` and `matrix y = 0`, `row . y = 1`: Gaussian elimination with partial
/// pivoting that leaves out what is 0. The equations of the parts of an orbit meet only their own nodes, so that the work grows with the
/// square of their number and not with its cube. With the border of a family both are normal to it as well.
///
/// `None` where the matrix is singular or not finite.
pub(super) fn newton_step(linear: &Linear, row: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
    let mut rows = Rows::of(linear, row);
    for column in 0..rows.dim {
        rows.eliminate(column)?;
    }
    let (mut step, mut direction) = (rows.solution(0), rows.solution(1));
    [&mut step, &mut direction].into_iter().for_each(|x| x.truncate(row.len()));
    step.iter().chain(&direction).all(|x| x.is_finite()).then_some((step, direction))
}

impl Rows {
    fn of(linear: &Linear, row: &[f64]) -> Self {
        let (count, unknowns) = (linear.family.len(), row.len());
        let dim = unknowns + count;
        let width = dim + 2;
        let mut values = vec![0.0; dim * width];
        for (j, column) in linear.matrix.column_iter().enumerate() {
            for (i, &value) in column.iter().enumerate() {
                values[i * width + j] = value;
            }
        }
        for (i, residual) in linear.residual.iter().enumerate() {
            values[i * width + dim] = -residual;
        }
        for (k, border) in linear.family.iter().enumerate() {
            border.left.iter().enumerate().for_each(|(i, value)| values[i * width + unknowns + k] = *value);
            let from = (unknowns - 1 + k) * width;
            values[from..from + unknowns].copy_from_slice(&border.row);
        }
        let last = (dim - 1) * width;
        values[last..last + unknowns].copy_from_slice(row);
        values[last + dim + 1] = 1.0;
        let body = dim.saturating_sub(TAIL + count);
        let end = |row: &[f64]| row[..body].iter().rposition(|x| *x != 0.0).map_or(0, |last| last + 1);
        let ends = values.chunks_exact(width).map(end).collect();
        Self { values, width, dim, body, ends }
    }

    fn eliminate(&mut self, column: usize) -> Option<()> {
        let (width, dim) = (self.width, self.dim);
        let size = |i: usize| self.values[i * width + column].abs();
        let pivot = (column..dim).max_by(|&a, &b| size(a).total_cmp(&size(b)))?;
        if size(pivot) == 0.0 || !size(pivot).is_finite() {
            return None;
        }
        if pivot != column {
            let (above, below) = self.values.split_at_mut(pivot * width);
            above[column * width..(column + 1) * width].swap_with_slice(&mut below[..width]);
            self.ends.swap(pivot, column);
        }
        let end = self.ends[column].max(column + 1);
        let (body, tail) = (self.body, self.body.max(end));
        let (above, below) = self.values.split_at_mut((column + 1) * width);
        let above = &above[column * width..];
        for (row, row_end) in below.chunks_exact_mut(width).zip(&mut self.ends[column + 1..]) {
            if row[column] == 0.0 {
                continue;
            }
            let factor = row[column] / above[column];
            *row_end = (*row_end).max(end.min(body));
            for range in [column + 1..end, tail..width] {
                for (to, from) in row[range.clone()].iter_mut().zip(&above[range]) {
                    *to -= factor * from;
                }
            }
        }
        Some(())
    }

    fn solution(&self, side: usize) -> Vec<f64> {
        let mut x = vec![0.0; self.dim];
        for i in (0..self.dim).rev() {
            let row = &self.values[i * self.width..(i + 1) * self.width];
            let known: f64 = (i + 1..self.dim).map(|j| row[j] * x[j]).sum();
            x[i] = (row[self.dim + side] - known) / row[i];
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};

    /// Matrices with the pattern of an orbit's equations, and full ones, against a dense solution.
    #[test]
    fn solutions_are_those_of_a_dense_decomposition() {
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) as f64 / f64::from(1_u32 << 30) - 1.0
        };
        for (dim, block) in [(3, 3), (8, 8), (26, 6), (51, 6)] {
            let near = |i: usize, j: usize| {
                j + 3 >= dim
                    || i + 3 >= dim
                    || i / block == j / block
                    || (i / block + 1) % (dim / block) == j / block
            };
            let matrix = DMatrix::from_fn(dim - 1, dim, |i, j| if near(i, j) { random() } else { 0.0 });
            let residual: Vec<f64> = (0..dim - 1).map(|_| random()).collect();
            let row: Vec<f64> = (0..dim).map(|_| random()).collect();
            let mut square = matrix.clone().resize_vertically(dim, 0.0);
            row.iter().enumerate().for_each(|(j, x)| square[(dim - 1, j)] = *x);
            let mut right = DMatrix::zeros(dim, 2);
            residual.iter().enumerate().for_each(|(i, x)| right[(i, 0)] = -x);
            right[(dim - 1, 1)] = 1.0;
            let expected = square.lu().solve(&right).expect("it is regular");
            let (x, y) =
                newton_step(&Linear { residual, matrix, family: Vec::new() }, &row).expect("it is regular");
            let (x, y) = (DVector::from_vec(x), DVector::from_vec(y));
            assert!((&x - expected.column(0)).norm() < 1e-9 * (1.0 + x.norm()));
            assert!((&y - expected.column(1)).norm() < 1e-9 * (1.0 + y.norm()));
        }
        let singular = Linear {
            residual: vec![1.0],
            matrix: DMatrix::from_row_slice(1, 2, &[1.0, 1.0]),
            family: Vec::new(),
        };
        assert!(newton_step(&singular, &[2.0, 2.0]).is_none());
    }
}
