//! Floquet multipliers of the map of a period, with their errors.

use crate::graded::refined;
use crate::linear::{ComplexPair, eigenvalues};
use crate::lyapunov::SplitMix;
use crate::product::logarithms_of_product;
use motiform_dynamics::sample::sort_by_number;
use nalgebra::DMatrix;

/// The eigenvalues of a reduced map, largest modulus first.
pub(crate) fn multipliers(columns: &[Vec<f64>]) -> Option<Vec<ComplexPair>> {
    let mut values = eigenvalues(columns)?;
    sort_by_number(&mut values, |a| -libm::hypot(a.0, a.1));
    Some(values)
}

/// Bounds on the errors of the eigenvalues `values` of a map that is wrong by `accuracy` of itself.
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

/// Changes of the factors that are tried.
const TRIES: u64 = 4;

/// Bounds on the errors of the logarithms `values` of the moduli of a product's eigenvalues, if every column
/// of each factor is wrong by `accuracy` of its length: twice the changes under some random errors of that
/// size. Infinite where one of the changes leaves no eigenvalues.
pub(crate) fn errors_of_product(maps: &[DMatrix<f64>], values: &[ComplexPair], accuracy: f64) -> Vec<f64> {
    let mut errors = vec![accuracy; values.len()];
    for seed in 0..TRIES {
        let mut random = SplitMix(100 + seed);
        let mut changed = maps.to_vec();
        for mut column in changed.iter_mut().flat_map(DMatrix::column_iter_mut) {
            let most = accuracy * column.norm();
            column.iter_mut().for_each(|x| *x += most * random.next().signum());
        }
        let Some(others) = logarithms_of_product(&changed) else {
            return vec![f64::INFINITY; values.len()];
        };
        for ((error, value), other) in errors.iter_mut().zip(values).zip(&others) {
            let moved = 2.0 * (value.0 - other.0).abs();
            *error = if moved.is_finite() { error.max(moved) } else { f64::INFINITY };
        }
    }
    errors
}
