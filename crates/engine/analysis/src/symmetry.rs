//! The plane's rotations divided out.
//!
//! Two shapes that differ by a rotation are one reduced shape. Two tools do this without any point where they break down:
//! * a **distance** between reduced shapes, by the best alignment ([`align`]): a metric, whatever the shapes are (v = 0,
//!   pure modes, circles);
//! * a **moving frame** along an orbit ([`MovingFrame`]): the frame that turns exactly as fast as the shape does, in the
//!   sense of least motion. It is regular wherever the shape is not a circle, and for a circle every frame is right.
//!
//! Source: the frame is the mechanical connection; Marsden, Montgomery, Ratiu (1990), Mem. AMS 436; for pattern-forming
//! systems Rowley, Kevrekidis, Marsden, Lust (2003), Nonlinearity 16, 1257.

pub use crate::gauge::Gauge;

use crate::linear::{add, dot, norm};
use motiform_dynamics::{Bundle, Equivariant, System, VectorField};
use std::f64::consts::TAU;

/// The rotation (after a mirror) that maps one shape closest to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alignment {
    /// The rotation (rad, in -pi..pi), applied after the mirror.
    pub angle: f64,
    /// The remaining distance: `min_angle |reference - R(angle) [M] shape|`.
    pub distance: f64,
}

/// The rotation of `shape` (mirrored first, if `mirrored`) that comes closest to `reference`.
///
/// `|reference - R(a) u|^2 = |reference|^2 + |u|^2 - 2 c(a)`, `c(a) = reference . R(a) u` a trigonometric polynomial: its
/// maxima on a grid fine enough for every mode of the state, then Newton steps on `c'`, and the best of them.
///
/// # Checked by  tests/all/symmetry.rs: exact on the group orbit (nearly symmetric shapes too), a metric
pub fn align(body: &dyn Equivariant, reference: &[f64], shape: &[f64], mirrored: bool) -> Alignment {
    let mut base = shape.to_vec();
    if mirrored {
        body.mirror(&mut base);
    }
    let mut overlaps = vec![0.0; angles(body)];
    if overlaps.len() > 1 {
        body.overlaps(reference, &base, &mut overlaps);
    }
    best(body, reference, &base, &overlaps)
}

/// A shape with its copies turned by equal angles: what many searches for the nearest copy have in common.
#[derive(Clone, Debug)]
pub(crate) struct Copies {
    shape: Vec<f64>,
    /// The first coordinate of every copy, then the second, and so on.
    turned: Vec<f64>,
    count: usize,
}

impl Copies {
    pub(crate) fn of(body: &dyn Equivariant, shape: &[f64]) -> Self {
        let count = angles(body);
        let mut turned = vec![0.0; shape.len() * count];
        for place in 0..count {
            let mut copy = shape.to_vec();
            body.rotate(TAU / count as f64 * place as f64, &mut copy);
            copy.iter().enumerate().for_each(|(i, &x)| turned[i * count + place] = x);
        }
        Self { shape: shape.to_vec(), turned, count }
    }

    /// The shape.
    pub(crate) fn shape(&self) -> &[f64] {
        &self.shape
    }

    /// The nearest of the copies of the shape at all angles, where one is nearer than half of the shape's
    /// size; farther away, the nearest of those at equal angles (eight to a wave of the highest mode), which
    /// takes no sine.
    pub(crate) fn nearest(&self, body: &dyn Equivariant, reference: &[f64]) -> Vec<f64> {
        let mut overlaps = vec![0.0; self.count];
        for (&x, column) in reference.iter().zip(self.turned.chunks_exact(self.count)) {
            add(&mut overlaps, x, column);
        }
        let top = (0..self.count).max_by(|&i, &j| overlaps[i].total_cmp(&overlaps[j])).unwrap_or(0);
        let mut copy: Vec<f64> = (0..self.shape.len()).map(|i| self.turned[i * self.count + top]).collect();
        let square = dot(&self.shape, &self.shape);
        if dot(reference, reference) + square - 2.0 * overlaps[top] < 0.25 * square {
            copy.copy_from_slice(&self.shape);
            body.rotate(best(body, reference, &self.shape, &overlaps).angle, &mut copy);
        }
        copy
    }
}

/// The number of equal angles that every mode of the body needs.
fn angles(body: &dyn Equivariant) -> usize {
    if body.symmetry().rotations { (8 * body.highest_mode()).clamp(32, 512) } else { 1 }
}

/// The best alignment of `base` with `reference`, from its overlaps at equal angles.
fn best(body: &dyn Equivariant, reference: &[f64], base: &[f64], overlaps: &[f64]) -> Alignment {
    let points = overlaps.len();
    let mut turned = base.to_vec();
    let mut turn = |angle: f64| {
        turned.copy_from_slice(base);
        body.rotate(angle, &mut turned);
        let rest: f64 = reference.iter().zip(&turned).map(|(a, b)| (a - b) * (a - b)).sum();
        Alignment { angle: wrap(angle), distance: rest.sqrt() }
    };
    if points == 1 {
        return turn(0.0);
    }
    let cell = TAU / points as f64;
    // Between grid points c rises by (N cell / 2)^2 / 2 of |reference| |u| at most, N the highest mode: a shape that is
    // nearly its own image has several maxima that differ by less.
    let highest = overlaps.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let half = 0.5 * body.highest_mode() as f64 * cell;
    let least = highest - 0.5 * half * half * norm(reference) * norm(base);
    let tops = (0..points).filter(|&i| {
        let (before, after) = (overlaps[(i + points - 1) % points], overlaps[(i + 1) % points]);
        overlaps[i] >= least && overlaps[i] >= before && overlaps[i] > after || overlaps[i] == highest
    });
    let mut best = turn(0.0);
    for top in tops {
        let found = turn(refine(body, reference, base, cell * top as f64, cell));
        if found.distance < best.distance {
            best = found;
        }
    }
    best
}

/// Newton's method on `c'(a) = reference . R(a) G u`, `c''(a) = reference . R(a) G G u`, within one grid cell.
fn refine(body: &dyn Equivariant, reference: &[f64], base: &[f64], start: f64, cell: f64) -> f64 {
    let (mut first, mut second) = (base.to_vec(), base.to_vec());
    let (mut angle, mut turned) = (start, base.to_vec());
    for _ in 0..8 {
        turned.copy_from_slice(base);
        body.rotate(angle, &mut turned);
        body.spin(&turned, &mut first);
        body.spin(&first, &mut second);
        let (slope, bend) = (dot(reference, &first), dot(reference, &second));
        let step = if bend < 0.0 { -slope / bend } else { 0.0 };
        let next = (angle + step).clamp(start - cell, start + cell);
        let done = (next - angle).abs() < 1e-15;
        angle = next;
        if done {
            break;
        }
    }
    angle
}

/// The same angle in -pi..pi.
pub fn wrap(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

/// The turning rate of the shape: `omega = Gu . f / |Gu|^2` makes `|f - omega Gu|` least; 0 for a circle.
pub fn turning_of_shape(body: &dyn Equivariant, shape: &[f64], rate: &[f64]) -> f64 {
    let spin = body.spun(shape);
    let size = dot(&spin, &spin);
    if size > 0.0 { dot(&spin, rate) / size } else { 0.0 }
}

/// `|f - omega Gu|` with the best omega: how fast the reduced shape changes.
pub fn reduced_speed(body: &dyn Equivariant, shape: &[f64], rate: &[f64]) -> f64 {
    let spin = body.spun(shape);
    speed_beside(&spin, rate)
}

/// `|f - omega g|` with the best omega, for the rates `f` and the rotation `g` of a shape.
#[inline(always)]
pub(crate) fn speed_beside<S: Bundle>(spin: &[S], rate: &[S]) -> S {
    let zero = S::splat(0.0);
    let (mut along, mut size, mut rest) = (zero, zero, zero);
    for i in 0..spin.len() {
        along = spin[i].mul_add(rate[i], along);
        size = spin[i].mul_add(spin[i], size);
    }
    let omega = S::select(zero.less(size), along / size, zero);
    for i in 0..spin.len() {
        let left = rate[i] - omega * spin[i];
        rest = left.mul_add(left, rest);
    }
    rest.sqrt()
}

/// The flow seen from a frame that turns with the shape, and what it takes to come back: state `(w, theta, x, y)` with
/// `w' = f(w) - omega(w) G w`, `theta' = omega(w)`, `(x, y)' = R(theta) v(w)`.
///
/// The shape is `R(theta) w`, the position `(x, y)`: heading and path are reconstructed from the reduced orbit.
#[derive(Clone, Copy)]
pub struct MovingFrame<'b>(pub &'b dyn Equivariant);

impl System for MovingFrame<'_> {
    fn dim(&self) -> usize {
        self.0.dim() + 3
    }

    fn kept(&self) -> u64 {
        self.0.kept()
    }
}

impl VectorField<f64> for MovingFrame<'_> {
    fn eval(&self, t: f64, u: &[f64], du: &mut [f64]) {
        let (shape, place) = u.split_at(self.0.dim());
        let (rate, moves) = du.split_at_mut(shape.len());
        VectorField::<f64>::eval(self.0, t, shape, rate);
        let spin = self.0.spun(shape);
        let omega = turning_of_shape(self.0, shape, rate);
        for (r, g) in rate.iter_mut().zip(&spin) {
            *r -= omega * g;
        }
        let [vx, vy] = motiform_dynamics::model::velocity(self.0, shape);
        let (sin, cos) = libm::sincos(place[0]);
        moves.copy_from_slice(&[omega, cos * vx - sin * vy, sin * vx + cos * vy]);
    }
}
