//! Modes of the tangent angle: of outlines whose radius is not single valued.

use crate::geometry::{area, distinct, edges};
use serde::Serialize;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Modes of the tangent angle, scaled so that they equal z_n for small deformation.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TangentModes {
    /// sqrt(A/pi).
    pub r0: f64,
    /// w2, w3, ...: real and imaginary parts, lengths.
    pub w: Vec<[f64; 2]>,
}

/// Modes of the tangent angle minus the turning of a circle.
///
/// phi(s) is the direction of the tangent, anticlockwise along the outline of length L; sigma = 2 pi s/L + c
/// is the parameter, with c such that psi(sigma) = phi - sigma - pi/2 has mean 0 (a circle: psi = 0 and sigma =
/// theta). Then
///
/// psi_n = 1/(2 pi) int psi e^{-i n sigma} dsigma = 1/(2 pi i n) sum_k tau_k e^{-i n sigma_k},   w_n = i n/(n^2 - 1) sqrt(A/pi) psi_n,
///
/// tau_k the turning at vertex k. To first order in the deformation w_n = z_n; a rotation, mirror, other
/// first vertex or sense acts on w_n as on z_n. Vertices need not be evenly spaced. psi_0 and w_1 carry no
/// shape: of a closed curve w_1 vanishes to first order.
///
/// `None` where the outline does not turn once (it crosses itself), reverses at a vertex, or has no area.
///
/// Source: Zahn and Roskies (1972), IEEE Trans. Comput. C-21, 269, for psi; the scaling is ours.
///
/// # Checked by  tests/all/tangent.rs: first order, rotation, mirror, start, sense
pub fn tangent_modes(points: &[[f64; 2]], highest: usize) -> Option<TangentModes> {
    let enclosed = area(points);
    let mut path = distinct(points);
    if enclosed < 0.0 {
        path.reverse();
    }
    let r0 = (enclosed.abs() / PI).sqrt();
    let corners = corners(&path)?;
    let length: f64 = corners.iter().map(|corner| corner.edge).sum();
    if !(r0 > 0.0 && length.is_finite()) {
        return None;
    }
    let parameters = parameters(&corners, length);
    let modes = (2..=highest).map(|n| {
        let n = n as f64;
        let mut sum = [0.0; 2];
        for (corner, sigma) in corners.iter().zip(&parameters) {
            let (sin, cos) = libm::sincos(n * sigma);
            sum = [sum[0] + corner.turn * cos, sum[1] - corner.turn * sin];
        }
        // i n/(n^2 - 1) R0/(2 pi i n)
        let factor = r0 / (TAU * (n * n - 1.0));
        sum.map(|part| factor * part)
    });
    Some(TangentModes { r0, w: modes.collect() })
}

/// A vertex: how the outline turns there, and the edge that follows.
struct Corner {
    turn: f64,
    /// Direction of the edge that follows, unwrapped from the first.
    direction: f64,
    edge: f64,
}

/// `None` where the outline reverses or does not turn once.
fn corners(path: &[[f64; 2]]) -> Option<Vec<Corner>> {
    let along: Vec<[f64; 2]> = edges(path).map(|(a, b)| [b[0] - a[0], b[1] - a[1]]).collect();
    let mut before = *along.last()?;
    let mut direction = libm::atan2(before[1], before[0]);
    let mut corners = Vec::with_capacity(along.len());
    for edge in along {
        let cross = before[0] * edge[1] - before[1] * edge[0];
        let dot = before[0] * edge[0] + before[1] * edge[1];
        let turn = libm::atan2(cross, dot);
        if turn.abs() > PI - 1e-9 || !turn.is_finite() {
            return None;
        }
        direction += turn;
        corners.push(Corner { turn, direction, edge: libm::hypot(edge[0], edge[1]) });
        before = edge;
    }
    let total: f64 = corners.iter().map(|corner| corner.turn).sum();
    ((total - TAU).abs() < 1e-6).then_some(corners)
}

/// sigma at each vertex.
fn parameters(corners: &[Corner], length: f64) -> Vec<f64> {
    let (mut s, mut mean) = (0.0, 0.0);
    let mut starts = Vec::with_capacity(corners.len());
    for corner in corners {
        starts.push(TAU * s / length);
        // phi - 2 pi s/L over the edge: linear, its mean at the middle
        mean += corner.edge / length * (corner.direction - TAU * (s + 0.5 * corner.edge) / length);
        s += corner.edge;
    }
    starts.iter().map(|start| start + mean - FRAC_PI_2).collect()
}
