//! The real roots of a cubic.

use motiform_dynamics::sample::ascending;
use std::f64::consts::TAU;

/// Real roots of `x^3 + p x + q`, increasing: Cardano's where there is one, Viete's where there are three, each polished by
/// Newton's method.
pub(super) fn real_roots(p: f64, q: f64) -> Vec<f64> {
    let discriminant = 0.25 * q * q + p * p * p / 27.0;
    let mut roots = if discriminant > 0.0 {
        let root = discriminant.sqrt();
        let large = libm::cbrt(-0.5 * q - if q < 0.0 { -root } else { root }); // no cancellation
        vec![if large == 0.0 { 0.0 } else { large - p / (3.0 * large) }]
    } else {
        let radius = 2.0 * (-p / 3.0).sqrt();
        let angle = if p == 0.0 { 0.0 } else { libm::acos((3.0 * q / (p * radius)).clamp(-1.0, 1.0)) / 3.0 };
        [0.0, 1.0, 2.0].map(|k| radius * libm::cos(angle - TAU * k / 3.0)).to_vec()
    };
    for x in &mut roots {
        for _ in 0..2 {
            let slope = 3.0 * *x * *x + p;
            if slope.abs() > 1e-300 {
                *x -= (*x * *x * *x + p * *x + q) / slope;
            }
        }
    }
    ascending(&mut roots);
    roots.dedup();
    roots
}
