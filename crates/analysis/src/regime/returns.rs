//! What the returns to the section say: witnesses beside the exponent.

use super::look::Extreme;
use crate::linear::norm;
use crate::{correlation_dimension, zero_one};

/// Most returns that a witness is asked about, the latest: costs grow with their square.
const MOST: usize = 1000;

/// K of the 0-1 test on the sizes at the minima; `None` for fewer returns than it needs.
pub(super) fn chaos(minima: &[&Extreme]) -> Option<f64> {
    let latest = &minima[minima.len().saturating_sub(MOST)..];
    let sizes: Vec<f64> = latest.iter().map(|minimum| minimum.size).collect();
    zero_one(&sizes, 1).ok().map(|test| test.k)
}

/// Dimension of the set of returns, in delay coordinates of their size (which no rotation changes; Takens 1981); `None`
/// where there are too few or no scales to tell.
pub(super) fn dimension(minima: &[&Extreme]) -> Option<f64> {
    let latest = &minima[minima.len().saturating_sub(MOST)..];
    let points: Vec<Vec<f64>> =
        latest.windows(3).map(|window| window.iter().map(|minimum| minimum.size).collect()).collect();
    let spread = points.iter().map(|point| norm(point)).fold(0.0, f64::max);
    correlation_dimension(&points, 1e-9 * spread).ok().map(|found| found.value)
}
