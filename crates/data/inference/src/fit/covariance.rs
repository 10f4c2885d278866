//! Covariances of the estimates.

use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// Least information, relative to the largest of scaled parameters, that counts: below, errors are stated as if there were this much.
const LEAST: f64 = 1e-13;

/// Inverse of an information matrix; directions without information get very large variances, parameters in `held` none.
pub(super) fn inverse(information: &DMatrix<f64>, held: &[bool]) -> DMatrix<f64> {
    let n = information.nrows();
    let scale = DVector::from_fn(n, |i, _| {
        let own = information[(i, i)];
        if held[i] || own <= 0.0 { 0.0 } else { 1.0 / own.sqrt() }
    });
    let scaled = DMatrix::from_fn(n, n, |i, j| scale[i] * information[(i, j)] * scale[j]);
    let eigen = SymmetricEigen::new(scaled);
    let mut inverse = DMatrix::zeros(n, n);
    for (k, &value) in eigen.eigenvalues.iter().enumerate() {
        let column = eigen.eigenvectors.column(k).component_mul(&scale);
        inverse += &column * column.transpose() / value.max(LEAST);
    }
    inverse
}

/// `C (sum_t s_t s_t^T + lagged products) C`: errors that hold where the noise is not as assumed.
///
/// Lags up to `4 (N/100)^(2/9)` with Bartlett's weights, within stretches.
///
/// Source: Huber (1967), Proc. Fifth Berkeley Symp. 1, 221; Newey and West (1987), Econometrica 55, 703.
pub(super) fn sandwich(inverse: &DMatrix<f64>, scores: &[Vec<DVector<f64>>]) -> DMatrix<f64> {
    let n = inverse.nrows();
    let frames: usize = scores.iter().map(Vec::len).sum();
    let lags = (4.0 * libm::pow(frames as f64 / 100.0, 2.0 / 9.0)).floor() as usize;
    let mut meat = DMatrix::zeros(n, n);
    for stretch in scores {
        for lag in 0..=lags.min(stretch.len().saturating_sub(1)) {
            let weight = 1.0 - lag as f64 / (lags + 1) as f64;
            for (now, later) in stretch.iter().zip(&stretch[lag..]) {
                meat.ger(weight, now, later, 1.0);
                if lag > 0 {
                    meat.ger(weight, later, now, 1.0);
                }
            }
        }
    }
    inverse * meat * inverse
}
