//! Draws from an estimate: models that the data allow, for regimes and predictions.

use crate::Fit;
use motiform_dynamics::Normal;
use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// `count` sets of coefficients in the units of the data, normal about the estimate with the expected covariance.
///
/// The same seed gives the same draws. See [`equations()`](crate::equations()).
#[must_use]
pub fn draws(fit: &Fit, count: usize, seed: u64) -> Vec<Vec<f64>> {
    let n = fit.coefficients.len();
    let eigen = SymmetricEigen::new(fit.covariance());
    let root =
        DMatrix::from_fn(n, n, |i, k| eigen.eigenvectors[(i, k)] * eigen.eigenvalues[k].max(0.0).sqrt());
    let mut normal = Normal::new(seed, 0);
    (0..count)
        .map(|_| {
            let deviates = DVector::from_fn(n, |_, _| normal.next());
            let moved = &root * deviates;
            let unit = |i: usize| fit.scales.coefficient(&fit.coefficients[i].term);
            (0..n).map(|i| fit.coefficients[i].estimate.value + moved[i] * unit(i)).collect()
        })
        .collect()
}
