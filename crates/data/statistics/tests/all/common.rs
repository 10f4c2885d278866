//! Processes whose statistics are known.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_dynamics::Normal;
use motiform_statistics::{Answer, Measured, Track, Tracks};

/// Steps between two samples of an active Brownian particle.
const STEPS: usize = 20;

/// Ornstein-Uhlenbeck velocity: dv = -g v dt + sqrt(2 g) s dW for each component, with its position, both exact at any dt.
pub(crate) fn ornstein_uhlenbeck(g: f64, s: f64, dt: f64, samples: usize, normal: &mut Normal) -> Track {
    let a = (-g * dt).exp();
    let (vv, xv) = (s * s * (1.0 - a * a), s * s / g * (1.0 - a) * (1.0 - a));
    let xx = s * s / (g * g) * (2.0 * g * dt - 3.0 + 4.0 * a - a * a);
    let (c11, c21) = (vv.sqrt(), xv / vv.sqrt());
    let c22 = (xx - c21 * c21).max(0.0).sqrt();
    let (mut x, mut v) = ([0.0; 2], [s * normal.next(), s * normal.next()]);
    let mut track = Track::default();
    for _ in 0..samples {
        track.position.push(x);
        track.velocity.push(v);
        for k in 0..2 {
            let (p, q) = (normal.next(), normal.next());
            x[k] += (1.0 - a) / g * v[k] + c21 * p + c22 * q;
            v[k] = a * v[k] + c11 * p;
        }
    }
    track
}

/// Active Brownian particle: speed 1, heading' = omega + sqrt(2 d_r) xi, position' = heading + sqrt(2 d) xi
/// (d per component). The trapezoidal rule over 20 steps a sample is off by (d_r dt/20)^2/12 of the
/// displacement.
pub(crate) fn active_brownian(
    (d_r, omega, d): (f64, f64, f64),
    dt: f64,
    samples: usize,
    normal: &mut Normal,
) -> Track {
    let h = dt / STEPS as f64;
    let mut angle = std::f64::consts::PI * normal.next() * 10.0; // as good as uniform
    let mut x = [0.0; 2];
    let mut track = Track::default();
    let heading = |angle: f64| [angle.cos(), angle.sin()];
    for _ in 0..samples {
        track.position.push(x);
        track.velocity.push(heading(angle));
        for _ in 0..STEPS {
            let before = heading(angle);
            angle += omega * h + (2.0 * d_r * h).sqrt() * normal.next();
            let after = heading(angle);
            for k in 0..2 {
                x[k] += 0.5 * h * (before[k] + after[k]) + (2.0 * d * h).sqrt() * normal.next();
            }
        }
    }
    track
}

/// 2 v0^2 Re(t/z - (1 - e^{-z t})/z^2) + 4 d t,  z = d_r + i omega, v0 = 1.
pub(crate) fn active_msd((d_r, omega, d): (f64, f64, f64), t: f64) -> f64 {
    let n = d_r * d_r + omega * omega;
    let (c, s) = ((-d_r * t).exp() * (omega * t).cos(), -(-d_r * t).exp() * (omega * t).sin());
    // (1 - e^{-z t}) conj(z)^2 / |z|^4
    let (re, im) = (1.0 - c, -s);
    let (qr, qi) = (d_r * d_r - omega * omega, -2.0 * d_r * omega);
    2.0 * (t * d_r / n - (re * qr - im * qi) / (n * n)) + 4.0 * d * t
}

/// Motion along a curve given by position and velocity.
pub(crate) fn along(dt: f64, samples: usize, at: impl Fn(f64) -> ([f64; 2], [f64; 2])) -> Track {
    let (position, velocity) = (0..samples).map(|k| at(k as f64 * dt)).unzip();
    Track { position, velocity, ..Track::default() }
}

/// `count` bodies.
pub(crate) fn many(dt: f64, count: usize, body: impl Fn(&mut Normal) -> Track, seed: u64) -> Tracks {
    let bodies = (0..count).map(|k| body(&mut Normal::new(seed, k as u64))).collect();
    Tracks::new(dt, Vec::new(), bodies).unwrap()
}

/// Within so many half widths: 2.5 are five standard errors.
pub(crate) fn agrees(measured: Measured, exact: f64, half_widths: f64) -> bool {
    (measured.value - exact).abs() <= half_widths * measured.half_width()
}

pub(crate) fn holds(measured: Measured, exact: f64) -> bool {
    measured.interval.is_some_and(|[lower, upper]| (lower..=upper).contains(&exact))
}

pub(crate) fn known(answer: &Answer) -> Measured {
    answer.known().unwrap_or_else(|| unreachable!("{:?}", answer.reason()))
}
