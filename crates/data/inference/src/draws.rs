//! Draws from an estimate: models that the data allow, for regimes and predictions.

use crate::Fit;
use motiform_dynamics::Normal;
use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// `count` sets of coefficients in the units of the data, normal about the estimate with the expected covariance.
///
/// The same seed gives the same draws. See [`equations()`](crate::equations()).
pub fn draws(fit: &Fit, count: usize, seed: u64) -> Vec<Vec<f64>> {
    let root = root(fit.covariance());
    let mut normal = Normal::new(seed, 0);
    (0..count)
        .map(|_| {
            let moved = &root * DVector::from_fn(root.nrows(), |_, _| normal.next());
            let unit = |i: usize| fit.scales.coefficient(&fit.coefficients[i].term);
            (0..moved.len()).map(|i| fit.coefficients[i].estimate.value + moved[i] * unit(i)).collect()
        })
        .collect()
}

/// The symmetric root of a covariance. It is a continuous function of the covariance, so that round-off, which differs with the axes and
/// the units of the data, does not change the draws. Eigenvectors are not: round-off decides on their signs, and on their directions where
/// variances are equal.
fn root(covariance: DMatrix<f64>) -> DMatrix<f64> {
    let eigen = SymmetricEigen::new(covariance);
    let roots = eigen.eigenvalues.map(|variance| variance.max(0.0).sqrt());
    &eigen.eigenvectors * DMatrix::from_diagonal(&roots) * eigen.eigenvectors.transpose()
}
