//! The test that two sets of points fill the same set.

use crate::{Result, checks};

/// Fewest points of each set.
const LEAST: usize = 100;

/// Neighbours per point, on average, at the scale of the comparison.
const NEIGHBOURS: usize = 8;

/// The cross-correlation must reach this part of the mean of the two auto-correlations.
const SHARE: f64 = 0.7;

/// Returns `true` if two sets of points fill the same set with the same density, at the smallest scale that
/// they resolve.
///
/// C_ab(r) = share of the pairs (one point of each set) closer than r;  same if C_12 >= 0.7 (C_11 + C_22) / 2
///
/// r is the distance below which a point of one set has 8 others of that set, on average over both sets. For
/// the early and the late returns of an orbit that stays on its attractor the three sums agree; for returns
/// that drift or approach a smaller set the late ones lie elsewhere or closer together, and the
/// cross-correlation falls short of the others (inequality of arithmetic means: it never exceeds them by
/// much).
///
/// Source: Kantz (1994), Phys. Rev. E 49, 5091 (cross-correlation sum).
///
/// # Shapes    points of equal length in both sets
/// # Units     `resolution` (accuracy of the points) in those of the points: closer points count as one
/// # Errors    [`crate::Error::TooFew`] below 100 points in a set, [`crate::Error::Shape`], [`crate::Error::NotFinite`]
/// # Checked by  tests/all/same_set.rs: circles, a period, power laws of decay, shrinking spirals, the logistic map
pub fn same_set(first: &[Vec<f64>], second: &[Vec<f64>], resolution: f64) -> Result<bool> {
    checks::at_least("a comparison of sets, in points of each,", LEAST, first.len().min(second.len()))?;
    checks::points(first.iter().chain(second), first[0].len())?;
    let (inner, outer) = (within(first), within(second));
    let reach = quantile(&inner, NEIGHBOURS, first.len()).max(quantile(&outer, NEIGHBOURS, second.len()));
    let reach = reach.max(resolution * resolution);
    let across: Vec<f64> = first.iter().flat_map(|a| second.iter().map(|b| square(a, b))).collect();
    let own = 0.5 * (share(&inner, reach) + share(&outer, reach));
    Ok(share(&across, reach) >= SHARE * own)
}

/// Squared distances of all pairs in a set.
fn within(points: &[Vec<f64>]) -> Vec<f64> {
    points.iter().enumerate().flat_map(|(i, a)| points[..i].iter().map(|b| square(a, b))).collect()
}

fn square(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum()
}

/// The squared distance below which each of `count` points has so many others, on average.
fn quantile(squares: &[f64], neighbours: usize, count: usize) -> f64 {
    let mut squares = squares.to_vec();
    let place = (neighbours * count / 2).min(squares.len() - 1);
    *squares.select_nth_unstable_by(place, f64::total_cmp).1
}

/// The share of the pairs that are no farther apart.
fn share(squares: &[f64], reach: f64) -> f64 {
    squares.iter().filter(|square| **square <= reach).count() as f64 / squares.len() as f64
}
