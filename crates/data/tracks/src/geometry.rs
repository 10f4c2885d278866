//! Polygons: area, centroid, length.

/// Signed area by the shoelace formula: positive where the vertices go round anticlockwise in (x, y).
pub fn area(points: &[[f64; 2]]) -> f64 {
    let Some(&[x0, y0]) = points.first() else { return 0.0 };
    let cross = |([ax, ay], [bx, by]): ([f64; 2], [f64; 2])| (ax - x0) * (by - y0) - (bx - x0) * (ay - y0);
    0.5 * edges(points).map(cross).sum::<f64>()
}

/// Centroid of the enclosed area; that of the vertices where there is no area.
///
/// # Not   the centre of the modes: the first harmonic of the radius about it is not 0 (docs/cells.md)
pub fn centroid(points: &[[f64; 2]]) -> [f64; 2] {
    let Some(&[x0, y0]) = points.first() else { return [0.0; 2] };
    let mut sums = [0.0; 3];
    for ([ax, ay], [bx, by]) in edges(points) {
        let (ax, ay, bx, by) = (ax - x0, ay - y0, bx - x0, by - y0);
        let cross = ax * by - bx * ay;
        sums[0] += cross * (ax + bx);
        sums[1] += cross * (ay + by);
        sums[2] += 3.0 * cross;
    }
    let size = edges(points).map(|(a, b)| libm::hypot(b[0] - a[0], b[1] - a[1])).fold(0.0, f64::max);
    if sums[2].abs() > 1e-9 * size * size {
        return [x0 + sums[0] / sums[2], y0 + sums[1] / sums[2]];
    }
    let mean = |k: usize| points.iter().map(|point| point[k]).sum::<f64>() / points.len() as f64;
    [mean(0), mean(1)]
}

/// Length of the polygon.
pub fn perimeter(points: &[[f64; 2]]) -> f64 {
    edges(points).map(|(a, b)| libm::hypot(b[0] - a[0], b[1] - a[1])).sum()
}

/// The edges, the last one back to the first vertex.
pub(crate) fn edges(points: &[[f64; 2]]) -> impl Iterator<Item = ([f64; 2], [f64; 2])> + Clone {
    let next = points.iter().cycle().skip(1);
    points.iter().copied().zip(next.copied())
}

/// The vertices without those that repeat the one before: they are no further observation.
pub(crate) fn distinct(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut points = points.to_vec();
    points.dedup();
    while points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    points
}
