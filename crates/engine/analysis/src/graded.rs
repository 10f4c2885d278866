//! Linear equations whose rows differ by many powers of ten.
//!
//! The rates of a body's modes do: those of the cell grow as `k^6`. Each equation is divided by its largest entry before anything is
//! decomposed, so that what is small is measured against its own row.

use crate::linear::ComplexPair;
use crate::singular::svd;
use nalgebra::{ColPivQR, DMatrix, DVector, Dyn};

/// The unit roundoff of `f64`, twice.
pub(crate) const EPS: f64 = f64::EPSILON;

/// A decomposition of a square matrix whose rows were scaled to a largest entry of about 1.
pub(crate) struct Graded {
    qr: ColPivQR<f64, Dyn, Dyn>,
    /// The factors that the rows were multiplied by: powers of two, which round nothing.
    scales: Vec<f64>,
}

impl Graded {
    /// Of a square matrix; `None` where an entry is not finite or a row is 0.
    pub(crate) fn of(matrix: DMatrix<f64>) -> Option<Self> {
        let (matrix, scales) = scaled(matrix)?;
        Some(Self { qr: matrix.col_piv_qr(), scales })
    }

    /// The solution; `None` where the matrix is singular.
    pub(crate) fn solve(&self, rhs: &[f64]) -> Option<Vec<f64>> {
        let scaled = rhs.iter().zip(&self.scales).map(|(x, scale)| x * scale);
        let x = self.qr.solve(&DVector::from_iterator(rhs.len(), scaled))?;
        x.iter().all(|x| x.is_finite()).then(|| x.iter().copied().collect())
    }
}

/// `|A^-1| bounds`: how far the solution of `A x = b` may be away where equation i is wrong by up to
/// `bounds[i]`. Where A is singular to the last digit, the solutions are a family, and the distance is that
/// to the nearest one of them. `None` where an entry is not finite.
pub(crate) fn spread(matrix: DMatrix<f64>, bounds: &[f64]) -> Option<Vec<f64>> {
    let (matrix, scales) = scaled(matrix)?;
    let svd = svd(matrix)?;
    let least = SINGULAR * svd.singular_values.amax();
    let inverse = svd.pseudo_inverse(least).ok()?;
    let spread = |row: usize| {
        let parts = bounds.iter().zip(&scales).enumerate();
        parts.map(|(j, (bound, scale))| inverse[(row, j)].abs() * scale * bound).sum::<f64>()
    };
    let all: Vec<f64> = (0..bounds.len()).map(spread).collect();
    all.iter().all(|x| x.is_finite()).then_some(all)
}

/// The matrix with its rows scaled, and the factors; `None` where an entry is not finite.
fn scaled(mut matrix: DMatrix<f64>) -> Option<(DMatrix<f64>, Vec<f64>)> {
    let scales: Vec<f64> = matrix.row_iter().map(|row| scale(row.iter())).collect();
    if !matrix.iter().chain(&scales).all(|x| x.is_finite()) {
        return None;
    }
    matrix.row_iter_mut().zip(&scales).for_each(|(mut row, scale)| row *= *scale);
    Some((matrix, scales))
}

/// A singular value below this part of the largest is 0.
const SINGULAR: f64 = 1e-11;

/// The power of two that brings the largest of the entries to between 1/2 and 1; 1 where all are 0.
pub(crate) fn scale<'x>(entries: impl Iterator<Item = &'x f64>) -> f64 {
    let largest = entries.fold(0.0_f64, |largest, x| largest.max(x.abs()));
    if largest > 0.0 && largest.is_finite() { libm::ldexp(1.0, -libm::frexp(largest).1) } else { 1.0 }
}

/// An eigenvalue and how far its real part may be away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Eigenvalue {
    pub(crate) value: ComplexPair,
    pub(crate) error: f64,
}

/// Gains of a step of inverse iteration: twice is enough from an eigenvalue that is known to half of its digits.
const ITERATIONS: usize = 2;

/// Left and right eigenvectors that are more orthogonal than this belong to a multiple eigenvalue without a basis.
const DEFECTIVE: f64 = 1e-10;

/// One eigenvalue of `matrix` near `guess`, whose entries are wrong by up to `errors`: by inverse iteration with left and right vectors,
/// and to first order `|error| <= |y|^T E |x| / |y . x|`. `None` where the iteration fails.
///
/// Source: Wilkinson (1965), The Algebraic Eigenvalue Problem, chapter 2; Golub, Van Loan, Matrix Computations, 7.2.
pub(crate) fn refined(
    matrix: &DMatrix<f64>,
    errors: &DMatrix<f64>,
    guess: ComplexPair,
) -> Option<Eigenvalue> {
    let dim = matrix.nrows();
    let least = matrix.row_iter().map(|row| row.amax()).fold(f64::INFINITY, f64::min);
    let off = 1e-12 * (guess.0.abs() + guess.1.abs() + least);
    let pair = guess.1 != 0.0;
    let right = vector(matrix, (guess.0 + off, guess.1), pair)?;
    let left = vector(&matrix.transpose(), (guess.0 + off, -guess.1), pair)?;
    let image = product(matrix, &right, dim);
    let (above, below) = (inner(&left, &image, dim), inner(&left, &right, dim));
    let size = libm::hypot(below.0, below.1);
    if size.is_nan() || size < DEFECTIVE {
        return None;
    }
    let re = (above.0 * below.0 + above.1 * below.1) / (size * size);
    let im = (above.1 * below.0 - above.0 * below.1) / (size * size);
    let modulus = |v: &[f64], i: usize| libm::hypot(v[i], v.get(dim + i).copied().unwrap_or(0.0));
    let error = (0..dim)
        .map(|i| {
            let row: f64 = (0..dim).map(|j| errors[(i, j)] * modulus(&right, j)).sum();
            modulus(&left, i) * row
        })
        .sum::<f64>()
        / size;
    let im = if pair { im } else { 0.0 };
    (re.is_finite() && error.is_finite()).then_some(Eigenvalue { value: (re, im), error })
}

/// A unit vector with `A x = shift x` nearly, real parts before imaginary ones.
fn vector(matrix: &DMatrix<f64>, shift: ComplexPair, pair: bool) -> Option<Vec<f64>> {
    let dim = matrix.nrows();
    let size = if pair { 2 * dim } else { dim };
    let entry = |i: usize, j: usize| match (i / dim == j / dim, i % dim == j % dim) {
        (true, same) => matrix[(i % dim, j % dim)] - if same { shift.0 } else { 0.0 },
        (false, true) => {
            if i < dim {
                shift.1
            } else {
                -shift.1
            }
        }
        (false, false) => 0.0,
    };
    let graded = Graded::of(DMatrix::from_fn(size, size, entry))?;
    let mut x: Vec<f64> = (0..size).map(|i| 1.0 / (1.0 + 0.618 * i as f64)).collect();
    for _ in 0..ITERATIONS {
        x = graded.solve(&x)?;
        let length = crate::linear::norm(&x);
        x.iter_mut().for_each(|x| *x /= length);
    }
    Some(x)
}

/// `A x`.
fn product(matrix: &DMatrix<f64>, x: &[f64], dim: usize) -> Vec<f64> {
    let part = |part: &[f64]| (matrix * DVector::from_column_slice(part)).iter().copied().collect::<Vec<_>>();
    x.chunks_exact(dim).flat_map(part).collect()
}

/// `conj(y) . x`.
fn inner(y: &[f64], x: &[f64], dim: usize) -> ComplexPair {
    let dot = crate::linear::dot;
    let (real, imaginary) = (|v: &'_ [f64]| v[..dim].to_vec(), |v: &'_ [f64]| v[dim..].to_vec());
    if x.len() == dim {
        return (dot(y, x), 0.0);
    }
    let (yr, yi, xr, xi) = (real(y), imaginary(y), real(x), imaginary(x));
    (dot(&yr, &xr) + dot(&yi, &xi), dot(&yr, &xi) - dot(&yi, &xr))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A slow rate beside fast ones of 1e12: a balanced decomposition alone would lose it in their rounding.
    #[test]
    fn slow_eigenvalues_keep_their_digits_beside_fast_ones() {
        let rates: [f64; 5] = [-0.3, -2.0, -1e4, -1e8, -1e12];
        // lower triangular rows of their own size: the eigenvalues are those of the diagonal
        let entry = |i: usize, j: usize| match i.cmp(&j) {
            std::cmp::Ordering::Equal => rates[i],
            std::cmp::Ordering::Greater => 0.3 * rates[i],
            std::cmp::Ordering::Less => 0.0,
        };
        let matrix = DMatrix::from_fn(5, 5, entry);
        let errors = matrix.map(|x| 4.0 * EPS * x.abs());
        let found = refined(&matrix, &errors, (-0.3 + 1e-4, 0.0)).unwrap();
        assert!((found.value.0 + 0.3).abs() <= found.error.max(1e-15), "{found:?}");
        assert!(found.error < 1e-13, "{found:?}");
    }

    /// A rotation that decays: a pair, from a guess that is wrong in the sixth digit; the error bound covers a change of the entries.
    #[test]
    fn pairs_are_refined_and_their_errors_cover_changes_of_the_entries() {
        let matrix: DMatrix<f64> =
            DMatrix::from_row_slice(3, 3, &[-0.1, -2.0, 0.5, 2.0, -0.1, 0.7, 0.0, 0.0, -3.0]);
        let errors = matrix.map(|x| 1e-3 * x.abs());
        let found = refined(&matrix, &errors, (-0.100_001, 2.000_001)).unwrap();
        assert!((found.value.0 + 0.1).abs() < 1e-13 && (found.value.1 - 2.0).abs() < 1e-13, "{found:?}");
        for signs in 0..512_u32 {
            let sign = |i: usize, j: usize| if signs >> (3 * i + j) & 1 == 1 { 1.0 } else { -1.0 };
            let changed = DMatrix::from_fn(3, 3, |i, j| matrix[(i, j)] + sign(i, j) * errors[(i, j)]);
            let values = changed.complex_eigenvalues();
            let nearest = values.iter().map(|z| z.re).fold(f64::NEG_INFINITY, f64::max);
            assert!((nearest + 0.1).abs() <= 1.01 * found.error, "{nearest} {found:?}");
        }
    }
}
