//! The test of self-intersection of a polygon.

use crate::geometry::edges;
use motiform_dynamics::sample::sort_by_number;

/// Pairs of edges that are looked at, at most.
const PAIRS: usize = 20_000_000;

/// The answer to whether a polygon crosses itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Crossing {
    /// No two edges cross.
    None,
    /// These two do (numbers of their first vertices).
    At([usize; 2]),
    /// Too many pairs overlap to look at them all.
    Unknown,
}

/// Looks for two edges that cross in their interiors. Edges that only touch, as outlines of pixels do at corners, do not cross.
///
/// Edges are sorted by their least x; only those that overlap in x are compared, at most 20 million pairs.
pub fn crossing(points: &[[f64; 2]]) -> Crossing {
    let edges: Vec<([f64; 2], [f64; 2])> = edges(points).collect();
    let low = |edge: &([f64; 2], [f64; 2])| edge.0[0].min(edge.1[0]);
    let mut order: Vec<usize> = (0..edges.len()).collect();
    sort_by_number(&mut order, |&a| low(&edges[a]));
    let mut pairs = 0;
    for (place, &a) in order.iter().enumerate() {
        let high = edges[a].0[0].max(edges[a].1[0]);
        for &b in order[place + 1..].iter().take_while(|&&b| low(&edges[b]) <= high) {
            pairs += 1;
            if pairs > PAIRS {
                return Crossing::Unknown;
            }
            if cross(edges[a], edges[b]) {
                return Crossing::At([a.min(b), a.max(b)]);
            }
        }
    }
    Crossing::None
}

/// Each edge has its ends on different sides of the other.
fn cross(a: ([f64; 2], [f64; 2]), b: ([f64; 2], [f64; 2])) -> bool {
    let side = |(p, q): ([f64; 2], [f64; 2]), r: [f64; 2]| {
        (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
    };
    let apart = |line, (p, q): ([f64; 2], [f64; 2])| {
        let (first, second) = (side(line, p), side(line, q));
        first > 0.0 && second < 0.0 || first < 0.0 && second > 0.0
    };
    apart(a, b) && apart(b, a)
}
