//! Straight runs of vertices along a line.

use crate::geometry::{area, edges};
use std::f64::consts::PI;

/// Depth, relative to the radius of the cell, within which vertices lie at the line.
const DEPTH: f64 = 0.03;

/// Length of a run, relative to the chord that a circle has at this depth.
const RUN: f64 = 1.6;

/// Directions in which an outline is looked at, and the share of the length of a run from which on it is as flat in another one.
const DIRECTIONS: usize = 16;
const AS_FLAT: f64 = 0.8;
/// Cosine of the angle up to which directions look at the same side.
const SAME_SIDE: f64 = 0.5;

/// A line that outlines may lie at: all points whose coordinate along the normal (a unit vector) is `level`.
#[derive(Clone, Copy)]
pub(super) struct Edge {
    pub(super) normal: [f64; 2],
    pub(super) level: f64,
}

impl Edge {
    /// Parallel to an axis, `sign` times the coordinate being `level`.
    pub(super) fn of_axis(axis: usize, sign: f64, level: f64) -> Self {
        let mut normal = [0.0; 2];
        normal[axis] = sign;
        Self { normal, level }
    }

    /// The edge of an outline in a direction.
    fn of_outline(points: &[[f64; 2]], normal: [f64; 2]) -> Self {
        let level = points.iter().map(|point| dot(*point, normal)).fold(f64::NEG_INFINITY, f64::max);
        Self { normal, level }
    }

    fn is_near(self, point: &[f64; 2], depth: f64) -> bool {
        self.level - dot(*point, self.normal) <= depth
    }

    /// Length of the longest run of vertices within 3 % of the radius sqrt(A/pi) of the line.
    fn run(self, points: &[[f64; 2]], depth: f64) -> f64 {
        let along = [-self.normal[1], self.normal[0]];
        let start = points.iter().position(|point| !self.is_near(point, depth)).unwrap_or(0);
        let (mut longest, mut ends) = (0.0_f64, None::<[f64; 2]>);
        for point in points.iter().cycle().skip(start).take(points.len()) {
            let value = dot(*point, along);
            ends = self
                .is_near(point, depth)
                .then(|| ends.map_or([value; 2], |[low, high]| [low.min(value), high.max(value)]));
            longest = longest.max(ends.map_or(0.0, |[low, high]| high - low));
        }
        longest
    }
}

/// Length of the longest run of vertices within 3 % of the radius sqrt(A/pi) of a border, and whether it is
/// clipped there: longer than 1.6 times the chord of a circle at that depth (and one pixel, of outlines that
/// follow pixels), while no other side of the outline is nearly as flat. `borders`: all lines at which an
/// outline may be clipped, whose sides do not count.
pub(super) fn run(points: &[[f64; 2]], border: Edge, borders: &[Edge]) -> (f64, bool) {
    let radius = (area(points).abs() / PI).sqrt();
    let depth = DEPTH * radius;
    if !(radius > 0.0 && points.iter().any(|point| border.is_near(point, depth))) {
        return (0.0, false);
    }
    let longest = border.run(points, depth);
    let chord = 2.0 * (2.0 * radius * (depth + grain(points))).sqrt();
    let straight = longest > RUN * chord && !is_flat_elsewhere(points, (longest, depth), border, borders);
    (longest, straight)
}

/// Returns `true` if another side of the outline is as flat: then it is so by itself, and not because a part
/// is not seen.
fn is_flat_elsewhere(points: &[[f64; 2]], (run, depth): (f64, f64), border: Edge, borders: &[Edge]) -> bool {
    // a cell in a corner of the images is clipped at two sides; no cell is as wide as the images
    let beside = |edge: &&Edge| dot(edge.normal, border.normal) > -SAME_SIDE;
    let near = |edge: &&Edge| points.iter().any(|point| edge.is_near(point, depth));
    let reached: Vec<&Edge> = borders.iter().filter(beside).filter(near).collect();
    (0..DIRECTIONS).any(|k| {
        let (sin, cos) = libm::sincos(2.0 * PI * k as f64 / DIRECTIONS as f64);
        // from the border on, so that a turn of the images changes nothing
        let [a, b] = border.normal;
        let normal = [cos * a - sin * b, sin * a + cos * b];
        let same = |edge: &&Edge| dot(edge.normal, normal) > SAME_SIDE;
        let own = dot(border.normal, normal) > SAME_SIDE;
        !own && !reached.iter().any(same)
            && Edge::of_outline(points, normal).run(points, depth) > AS_FLAT * run
    })
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// The least step of a coordinate along the outline: a pixel where outlines follow pixels, nearly 0 where they are smooth.
fn grain(points: &[[f64; 2]]) -> f64 {
    let steps = edges(points).flat_map(|(a, b)| [(b[0] - a[0]).abs(), (b[1] - a[1]).abs()]);
    let size = points.iter().flatten().fold(0.0_f64, |size, value| size.max(value.abs()));
    // differences of round-off are no steps
    let least = steps.filter(|step| *step > 1e-9 * size).fold(f64::INFINITY, f64::min);
    if least.is_finite() { least } else { 0.0 }
}
