//! The branches through a point at which several directions are critical.

use super::beginning::{Begin, nothing};
use super::branch::Branch;
use super::problem::Equations;
use super::rays::{paired, rays};
use super::switch::Departure;
use super::tangents::own_slope;
use motiform_analysis::{RelativeEquilibrium, Result};

/// Slopes at the distance of the first points of branches that may be of the point's own branch.
const OWN: f64 = 1e-3;

/// All branches through a point at which several directions are critical, or terms of higher order decide, but the point's own: that is
/// known by its slope, where it is the only one with it.
pub(super) fn all<'f>(from: Departure<'_, 'f>, start: &RelativeEquilibrium) -> Result<Vec<Vec<Branch<'f>>>> {
    let point = from.point;
    let (problem, x) = from.crossed(start)?;
    let weights = problem.weights(&x);
    let slope = |v: &Vec<f64>| v.last().copied().unwrap_or(0.0).abs();
    let found = paired(&rays(from, &problem, &x), &weights);
    let width = weights.last().map_or(1.0, |weight| 1.0 / weight.sqrt());
    let tangent = own_slope(&problem, &x, point);
    let own = |legs: &&Vec<Vec<f64>>| legs.iter().any(|v| (slope(v) - tangent).abs() < OWN * width);
    let only = found.iter().filter(own).count() == 1;
    let others = found.iter().filter(|legs| !(only && own(legs)));
    let leg = |v: &Vec<f64>| from.cross(start, &Begin::at(point, &x, v)).ok();
    let all: Vec<Vec<Branch<'f>>> = others
        .map(|legs| legs.iter().filter_map(leg).collect())
        .filter(|legs: &Vec<_>| !legs.is_empty())
        .collect();
    if all.is_empty() { Err(nothing(point.parameter)) } else { Ok(all) }
}
