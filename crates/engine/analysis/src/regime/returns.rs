//! The evidence of the returns to the section: witnesses beside the exponent.

use super::look::Extreme;
use crate::linear::norm;
use crate::{correlation_dimension, same_set, zero_one};

/// Most returns that a witness is asked about: costs grow with their square.
const MOST: usize = 1000;

/// The golden section: multiples of it are spread over the parts of the unit interval.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// K of the 0-1 test on the sizes at the minima; `None` for fewer returns than it needs.
pub(super) fn chaos(minima: &[&Extreme]) -> Option<f64> {
    let sizes: Vec<f64> = latest(minima).iter().map(|minimum| minimum.size).collect();
    zero_one(&sizes, 1).ok().map(|test| test.k)
}

/// Dimension of the set of returns, in delay coordinates of their size (which no rotation changes; Takens 1981); `None`
/// where there are too few or no scales to tell.
pub(super) fn dimension(minima: &[&Extreme]) -> Option<f64> {
    let points = delays(minima);
    correlation_dimension(&points, 1e-9 * spread(&points)).ok().map(|found| found.value)
}

/// Returns `true` if the early and the late half of the returns fill the same set, in delay coordinates;
/// `None` for too few.
pub(super) fn stationary(minima: &[&Extreme]) -> Option<bool> {
    let points = delays(minima);
    let (early, late) = points.split_at(points.len() / 2);
    same_set(early, late, 1e-9 * spread(&points)).ok()
}

/// The standard deviation of the sizes at the minima: how large the set of returns is.
pub(super) fn width(minima: &[&Extreme]) -> f64 {
    let sizes: Vec<f64> = latest(minima).iter().map(|minimum| minimum.size).collect();
    let count = sizes.len().max(1) as f64;
    let mean = sizes.iter().sum::<f64>() / count;
    libm::sqrt(sizes.iter().map(|size| (size - mean) * (size - mean)).sum::<f64>() / count)
}

fn latest<'m, 'e>(minima: &'m [&'e Extreme]) -> &'m [&'e Extreme] {
    &minima[minima.len().saturating_sub(MOST)..]
}

/// Points of three successive sizes. Of more than are asked about those that are spread over all of the look, one in each of its equal
/// parts: a torus whose frequencies are close to a resonance fills its curve in many more returns, and is a few arcs before.
fn delays(minima: &[&Extreme]) -> Vec<Vec<f64>> {
    let all: Vec<&[&Extreme]> = minima.windows(3).collect();
    let count = all.len().min(MOST);
    let part = all.len() as f64 / count.max(1) as f64;
    let place =
        |k: usize| if part > 1.0 { ((k as f64 + (k as f64 * GOLDEN).fract()) * part) as usize } else { k };
    (0..count).map(|k| all[place(k)].iter().map(|minimum| minimum.size).collect()).collect()
}

fn spread(points: &[Vec<f64>]) -> f64 {
    points.iter().map(|point| norm(point)).fold(0.0, f64::max)
}
