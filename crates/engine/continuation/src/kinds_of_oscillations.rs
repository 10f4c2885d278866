//! The kinds of oscillations that begin where rotations of a shape mix critical vectors.

use super::classes::Classes;
use super::hopf::Vector;
use motiform_dynamics::Equivariant;
use nalgebra::{Complex, DVector};
use std::f64::consts::TAU;

/// Two eigenvalues of a rotation closer than this are one, and vectors that differ by less are images of each other.
const SAME: f64 = 1e-3;

/// The critical vector of one kind of oscillation.
pub(super) struct Kind {
    pub(super) vector: Vector,
    /// The angle of the mirror axis across which it swings, where it is known to.
    pub(super) across: Option<f64>,
}

/// The oscillations in the space of critical vectors, one of each kind up to the symmetry of the shape: three where the `n > 2`
/// rotations of a shape with mirror axes mix two vectors, two standing ones and one that turns; two that turn where there is no mirror;
/// the standing one for a circle, and none where it has no mirror: it only turns. Elsewhere there is one critical vector, or nothing
/// says which combinations oscillate.
///
/// Source: Golubitsky, Stewart, Schaeffer (1988), Singularities and Groups in Bifurcation Theory II, chapters XVII and XVIII: the
/// equivariant Hopf theorem for `O(2)` and `D_n`.
///
/// # Checked by  tests/all/symmetric_hopf.rs: normal forms for a circle, and for shapes with 3 to 6 rotations
pub(super) fn kinds(body: &dyn Equivariant, classes: &Classes, space: &[Vector]) -> Vec<Kind> {
    let all = || space.iter().map(|vector| Kind { vector: vector.clone(), across: None });
    if classes.circle && rotation_of_circle(body, space).is_some() && space.len() == 1 {
        return Vec::new(); // it only turns
    }
    let mixed = body.symmetry().rotations && (classes.circle || classes.folds > 2);
    if !mixed || space.len() != 2 {
        return all().take(1).collect();
    }
    let angle = if classes.circle { small_angle(body) } else { TAU / classes.folds as f64 };
    let Some(turning) = turning(body, angle, space) else { return all().collect() };
    let mut found = standing(body, classes, space);
    if !classes.circle {
        let new = if classes.axis.is_some() { 1 } else { 2 };
        found.extend(turning.into_iter().take(new).map(|vector| Kind { vector, across: None }));
    }
    found
}

/// The standing oscillations: those that keep a mirror axis, or swing across one.
fn standing(body: &dyn Equivariant, classes: &Classes, space: &[Vector]) -> Vec<Kind> {
    let Some(axis) = classes.axis else { return Vec::new() };
    let angle = TAU / classes.folds as f64;
    let (axes, signs): (_, &[f64]) = if classes.circle { (1, &[1.0]) } else { (2, &[1.0, -1.0]) };
    let mut found: Vec<Kind> = Vec::new();
    for sign in signs {
        for k in 0..axes {
            let axis = axis + angle * f64::from(k);
            let part = |v: &Vector| v + reflected(body, axis, v) * Complex::new(*sign, 0.0);
            let longest = space.iter().map(part).max_by(|a, b| a.norm().total_cmp(&b.norm()));
            let Some(vector) = longest.filter(|v| v.norm() > SAME).map(|v| v.normalize()) else { continue };
            let is_image = |a: &Vector| a.dotc(&vector).norm() > 1.0 - SAME;
            let known = found.iter().any(|other| {
                (0..classes.folds).any(|k| is_image(&turned(body, angle * k as f64, &other.vector)))
            });
            if !known {
                found.push(Kind { vector, across: (*sign < 0.0).then_some(axis) });
            }
        }
    }
    found
}

/// An angle by which no two modes are turned alike.
fn small_angle(body: &dyn Equivariant) -> f64 {
    1.0 / (1.0 + body.highest_mode() as f64)
}

/// A critical vector `q` of a circle that rotations multiply by numbers, `R(s) q = e^(i m s) q`, and `m`, which is not 0.
pub(super) fn rotation_of_circle(body: &dyn Equivariant, space: &[Vector]) -> Option<(Vector, f64)> {
    let angle = small_angle(body);
    let vector = match space {
        [only] => only.clone(),
        _ => turning(body, angle, space)?.into_iter().next()?,
    };
    let product = vector.dotc(&turned(body, angle, &vector));
    let mode = (product.arg() / angle).round();
    ((product.norm() - 1.0).abs() < SAME && mode != 0.0).then_some((vector, mode))
}

/// The two vectors of the space that a rotation multiplies by numbers; `None` where these are the same.
pub(super) fn turning(body: &dyn Equivariant, angle: f64, space: &[Vector]) -> Option<Vec<Vector>> {
    let [a, b] = space else { return None };
    let (ra, rb) = (turned(body, angle, a), turned(body, angle, b));
    let (trace, difference) = (a.dotc(&ra) + b.dotc(&rb), a.dotc(&ra) - b.dotc(&rb));
    let root = (difference * difference * 0.25 + a.dotc(&rb) * b.dotc(&ra)).sqrt();
    if root.norm() < 0.5 * SAME {
        return None;
    }
    // (R - other eigenvalue) takes every vector to the eigenvector
    let own = |sign: f64| {
        let other = trace * 0.5 - root * sign;
        let images = [&ra - a * other, &rb - b * other];
        images.into_iter().max_by(|x, y| x.norm().total_cmp(&y.norm())).map(|v| v.normalize())
    };
    [own(1.0), own(-1.0)].into_iter().collect()
}

/// Real and imaginary part.
pub(super) fn parts(q: &Vector) -> (Vec<f64>, Vec<f64>) {
    (q.iter().map(|z| z.re).collect(), q.iter().map(|z| z.im).collect())
}

/// `R(angle) q`.
pub(super) fn turned(body: &dyn Equivariant, angle: f64, q: &Vector) -> Vector {
    of_parts(q, |part| body.rotate(angle, part))
}

/// `R(axis) M q`.
fn reflected(body: &dyn Equivariant, axis: f64, q: &Vector) -> Vector {
    of_parts(q, |part| {
        body.mirror(part);
        body.rotate(axis, part);
    })
}

fn of_parts(q: &Vector, act: impl Fn(&mut [f64])) -> Vector {
    let (mut re, mut im) = parts(q);
    act(&mut re);
    act(&mut im);
    DVector::from_iterator(q.len(), re.into_iter().zip(im).map(|(re, im)| Complex::new(re, im)))
}
