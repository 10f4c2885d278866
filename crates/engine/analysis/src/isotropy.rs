//! The symmetry of one shape: which rotations and mirrors leave it as it is.

use crate::linear::{add, norm};
use crate::symmetry::align;
use motiform_dynamics::Equivariant;

/// The rotations and mirrors of the plane that leave a shape unchanged: its isotropy subgroup.
///
/// The symmetry of a shape is that of its whole orbit: the flow commutes with the symmetry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Isotropy {
    /// Order of the rotations that leave the shape unchanged: 1 for none. A circle counts as 1, see `circle`.
    pub folds: usize,
    /// `true` if every rotation leaves it unchanged.
    pub circle: bool,
    /// The angle (rad) of its mirror axis, if it has one: `R(angle) M u = u`.
    pub mirror: Option<f64>,
}

impl Isotropy {
    /// The part of its size up to which a shape that Newton's method found, or one of an orbit that it found,
    /// counts as equal to its image. Where the error of the shape is known, that error decides instead
    /// ([`SteadyMotion`](crate::SteadyMotion)).
    pub const SAME: f64 = 1e-6;

    /// The isotropy of `shape`, where an image counts as equal up to `tolerance` of the shape's size.
    ///
    /// # Checked by  tests/all/isotropy.rs: pure modes, bodies with an axis in any direction, the circle, general shapes
    pub fn of(body: &dyn Equivariant, shape: &[f64], tolerance: f64) -> Self {
        let size = norm(shape);
        let symmetry = body.symmetry();
        let spin = body.spun(shape);
        let circle = symmetry.rotations && norm(&spin) <= tolerance * size;
        let axis = symmetry.mirror.then(|| align(body, shape, shape, true));
        let mirror = axis.filter(|axis| axis.distance <= tolerance * size).map(|axis| axis.angle);
        Self { folds: if circle { 1 } else { folds(body, shape, tolerance) }, circle, mirror }
    }

    /// Returns `true` if nothing but the identity leaves the shape unchanged.
    pub fn is_trivial(&self) -> bool {
        !self.circle && self.folds == 1 && self.mirror.is_none()
    }
}

/// The order of the rotations that leave the shape unchanged (1 for none; a circle counts as 1).
fn folds(body: &dyn Equivariant, shape: &[f64], tolerance: f64) -> usize {
    let fixed = |folds: &usize| {
        let mut turned = shape.to_vec();
        body.rotate(std::f64::consts::TAU / *folds as f64, &mut turned);
        add(&mut turned, -1.0, shape);
        norm(&turned) < tolerance * norm(shape)
    };
    let most = if body.symmetry().rotations { 16.min(shape.len()) } else { 1 };
    (2..=most).rev().find(fixed).unwrap_or(1)
}

/// The mean of the images of `shape` under the rotations by multiples of `2 pi / count`. With more of them than the shape has modes
/// only what no rotation changes is left. What is below the rounding error of the sum is 0.
pub fn mean_over_rotations(body: &dyn Equivariant, shape: &[f64], count: usize) -> Vec<f64> {
    let mut sum = vec![0.0; shape.len()];
    for k in 0..count {
        let mut turned = shape.to_vec();
        body.rotate(std::f64::consts::TAU * k as f64 / count as f64, &mut turned);
        add(&mut sum, 1.0 / count as f64, &turned);
    }
    let rounding = f64::EPSILON * count as f64 * norm(shape);
    sum.iter_mut().filter(|x| x.abs() <= rounding).for_each(|x| *x = 0.0);
    sum
}
