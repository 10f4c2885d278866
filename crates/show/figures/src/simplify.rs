//! Fewer points for the same picture.

use super::geometry::{Point, distance};

/// Points between two forced ones: bounds the worst case (a spiral costs n^2 otherwise) to n times this.
const CHUNK: usize = 1024;

/// Polyline through some of the points that stays within `tolerance` of all of them; keeps both ends.
///
/// Source: Ramer (1972), Comput. Graph. Image Process. 1, 244; Douglas & Peucker (1973).
///
/// # Units     of the points; figures pass pixels
pub fn simplify(points: &[Point], tolerance: f64) -> Vec<Point> {
    if points.len() < 3 {
        return points.to_vec();
    }
    let mut keep = vec![false; points.len()];
    let mut open = Vec::new();
    for first in (0..points.len() - 1).step_by(CHUNK) {
        let last = (first + CHUNK).min(points.len() - 1);
        (keep[first], keep[last]) = (true, true);
        open.push((first, last));
    }
    while let Some((first, last)) = open.pop() {
        let (far, deviation) = farthest(points, first, last);
        if deviation > tolerance {
            keep[far] = true;
            open.extend([(first, far), (far, last)]);
        }
    }
    points.iter().zip(keep).filter_map(|(p, keep)| keep.then_some(*p)).collect()
}

/// First, lowest, highest and last point of every column of a width, in their order: for a curve with many points per
/// column the same picture.
///
/// # Units     of the points, whose x does not decrease
pub(crate) fn envelope(points: &[Point], width: f64) -> Vec<Point> {
    let mut out = Vec::with_capacity(points.len().min(4096));
    for column in points.chunk_by(|a, b| (a[0] / width).floor() == (b[0] / width).floor()) {
        let by_height = |a: &usize, b: &usize| column[*a][1].total_cmp(&column[*b][1]);
        let (low, high) = ((0..column.len()).min_by(by_height), (0..column.len()).max_by(by_height));
        let mut kept = vec![0, low.unwrap_or(0), high.unwrap_or(0), column.len() - 1];
        kept.sort_unstable();
        kept.dedup();
        out.extend(kept.into_iter().map(|i| column[i]));
    }
    out
}

/// Index and distance of the point farthest from the chord `first`-`last`.
fn farthest(points: &[Point], first: usize, last: usize) -> (usize, f64) {
    (first + 1..last)
        .map(|i| (i, distance_to_segment(points[i], points[first], points[last])))
        .fold((first, 0.0), |best, next| if next.1 > best.1 { next } else { best })
}

/// Distance of `p` from the segment `a`-`b`.
pub(crate) fn distance_to_segment(p: Point, a: Point, b: Point) -> f64 {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let square = u[0] * u[0] + u[1] * u[1];
    if square == 0.0 {
        return distance(p, a);
    }
    let along = ((u[0] * v[0] + u[1] * v[1]) / square).clamp(0.0, 1.0);
    (v[0] - along * u[0]).hypot(v[1] - along * u[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn every_point_stays_within_tolerance(
            points in prop::collection::vec([-50.0..50.0f64, -50.0..50.0f64], 1..300),
            tolerance in 0.01..20.0f64,
        ) {
            let few = simplify(&points, tolerance);
            prop_assert_eq!(few[0], points[0]);
            prop_assert_eq!(few.last(), points.last());
            for p in &points {
                let off = few.windows(2).map(|w| distance_to_segment(*p, w[0], w[1]));
                let off = off.fold(distance(*p, few[0]), f64::min);
                prop_assert!(off <= tolerance * (1.0 + 1e-12));
            }
        }
    }

    #[test]
    fn a_straight_line_of_many_points_needs_few() {
        let line: Vec<_> = (0..100_000).map(|i| [f64::from(i) * 0.01, f64::from(i) * 0.02]).collect();
        assert!(simplify(&line, 0.25).len() < 102);
    }

    #[test]
    fn the_envelope_keeps_extremes_ends_and_order() {
        let points: Vec<Point> =
            (0..1000u32).map(|i| [f64::from(i) * 0.01, f64::from(i * 7919 % 1000)]).collect();
        let few = envelope(&points, 0.5);
        assert!(few.len() <= 80 && few.windows(2).all(|w| w[0][0] < w[1][0]));
        assert_eq!((few[0], few[few.len() - 1]), (points[0], points[999]));
        for height in [0.0, 999.0] {
            assert!(few.iter().any(|p| p[1] == height));
        }
        assert_eq!(envelope(&points, 1e-6), points);
    }
}
