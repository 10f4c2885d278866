//! The oscillation that begins at a Hopf bifurcation, and the part of its period after which it is back.

use super::classes::Classes;
use super::hopf::critical_pair;
use motiform_analysis::linear::{dot, norm};
use motiform_dynamics::Equivariant;
use std::f64::consts::TAU;

/// Largest error of the modulus of a rotation's eigenvalue.
const TURNED: f64 = 1e-4;

/// Largest even part of a deviation that is odd under the mirror.
const EVEN: f64 = 1e-6;

/// `u + epsilon Re(q e^(i w t))` about a steady shape `u`, seen from the frame that turns with it.
pub(super) struct Oscillation {
    /// The shape `u`.
    pub(super) shape: Vec<f64>,
    /// The critical vector `q`.
    pub(super) re: Vec<f64>,
    pub(super) im: Vec<f64>,
    /// `true` if the oscillation swings the shape from one side of its mirror axis to the other: after half the period it is its mirror
    /// image.
    pub(super) mirrored: bool,
    /// The part of `2 pi / w` after which it is back but for a rotation by the angle `turned`, or for the mirror.
    pub(super) part: f64,
    pub(super) turned: f64,
}

impl Oscillation {
    /// The oscillation of this frequency about a shape with such a pair of eigenvalues.
    pub(super) fn of(body: &dyn Equivariant, shape: &[f64], frequency: f64) -> Option<Self> {
        let (re, im) = critical_pair(body, shape, frequency)?;
        let classes = Classes::of(body, &[shape]);
        let mirrored = is_odd(&classes, &re);
        let (part, turned) =
            if mirrored { (0.5, 0.0) } else { turned_part(body, &classes, (&re, &im)).unwrap_or((1.0, 0.0)) };
        Some(Self { shape: shape.to_vec(), re, im, mirrored, part, turned })
    }

    /// The same turned so that its mirror axis, where it swings across one, is that of the plane.
    pub(super) fn upright(mut self, body: &dyn Equivariant) -> Self {
        if let (true, Some(axis)) = (self.mirrored, Classes::of(body, &[&self.shape]).axis) {
            for vector in [&mut self.shape, &mut self.re, &mut self.im] {
                body.rotate(-0.5 * axis, vector);
            }
        }
        self
    }

    /// The part of `2 pi / w` that is the period of the relative periodic orbits which begin: rotations are divided out, the mirror is not.
    pub(super) fn period_part(&self) -> f64 {
        if self.mirrored { 1.0 } else { self.part }
    }
}

/// The least part of the period after which an oscillation `Re(q e^(i w t))` about a shape with `n` rotations is back but for one of them,
/// and its angle: `R(2 pi / n) q = e^(i phi) q`, so that the rotation number `k` is a shift of time by `k phi / w`. `None` where the
/// oscillation keeps the rotations.
fn turned_part(body: &dyn Equivariant, classes: &Classes, (re, im): (&[f64], &[f64])) -> Option<(f64, f64)> {
    if classes.folds < 2 || classes.circle || !body.symmetry().rotations {
        return None;
    }
    let angle = TAU / classes.folds as f64;
    let (mut re_turned, mut im_turned) = (re.to_vec(), im.to_vec());
    body.rotate(angle, &mut re_turned);
    body.rotate(angle, &mut im_turned);
    let size = dot(re, re) + dot(im, im);
    let cos = (dot(re, &re_turned) + dot(im, &im_turned)) / size;
    let sin = (dot(re, &im_turned) - dot(im, &re_turned)) / size;
    if (libm::hypot(cos, sin) - 1.0).abs() > TURNED {
        return None; // several pairs are critical
    }
    let shift = (sin.atan2(cos) / angle).round().rem_euclid(classes.folds as f64) as usize; // phi in units of the angle
    let parts = (1..classes.folds).map(|k| (k * shift % classes.folds, k)).filter(|part| part.0 > 0);
    parts.min().map(|(part, k)| (part as f64 / classes.folds as f64, k as f64 * angle))
}

/// Returns `true` if a shape has a mirror axis and the deviation is odd under it.
fn is_odd(classes: &Classes, deviation: &[f64]) -> bool {
    let even = |basis: &Vec<Vec<f64>>| basis.iter().map(|v| dot(v, deviation).abs()).fold(0.0, f64::max);
    classes.axis.is_some() && even(&classes.bases[0]) < EVEN * norm(deviation)
}
