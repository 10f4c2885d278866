//! The oscillations that begin at a Hopf bifurcation, and the part of its period after which each is back.

use super::classes::Classes;
use super::hopf::{Vector, critical_space};
use super::kinds_of_oscillations::{Kind, kinds, parts, rotation_of_circle, turned};
use motiform_analysis::linear::{dot, norm};
use motiform_dynamics::Equivariant;
use std::f64::consts::{PI, TAU};

/// Largest error of the modulus of a rotation's eigenvalue.
const TURNED: f64 = 1e-4;

/// Largest even part of a deviation that is odd under the mirror.
const EVEN: f64 = 1e-6;

/// Oscillations are back after a part of their period above this.
const SOME: f64 = 1e-3;

/// `u + epsilon Re(q e^(i w t))` about a steady shape `u`, seen from the frame that turns with it.
pub(super) struct Oscillation {
    /// The shape `u`.
    pub(super) shape: Vec<f64>,
    /// The critical vector `q`.
    pub(super) re: Vec<f64>,
    pub(super) im: Vec<f64>,
    /// The angle of the mirror axis (`R(angle) M u = u`) across which the oscillation swings the shape: after half the period it is its
    /// mirror image.
    pub(super) across: Option<f64>,
    /// The part of `2 pi / w` after which it is back but for a rotation by the angle `turned`, or for the mirror.
    pub(super) part: f64,
    pub(super) turned: f64,
}

impl Oscillation {
    /// The oscillations of this frequency about a shape with such eigenvalues, one of each kind: several where rotations of the shape mix
    /// critical vectors. Those that only turn about a circle are no orbits: see [`rotating`].
    pub(super) fn all(body: &dyn Equivariant, shape: &[f64], frequency: f64) -> Vec<Self> {
        let Some(space) = critical_space(body, shape, frequency) else { return Vec::new() };
        let classes = Classes::of(body, &[shape]);
        kinds(body, &classes, &space).iter().map(|kind| Self::new(body, (shape, &classes), kind)).collect()
    }

    fn new(body: &dyn Equivariant, (shape, classes): (&[f64], &Classes), kind: &Kind) -> Self {
        let (re, im) = parts(&kind.vector);
        let across = kind.across.or_else(|| classes.axis.filter(|_| is_odd(classes, &re)));
        let (part, turned) = match across {
            Some(_) => (0.5, 0.0),
            None => turned_part(body, classes, &kind.vector).unwrap_or((1.0, 0.0)),
        };
        Self { shape: shape.to_vec(), re, im, across, part, turned }
    }

    /// The same turned so that the mirror axis across which it swings is that of the plane.
    pub(super) fn upright(mut self, body: &dyn Equivariant) -> Self {
        if let Some(axis) = self.across {
            for vector in [&mut self.shape, &mut self.re, &mut self.im] {
                body.rotate(-0.5 * axis, vector);
            }
        }
        self
    }

    /// The part of `2 pi / w` that is the period of the relative periodic orbits which begin: rotations are divided out, the mirror is not.
    pub(super) const fn period_part(&self) -> f64 {
        if self.across.is_some() { 1.0 } else { self.part }
    }
}

/// The deviation that only turns about a circle, and its turning rate (rad per model time): the relative equilibria that begin at a Hopf
/// bifurcation of a circle. `None` elsewhere.
///
/// `R(s) q = e^(i m s) q`, so that `Re(q e^(i w t))` turns at the rate `w / m`.
pub(super) fn rotating(body: &dyn Equivariant, shape: &[f64], frequency: f64) -> Option<(Vec<f64>, f64)> {
    let classes = Classes::of(body, &[shape]);
    if !classes.circle {
        return None;
    }
    let (vector, mode) = rotation_of_circle(body, &critical_space(body, shape, frequency)?)?;
    Some((parts(&vector).0, frequency / mode))
}

/// The least part of the period after which an oscillation `Re(q e^(i w t))` is back but for a rotation that leaves the shape as it is, and
/// the least angle of such a rotation: `R(angle) q = e^(i phi) q` is a shift of time by `phi / w`. `None` where the oscillation has no such
/// symmetry.
fn turned_part(body: &dyn Equivariant, classes: &Classes, q: &Vector) -> Option<(f64, f64)> {
    let angles: Vec<f64> = if !body.symmetry().rotations {
        Vec::new()
    } else if classes.circle {
        (1..=body.highest_mode()).map(|mode| PI / mode as f64).collect()
    } else {
        (1..classes.folds).map(|k| TAU * k as f64 / classes.folds as f64).collect()
    };
    let part = |angle: f64| {
        let product = q.dotc(&turned(body, angle, q)) / q.dotc(q);
        let part = (product.arg() / TAU).rem_euclid(1.0);
        ((product.norm() - 1.0).abs() < TURNED && (SOME..1.0 - SOME).contains(&part)).then_some((part, angle))
    };
    let order = |a: &(f64, f64), b: &(f64, f64)| {
        if (a.0 - b.0).abs() < SOME { a.1.total_cmp(&b.1) } else { a.0.total_cmp(&b.0) }
    };
    let (part, angle) = angles.into_iter().filter_map(part).min_by(order)?;
    // the parts are exact fractions
    let whole = if classes.circle { 2.0 } else { classes.folds as f64 };
    Some(((part * whole).round() / whole, angle))
}

/// Returns `true` if a shape has a mirror axis and the deviation is odd under it.
fn is_odd(classes: &Classes, deviation: &[f64]) -> bool {
    let even = |basis: &Vec<Vec<f64>>| basis.iter().map(|v| dot(v, deviation).abs()).fold(0.0, f64::max);
    classes.axis.is_some() && even(&classes.bases[0]) < EVEN * norm(deviation)
}
