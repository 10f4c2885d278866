//! Form of a polygon without any model of its radius: aspect ratio, solidity, circularity.

use crate::geometry::{area, centroid, edges, perimeter};
use serde::Serialize;
use std::f64::consts::PI;

/// Numbers of the form of an outline; they need neither a centre nor a single-valued radius, so rods and folded cells have them too.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Form {
    /// Longer over shorter axis of the ellipse with the same second moments of the area; 1 for a circle.
    pub aspect_ratio: f64,
    /// Direction of the longer axis (rad, from -pi/2 to pi/2); of no meaning where the aspect ratio is 1.
    pub axis: f64,
    /// Area over that of the convex hull; 1 where the outline is convex.
    pub solidity: f64,
    /// 4 pi area/perimeter^2; 1 for a circle. Steps of pixels lengthen the perimeter: a disc along the edges
    /// of its pixels has pi^2/16 = 0.62.
    pub circularity: f64,
}

/// Form of a simple polygon; `None` where it encloses nothing.
///
/// Second moments about the centroid c, from edges (a, b) with `k = a_x b_y - b_x a_y`:
///
/// M_xx = sum k (a_x^2 + a_x b_x + b_x^2)/12,  M_xy = sum k (2 a_x a_y + a_x b_y + b_x a_y + 2 b_x b_y)/24
///
/// The aspect ratio is the square root of the ratio of the eigenvalues. An affine map of a regular polygon has exactly that of the map.
///
/// Source: Steger (1996), On the calculation of arbitrary moments of polygons, FGBV-96-05; hull: Andrew (1979), Inf. Process. Lett. 9, 216.
///
/// # Checked by  tests/all/form.rs: ellipses and their limits, rectangles, rods, crosses
pub fn form(points: &[[f64; 2]]) -> Option<Form> {
    let (size, length) = (area(points).abs(), perimeter(points));
    let hull = area(&hull(points)).abs();
    // a polygon along a line encloses only round-off
    if !(size > 1e-9 * length * length && hull > 0.0) {
        return None;
    }
    let [xx, xy, yy] = second_moments(points);
    let (mean, half) = (0.5 * (xx + yy), libm::hypot(0.5 * (xx - yy), xy));
    if mean - half <= 0.0 {
        return None;
    }
    Some(Form {
        aspect_ratio: ((mean + half) / (mean - half)).sqrt(),
        axis: 0.5 * libm::atan2(2.0 * xy, xx - yy),
        solidity: (size / hull).min(1.0),
        circularity: 4.0 * PI * size / (length * length),
    })
}

/// M_xx, M_xy, M_yy of the area about its centroid, with the sign that makes the trace positive.
fn second_moments(points: &[[f64; 2]]) -> [f64; 3] {
    let [x0, y0] = centroid(points);
    let mut sums = [0.0; 3];
    for ([ax, ay], [bx, by]) in edges(points) {
        let (ax, ay, bx, by) = (ax - x0, ay - y0, bx - x0, by - y0);
        let cross = ax * by - bx * ay;
        sums[0] += cross * (ax * ax + ax * bx + bx * bx) / 12.0;
        sums[1] += cross * (2.0 * ax * ay + ax * by + bx * ay + 2.0 * bx * by) / 24.0;
        sums[2] += cross * (ay * ay + ay * by + by * by) / 12.0;
    }
    let sign = if sums[0] + sums[2] < 0.0 { -1.0 } else { 1.0 };
    sums.map(|sum| sign * sum)
}

/// The convex hull, anticlockwise.
fn hull(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut sorted = points.to_vec();
    sorted.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut lower = chain(sorted.iter());
    let mut upper = chain(sorted.iter().rev());
    lower.pop();
    upper.pop();
    lower.extend(upper);
    lower
}

/// Half of the hull: the points after which the path turns left.
fn chain<'p>(sorted: impl Iterator<Item = &'p [f64; 2]>) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> = Vec::new();
    for &c in sorted {
        while let [.., a, b] = kept[..]
            && (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) <= 0.0
        {
            kept.pop();
        }
        kept.push(c);
    }
    kept
}
