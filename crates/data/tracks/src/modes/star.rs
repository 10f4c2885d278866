//! The test if an outline is star-shaped about a point, so that each ray from there meets it once.

use crate::geometry::edges;
use serde::Serialize;
use std::f64::consts::TAU;

/// The largest angle by which the direction of the outline, seen from the centre, runs backwards.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Fold {
    /// Turns of the direction along the outline: 1 (or -1) for a simple curve around the centre, 0 where the centre lies outside.
    pub turns: i64,
    /// Largest length by which the outline runs back: angle times the radius there.
    pub back: f64,
}

/// Follows the direction arg(P - centre) along the outline. `None` where a vertex lies at the centre.
pub fn fold(points: &[[f64; 2]], centre: [f64; 2]) -> Option<Fold> {
    let seen: Vec<[f64; 2]> = points.iter().map(|p| [p[0] - centre[0], p[1] - centre[1]]).collect();
    let turn =
        |(a, b): ([f64; 2], [f64; 2])| libm::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
    let turns: Vec<(f64, f64)> =
        edges(&seen).map(|edge| (turn(edge), libm::hypot(edge.0[0], edge.0[1]))).collect();
    if turns.iter().any(|(turn, radius)| !turn.is_finite() || *radius == 0.0) {
        return None;
    }
    let total: f64 = turns.iter().map(|turn| turn.0).sum();
    let sense = if total < 0.0 { -1.0 } else { 1.0 };
    // twice around: a run back across the first vertex counts whole
    let (mut angle, mut most, mut back) = (0.0_f64, 0.0_f64, 0.0_f64);
    for (turn, radius) in turns.iter().chain(&turns) {
        most = most.max(angle);
        back = back.max((most - angle) * radius);
        angle += sense * turn;
    }
    Some(Fold { turns: (total / TAU).round() as i64, back })
}
