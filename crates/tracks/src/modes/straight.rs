//! Straight runs of vertices along a line parallel to an axis.

use crate::geometry::{area, edges};
use std::f64::consts::PI;

/// Depth, relative to the radius of the cell, within which vertices lie at the line.
const DEPTH: f64 = 0.03;

/// Length of a run, relative to the chord that a circle has at this depth.
const RUN: f64 = 1.6;

/// Length of the longest run of vertices within 3 % of the radius sqrt(A/pi) of the line, and whether it is longer than 1.6 times the chord of a
/// circle at that depth (and one pixel, of outlines that follow pixels).
pub(super) fn run(points: &[[f64; 2]], axis: usize, sign: f64, extreme: f64) -> (f64, bool) {
    let radius = (area(points).abs() / PI).sqrt();
    let depth = DEPTH * radius;
    let near = |point: &[f64; 2]| extreme - sign * point[axis] <= depth;
    if !(radius > 0.0 && points.iter().any(near)) {
        return (0.0, false);
    }
    let longest = longest(points, near, 1 - axis);
    let chord = 2.0 * (2.0 * radius * (depth + grain(points))).sqrt();
    (longest, longest > RUN * chord)
}

/// Longest extent along the other axis of consecutive vertices that are near.
fn longest(points: &[[f64; 2]], near: impl Fn(&[f64; 2]) -> bool, along: usize) -> f64 {
    let start = points.iter().position(|point| !near(point)).unwrap_or(0);
    let (mut longest, mut ends) = (0.0_f64, None::<[f64; 2]>);
    for point in points.iter().cycle().skip(start).take(points.len()) {
        let value = point[along];
        ends = near(point).then(|| ends.map_or([value; 2], |[low, high]| [low.min(value), high.max(value)]));
        longest = longest.max(ends.map_or(0.0, |[low, high]| high - low));
    }
    longest
}

/// The least step of a coordinate along the outline: a pixel where outlines follow pixels, nearly 0 where they are smooth.
fn grain(points: &[[f64; 2]]) -> f64 {
    let steps = edges(points).flat_map(|(a, b)| [(b[0] - a[0]).abs(), (b[1] - a[1]).abs()]);
    let size = points.iter().flatten().fold(0.0_f64, |size, value| size.max(value.abs()));
    // differences of round-off are no steps
    let least = steps.filter(|step| *step > 1e-9 * size).fold(f64::INFINITY, f64::min);
    if least.is_finite() { least } else { 0.0 }
}
