//! Eigenvalues of a linearisation with the errors of their real parts.

use crate::graded::{EPS, Eigenvalue, refined};
use crate::linear::{ComplexPair, complement, eigenvalues, leading_first};
use nalgebra::DMatrix;

/// Most eigenvalues that are refined one by one, from the leading one on.
const MOST: usize = 6;

/// Bound on the errors of the eigenvalues of a decomposition, for a matrix of this dimension with entries up
/// to `largest`.
pub fn rounding(dim: usize, largest: f64) -> f64 {
    30.0 * EPS * dim as f64 * largest
}

/// The eigenvalues of `matrix` across the orthonormal vectors `neutral`, largest real part first, and their errors.
pub(super) fn across(
    neutral: &[Vec<f64>],
    matrix: &DMatrix<f64>,
    entries: &DMatrix<f64>,
) -> Option<(Vec<ComplexPair>, Vec<f64>)> {
    within(&complement(neutral, matrix.nrows()), matrix, entries)
}

/// The eigenvalues of `Q^T A Q` for the orthonormal vectors Q, largest real part first, and the errors of their real parts where the
/// entries of A are wrong by up to `entries`.
///
/// A decomposition of the whole is good to the rounding of its largest entry, which may be faster than the leading rate by ten powers of
/// ten. The leading ones are therefore refined one by one, until one of them is clearly negative: no later one decides anything.
pub(super) fn within(
    vectors: &[Vec<f64>],
    matrix: &DMatrix<f64>,
    entries: &DMatrix<f64>,
) -> Option<(Vec<ComplexPair>, Vec<f64>)> {
    let q = super::matrix_of(vectors);
    let (inside, errors) = (q.transpose() * matrix * &q, q.abs().transpose() * entries * q.abs());
    let columns: Vec<Vec<f64>> = inside.column_iter().map(|c| c.iter().copied().collect()).collect();
    let values = eigenvalues(&columns)?;
    let all = rounding(values.len(), matrix.amax());
    let mut found: Vec<Eigenvalue> = values.iter().map(|&value| Eigenvalue { value, error: all }).collect();
    let mut place = 0;
    while place < found.len().min(MOST) {
        let guess = found[place].value;
        let pair = guess.1 != 0.0 && place + 1 < found.len();
        let moved = |new: &Eigenvalue| libm::hypot(new.value.0 - guess.0, new.value.1 - guess.1);
        if let Some(new) = refined(&inside, &errors, guess).filter(|new| moved(new) <= all.max(new.error)) {
            found[place] = new;
            if pair {
                found[place + 1] = Eigenvalue { value: (new.value.0, -new.value.1), ..new };
            }
        }
        if found[place].value.0 < -found[place].error {
            break;
        }
        place += 1 + usize::from(pair);
    }
    found.sort_by(|a, b| leading_first(&a.value, &b.value));
    Some(found.into_iter().map(|found| (found.value, found.error)).unzip())
}
