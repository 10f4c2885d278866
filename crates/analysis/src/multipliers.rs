//! Floquet multipliers of the map of a period, with their errors.

use crate::graded::refined;
use crate::linear::{ComplexPair, eigenvalues};
use nalgebra::DMatrix;

/// The eigenvalues of a reduced map, largest modulus first.
pub(crate) fn multipliers(columns: &[Vec<f64>]) -> Option<Vec<ComplexPair>> {
    let mut values = eigenvalues(columns)?;
    values.sort_by(|a, b| libm::hypot(b.0, b.1).total_cmp(&libm::hypot(a.0, a.1)));
    Some(values)
}

/// How far the eigenvalues `values` of a map may be away where the map is wrong by `accuracy` of itself.
///
/// To first order `accuracy sum_i |y_i x_i| / |y . x|` with left and right eigenvectors; the root of it where they are orthogonal, as for a
/// multiple eigenvalue without a basis.
pub(crate) fn errors(map: &DMatrix<f64>, values: &[ComplexPair], accuracy: f64) -> Vec<f64> {
    let uncertain = DMatrix::from_diagonal_element(map.nrows(), map.nrows(), accuracy);
    let largest = map.norm().max(1.0);
    let error = |value: &ComplexPair| {
        let most = (accuracy * largest).sqrt();
        refined(map, &uncertain, *value).map_or(most, |found| found.error.min(most))
    };
    values.iter().map(error).collect()
}
