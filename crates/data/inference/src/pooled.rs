//! Coefficients of several cells that follow one law, from estimates of each.

use crate::Fit;
use motiform_dynamics::distributions::{chi_square_tail, student_quantile};
use nalgebra::{DMatrix, DVector};

/// Mean square of the differences between cells, in units of their errors, up to which they count as alike: estimates from short records
/// scatter by some percent more than their errors say.
const EXCESS: f64 = 1.3;

/// Estimates of several cells together.
#[derive(Clone, Debug, PartialEq)]
pub struct Pooled {
    /// The values.
    pub values: Vec<f64>,
    /// 95 % intervals, of which the units are cells.
    pub intervals: Vec<[f64; 2]>,
    /// Probability of differences between the cells as large as these where their own variances are at most .3
    /// of those of the estimates.
    pub p_value: f64,
}

/// The mean of estimates with the weights of their information: `A^-1 sum I_k c_k`, A the sum of the I_k, the inverse covariances.
///
/// An estimate from a short record is biased, since its error and its information come from the same record: c_k - c = I_k^-1 s_k with a
/// score s_k of mean 0, and so is a plain mean of many, whose interval shrinks all the same. The mean of the products `I_k c_k` has no such
/// part: `A (mean - c) = sum s_k`. It is one step to the estimate of highest likelihood of all records. Errors are those of
/// `I_k (c_k - mean)` over cells. Cells that differ have no common values: `sum (c_k - mean)^T I_k (c_k - mean)` is chi-square where they
/// do not, and up to 1.3 times that for short records.
///
/// `None` with fewer than two cells, or where a covariance has no inverse.
///
/// Source: White (1982), Econometrica 50, 1 (errors from scores); Cochran (1954), Biometrics 10, 101 (differences).
///
/// # Checked by  tests/all/pooled.rs: coverage over many short records of a linear process; cells that differ; units
pub fn pooled(estimates: &[(Vec<f64>, Vec<Vec<f64>>)]) -> Option<Pooled> {
    let (cells, n) = (estimates.len(), estimates.first()?.0.len());
    if cells < 2 || estimates.iter().any(|(values, _)| values.len() != n) {
        return None;
    }
    let values: Vec<DVector<f64>> = estimates.iter().map(|one| DVector::from_column_slice(&one.0)).collect();
    let information: Vec<DMatrix<f64>> = estimates
        .iter()
        .map(|one| inverse(&DMatrix::from_fn(n, n, |i, j| one.1[i][j])))
        .collect::<Option<_>>()?;
    let all = information.iter().sum::<DMatrix<f64>>();
    let covariance = inverse(&all)?;
    let products = information.iter().zip(&values).map(|(weight, value)| weight * value);
    let mean = &covariance * products.sum::<DVector<f64>>();
    let (mut scatter, mut apart) = (DMatrix::zeros(n, n), 0.0);
    for (weight, value) in information.iter().zip(&values) {
        let off = value - &mean;
        let score = weight * &off;
        apart += off.dot(&score);
        scatter += &score * score.transpose();
    }
    let scatter = &covariance * scatter * &covariance * (cells as f64 / (cells - 1) as f64);
    let factor = student_quantile(cells - 1);
    let interval =
        |i: usize| [-1.0, 1.0].map(|sign| mean[i] + sign * factor * scatter[(i, i)].max(0.0).sqrt());
    Some(Pooled {
        intervals: (0..n).map(interval).collect(),
        values: mean.iter().copied().collect(),
        p_value: chi_square_tail(apart / EXCESS, ((cells - 1) * n) as f64),
    })
}

/// The inverse of a covariance, in units in which its diagonal is 1.
fn inverse(matrix: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let n = matrix.nrows();
    let scale: Vec<f64> = (0..n).map(|i| matrix[(i, i)].sqrt()).collect();
    if scale.iter().any(|size| !(size.is_finite() && *size > 0.0)) {
        return None;
    }
    let scaled = DMatrix::from_fn(n, n, |i, j| matrix[(i, j)] / (scale[i] * scale[j]));
    let inverse = scaled.cholesky()?.inverse();
    Some(DMatrix::from_fn(n, n, |i, j| inverse[(i, j)] / (scale[i] * scale[j])))
}

/// [`pooled`] of fits with the same coefficients; `None` where they have others.
pub fn pooled_fits(fits: &[&Fit]) -> Option<Pooled> {
    let names =
        |fit: &Fit| fit.coefficients.iter().map(|c| (c.name.clone(), c.imaginary)).collect::<Vec<_>>();
    let first = names(fits.first()?);
    if fits.iter().any(|fit| names(fit) != first) {
        return None;
    }
    let one = |fit: &&Fit| {
        (fit.coefficients.iter().map(|c| c.estimate.value).collect(), fit.covariance_of_coefficients())
    };
    pooled(&fits.iter().map(one).collect::<Vec<_>>())
}
