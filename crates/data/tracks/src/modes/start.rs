//! The start of the fit of the radius.

use crate::geometry::{area, centroid, edges};

/// Starting centres and radii: the centroids of the area, of the contour and of the vertices.
///
/// Several, because at large deformation one of them may lie where the radius is not single valued; the best end counts. The three
/// centroids turn and mirror with the outline.
pub(super) fn starts(points: &[[f64; 2]]) -> Vec<([f64; 2], f64)> {
    let mut centres = vec![centroid(points), contour(points)];
    let mean = |k: usize| points.iter().map(|point| point[k]).sum::<f64>() / points.len() as f64;
    centres.push([mean(0), mean(1)]);
    let r0 = (area(points).abs() / std::f64::consts::PI).sqrt();
    let usable = |centre: &[f64; 2]| centre.iter().all(|value| value.is_finite());
    if !(r0.is_finite() && r0 > 0.0) {
        return Vec::new();
    }
    centres.into_iter().filter(usable).map(|centre| (centre, r0)).collect()
}

/// Centroid of the contour, each edge weighted by its length.
fn contour(points: &[[f64; 2]]) -> [f64; 2] {
    let mut sums = [0.0; 3];
    for (a, b) in edges(points) {
        let length = libm::hypot(b[0] - a[0], b[1] - a[1]);
        sums[0] += 0.5 * length * (a[0] + b[0]);
        sums[1] += 0.5 * length * (a[1] + b[1]);
        sums[2] += length;
    }
    [sums[0] / sums[2], sums[1] / sums[2]]
}
