//! Outlines of known modes, for tests and round trips.

use crate::cracks::follow;
use crate::modes::{radius, radius_slope};

/// An outline to be made: `R(theta) = R0 + sum_{n=2} 2 Re(z_n e^{i n theta})` about a centre.
#[derive(Debug, Clone, PartialEq)]
pub struct Synthetic {
    /// The centre.
    pub centre: [f64; 2],
    /// R0.
    pub r0: f64,
    /// z2, z3, ...
    pub z: Vec<[f64; 2]>,
}

impl Synthetic {
    /// `count` vertices at evenly spaced angles from `first` on, anticlockwise; exact to round-off.
    pub fn vertices(&self, count: usize, first: f64) -> Vec<[f64; 2]> {
        let angle = |k: usize| first + std::f64::consts::TAU * k as f64 / count as f64;
        (0..count).map(|k| self.vertex(angle(k))).collect()
    }

    /// The vertex in this direction.
    pub fn vertex(&self, theta: f64) -> [f64; 2] {
        let (sin, cos) = libm::sincos(theta);
        let r = radius(self.r0, &self.z, [cos, sin]);
        [self.centre[0] + r * cos, self.centre[1] + r * sin]
    }

    /// Least radius over directions, and largest |R'/R|: whether the outline is a simple curve, and how hard it is to measure.
    pub fn margin(&self) -> (f64, f64) {
        let mut margin = (f64::INFINITY, 0.0_f64);
        for k in 0..720 {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(k) / 720.0);
            let r = radius(self.r0, &self.z, [cos, sin]);
            margin = (margin.0.min(r), margin.1.max((radius_slope(&self.z, [cos, sin]) / r).abs()));
        }
        margin
    }
}

/// Moves every vertex by independent noise; `normal` gives standard normal deviates.
pub fn blur(points: &mut [[f64; 2]], sigma: f64, mut normal: impl FnMut() -> f64) {
    for value in points.iter_mut().flatten() {
        *value += sigma * normal();
    }
}

/// The outline as a segmentation of pixels of this size gives it: the pixels whose middle lies inside, followed around along their edges.
///
/// Empty where no pixel lies inside. Holes and further parts are not there: the outline around the first pixel found is returned.
///
/// # Panics    never; sizes that give more than 4096 x 4096 pixels give an empty outline
pub fn pixelated(points: &[[f64; 2]], pixel: f64) -> Vec<[f64; 2]> {
    let low = [0, 1].map(|k| points.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min));
    let high = [0, 1].map(|k| points.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max));
    let first = low.map(|value| (value / pixel).floor() - 1.0);
    let size = [0, 1].map(|k| (high[k] / pixel).ceil() + 1.0 - first[k]);
    if !(size[0] > 0.0 && size[1] > 0.0 && size[0] <= 4096.0 && size[1] <= 4096.0) {
        return Vec::new();
    }
    let [width, height] = size.map(|side| side as i64);
    let middle = |k: usize, at: i64| (first[k] + at as f64 + 0.5) * pixel;
    let mask: Vec<bool> = (0..width * height)
        .map(|at| inside(points, [middle(0, at % width), middle(1, at / width)]))
        .collect();
    let full = |x: i64, y: i64| {
        (0..width).contains(&x) && (0..height).contains(&y) && mask[(y * width + x) as usize]
    };
    let corner = |[x, y]: [i64; 2]| [(first[0] + x as f64) * pixel, (first[1] + y as f64) * pixel];
    let start = (0..width * height).map(|at| [at % width, at / width]).find(|&[x, y]| full(x, y));
    start.map_or_else(Vec::new, |start| follow(start, true, full).into_iter().map(corner).collect())
}

/// Even-odd rule.
fn inside(points: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let crosses = |(a, b): ([f64; 2], [f64; 2])| {
        (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    };
    crate::geometry::edges(points).filter(|edge| crosses(*edge)).count() % 2 == 1
}
