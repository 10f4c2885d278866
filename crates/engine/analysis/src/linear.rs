//! The little linear algebra that analyses need; sums in a fixed order, so that results depend on no machine.

use super::singular::svd;
use nalgebra::{DMatrix, DVector, Dyn, SVD};

/// A complex number `(re, im)`.
pub type ComplexPair = (f64, f64);

/// `sum_i a_i b_i`.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Euclidean length.
pub fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// `a += factor b`.
pub fn add(a: &mut [f64], factor: f64, b: &[f64]) {
    for (x, y) in a.iter_mut().zip(b) {
        *x += factor * y;
    }
}

/// Takes from a vector what lies along `others`, which are orthonormal (Gram-Schmidt, twice is enough); its lengths before and after.
fn clean<V: AsRef<[f64]>>(vector: &mut [f64], others: &[V]) -> (f64, f64) {
    let before = norm(vector);
    for _ in 0..2 {
        for other in others {
            let along = dot(other.as_ref(), vector);
            add(vector, -along, other.as_ref());
        }
    }
    (before, norm(vector))
}

/// Makes the vectors orthonormal in order and returns the lengths that were divided out: the diagonal of R. A vector that depends on
/// the earlier ones becomes 0, with length 0. (`lyapunov/frame` does the same in lanes, with the rates of the vectors.)
pub fn orthonormalise(vectors: &mut [&mut [f64]]) -> Vec<f64> {
    let mut lengths = Vec::with_capacity(vectors.len());
    for k in 0..vectors.len() {
        let (done, rest) = vectors.split_at_mut(k);
        let (before, length) = clean(rest[0], done);
        let kept = if length > 1e-14 * before { length } else { 0.0 };
        let factor = if kept > 0.0 { 1.0 / length } else { 0.0 };
        rest[0].iter_mut().for_each(|x| *x *= factor);
        lengths.push(kept);
    }
    lengths
}

/// An orthonormal basis of what the columns span (those that depend on earlier ones are left out).
pub fn basis(columns: &[&[f64]], least: f64) -> Vec<Vec<f64>> {
    let mut out: Vec<Vec<f64>> = Vec::new();
    for column in columns {
        let mut vector = column.to_vec();
        let (before, length) = clean(&mut vector, &out);
        if length > least * before && length > 0.0 {
            vector.iter_mut().for_each(|x| *x /= length);
            out.push(vector);
        }
    }
    out
}

/// The smallest `x` that minimises `|sum_j columns_j x_j - rhs|`, by singular values above `1e-10` of the largest.
/// `None` where a number is not finite.
pub fn least_squares(columns: &[Vec<f64>], rhs: &[f64]) -> Option<Vec<f64>> {
    let svd = svd(finite(columns, rhs)?)?;
    let least = 1e-10 * largest(&svd);
    let x = svd.solve(&DVector::from_column_slice(rhs), least).ok()?;
    Some(x.iter().copied().collect())
}

/// The `x` with `sum_j columns_j x_j = rhs`, by a QR decomposition with pivots. `None` where the system is not square, a number is not
/// finite, or an entry on the diagonal of `R` is at most the part `least` of the largest: the columns then depend on one another.
pub fn solve(columns: &[Vec<f64>], rhs: &[f64], least: f64) -> Option<Vec<f64>> {
    let matrix = finite(columns, rhs).filter(DMatrix::is_square)?;
    let qr = matrix.col_piv_qr();
    let diagonal = qr.r().diagonal().abs();
    if diagonal.min() <= least * diagonal.max() {
        return None;
    }
    let x = qr.solve(&DVector::from_column_slice(rhs))?;
    Some(x.iter().copied().collect())
}

/// An orthonormal basis of the `count` directions that `sum_j columns_j x_j` is smallest in: the right
/// singular vectors of the smallest singular values. `None` where a number is not finite.
pub fn null_space(columns: &[Vec<f64>], count: usize) -> Option<Vec<Vec<f64>>> {
    let matrix = finite(columns, &vec![0.0; columns.len()])?;
    let rows = svd(matrix)?.v_t?;
    let first = rows.nrows().saturating_sub(count);
    Some((first..rows.nrows()).map(|i| rows.row(i).iter().copied().collect()).collect())
}

/// The matrix of these columns; `None` where one of its numbers, or one of `rhs`, is not finite.
fn finite(columns: &[Vec<f64>], rhs: &[f64]) -> Option<DMatrix<f64>> {
    let matrix = DMatrix::from_fn(rhs.len(), columns.len(), |i, j| columns[j][i]);
    matrix.iter().chain(rhs).all(|x| x.is_finite()).then_some(matrix)
}

fn largest(svd: &SVD<f64, Dyn, Dyn>) -> f64 {
    svd.singular_values.iter().copied().fold(0.0, f64::max)
}

/// The order of eigenvalues: largest real part first, then largest modulus of the imaginary part, so that conjugates stay together where
/// several real parts are the same.
pub(crate) fn leading_first(a: &ComplexPair, b: &ComplexPair) -> std::cmp::Ordering {
    b.0.total_cmp(&a.0).then(b.1.abs().total_cmp(&a.1.abs())).then(b.1.total_cmp(&a.1))
}

/// Sorts eigenvalues: the leading one, whose real part is the largest, first; then by the modulus of the imaginary part.
#[inline(never)]
pub fn sort_leading(values: &mut [ComplexPair]) {
    values.sort_unstable_by(leading_first);
}

/// The eigenvalues of a matrix given by its columns, the leading one first. `None` where one is not finite or the iteration does not end.
pub fn eigenvalues(columns: &[Vec<f64>]) -> Option<Vec<ComplexPair>> {
    let dim = columns.len();
    let matrix = DMatrix::from_fn(dim, dim, |i, j| columns[j][i]);
    if dim == 0 || !matrix.iter().all(|x| x.is_finite()) {
        return (dim == 0).then(Vec::new);
    }
    // where eigenvalues are equal its steps may not converge
    let schur = nalgebra::linalg::Schur::try_new(matrix, f64::EPSILON, 100 * dim.max(10));
    let mut values = match schur {
        Some(schur) => schur.complex_eigenvalues().iter().map(|z| (z.re, z.im)).collect(),
        None => motiform_dynamics::eigenvalues::eigenvalues(columns)?,
    };
    sort_leading(&mut values);
    Some(values)
}

/// `basis^T A basis`, with the columns of `A` applied by `act`.
pub fn restrict(basis: &[Vec<f64>], act: impl Fn(&[f64]) -> Vec<f64>) -> Vec<Vec<f64>> {
    basis
        .iter()
        .map(|column| {
            let image = act(column);
            basis.iter().map(|row| dot(row, &image)).collect()
        })
        .collect()
}

/// `A x` for a matrix stored column by column.
pub fn apply(matrix: &[f64], x: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; x.len()];
    for (column, &factor) in matrix.chunks_exact(x.len()).zip(x) {
        add(&mut out, factor, column);
    }
    out
}

/// Unit vectors that complete `fixed` (orthonormal) to a basis of the whole space: `dim - fixed.len()` of them, whatever the sizes of the
/// components of `fixed`.
///
/// The columns of `H_1 .. H_m` after the first `m`, with the reflections `H_k = 1 - 2 v_k v_k^T` that turn the vectors of `fixed` into
/// the first unit vectors (Householder). Source: Golub and Van Loan (2013), section 5.2.
pub fn complement(fixed: &[Vec<f64>], dim: usize) -> Vec<Vec<f64>> {
    let mut mirrors: Vec<Vec<f64>> = Vec::new();
    for (k, vector) in fixed.iter().take(dim).enumerate() {
        let mut normal = vector.clone();
        mirrors.iter().for_each(|mirror| reflect(mirror, &mut normal));
        normal[..k].fill(0.0);
        normal[k] += norm(&normal).copysign(normal[k]);
        let length = norm(&normal);
        normal.iter_mut().for_each(|x| *x /= length);
        mirrors.push(normal);
    }
    let column = |i: usize| {
        let mut unit = vec![0.0; dim];
        unit[i] = 1.0;
        mirrors.iter().rev().for_each(|mirror| reflect(mirror, &mut unit));
        unit
    };
    (mirrors.len()..dim).map(column).collect()
}

/// `x -= 2 (normal . x) normal`.
fn reflect(normal: &[f64], x: &mut [f64]) {
    let along = dot(normal, x);
    add(x, -2.0 * along, normal);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against singular values, and where a column is nearly the sum of two others.
    #[test]
    fn square_systems_are_solved_unless_they_are_singular() {
        let entry = |i: usize, j: usize| libm::sin((i * i * j + 5 * i + 3 * j + 1) as f64);
        let columns: Vec<Vec<f64>> = (0..6).map(|j| (0..6).map(|i| entry(i, j)).collect()).collect();
        let rhs: Vec<f64> = (0..6).map(|i| libm::cos(f64::from(i))).collect();
        let (x, expected) = (solve(&columns, &rhs, 1e-14).unwrap(), least_squares(&columns, &rhs).unwrap());
        assert!(
            x.iter().zip(&expected).all(|(x, y)| (x - y).abs() < 1e-10 * norm(&expected)),
            "{x:?} {expected:?}"
        );
        let dependent = |off: f64| {
            let mut columns = columns.clone();
            columns[5] = (0..6).map(|i| columns[0][i] + columns[1][i] + off * columns[5][i]).collect();
            solve(&columns, &rhs, 1e-8)
        };
        assert!(dependent(1e-10).is_none() && dependent(1e-4).is_some());
        assert!(solve(&columns[..5], &rhs, 1e-14).is_none());
        assert!(solve(&columns, &[f64::NAN; 6], 1e-14).is_none());
    }

    /// Components that fall by powers of ten, down to round-off: as the modes of a smooth shape do.
    #[test]
    fn a_complement_has_all_directions_but_the_fixed_ones() {
        let dim = 42;
        for base in [1.0, 1.7, 3.0, 5.5, 10.0, 60.0] {
            let graded = |k: i32| -> Vec<f64> {
                (0..dim).map(|i| libm::sin(f64::from(3 * i + k)) * f64::powi(base, -i)).collect()
            };
            let columns = [graded(1), graded(4)];
            let fixed = basis(&[&columns[0], &columns[1]], 1e-6);
            let all: Vec<Vec<f64>> = fixed.iter().cloned().chain(complement(&fixed, dim as usize)).collect();
            assert_eq!(all.len(), dim as usize, "{base}");
            for (i, a) in all.iter().enumerate() {
                for (j, b) in all.iter().enumerate() {
                    let expected = f64::from(u8::from(i == j));
                    assert!((dot(a, b) - expected).abs() < 1e-14, "{base} {i} {j}: {}", dot(a, b));
                }
            }
        }
    }
}
