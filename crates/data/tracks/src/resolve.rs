//! The vertices of one cell in one frame -> one outline, or the finding that there are several.

use crate::gather::Vertex;

/// Coordinates beyond this count as not finite: moments of their outline would not be.
const LARGEST: f64 = 1e60;

/// The outline that the vertices of a frame form.
pub(crate) enum Resolved {
    /// One outline, filed `copies` times, without `missing` vertices that are not finite.
    One { points: Vec<[f64; 2]>, copies: usize, missing: usize },
    /// Different outlines.
    Conflict,
}

/// Sorts by place; a place that occurs k times belongs to k outlines, which must be the same.
pub(crate) fn resolve(mut vertices: Vec<Vertex>) -> Resolved {
    vertices.sort_by_key(|vertex| vertex.0); // stable: the order of the file among equal places
    let copies = vertices.chunk_by(|a, b| a.0 == b.0).map(<[Vertex]>::len).max().unwrap_or(1);
    let mut versions: Vec<Vec<[f64; 2]>> = vec![Vec::new(); copies];
    for group in vertices.chunk_by(|a, b| a.0 == b.0) {
        for (version, vertex) in versions.iter_mut().zip(group) {
            version.push(vertex.1);
        }
    }
    let mut versions = versions.into_iter();
    let mut points = versions.next().unwrap_or_default();
    if versions.any(|other| !same(&points, &other)) {
        return Resolved::Conflict;
    }
    let all = points.len();
    points.retain(|point| point.iter().all(|value| value.abs() <= LARGEST));
    let missing = all - points.len();
    if points.len() > 1 && points.first() == points.last() {
        points.pop(); // some formats repeat the first vertex to close the polygon
    }
    Resolved::One { points, copies, missing }
}

/// Equal in all bits: also where a coordinate is NaN.
fn same(a: &[[f64; 2]], b: &[[f64; 2]]) -> bool {
    let bits = |point: &[f64; 2]| point.map(f64::to_bits);
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| bits(a) == bits(b))
}
