//! Dynamics with the symmetry of the plane: the requirements of every analysis of a motion.

use crate::tangent::Differentiable;
use crate::{Dual, Semilinear, Shape, VectorField};
use std::f64::consts::TAU;

/// The motions of the plane that map solutions to solutions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Symmetry {
    /// All rotations. Two shapes that differ by one are the same reduced shape.
    pub rotations: bool,
    /// The reflection y -> -y (with rotations: at any line).
    pub mirror: bool,
}

impl Symmetry {
    /// Rotations and the mirror: no direction and no hand is preferred.
    pub const FULL: Self = Self { rotations: true, mirror: true };

    /// All symmetries with their names.
    pub const NAMES: [(&'static str, Self); 4] = [
        ("rotation+mirror", Self::FULL),
        ("rotation", Self { rotations: true, mirror: false }),
        ("mirror", Self { rotations: false, mirror: true }),
        ("none", Self { rotations: false, mirror: false }),
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(_, symmetry)| *symmetry == self).map_or("none", |(name, _)| name)
    }
}

/// An autonomous shape, the velocity determined by it, exact derivatives of both, and how rotations of the plane
/// and the reflection act on it.
///
/// It contains only what analyses need ([`crate::Model`] adds names and drawing). The defaults are
/// those of a system without symmetry; a body in the plane overrides them. Object-safe.
///
/// # Symmetry
/// The flow on shapes must commute with the motions that [`Equivariant::symmetry`] names, the velocity must transform with
/// them, and they act by orthogonal matrices: [`crate::conformance`] checks every model.
pub trait Equivariant:
    Semilinear<f64> + Semilinear<Dual<f64, 1>> + Differentiable + Shape<f64> + Shape<Dual<f64, 1>> + Send + Sync
{
    /// The motions of the plane that act. Without rotations, [`Equivariant::rotate`] and
    /// [`Equivariant::spin`] do nothing; without the mirror, [`Equivariant::mirror`] does nothing.
    fn symmetry(&self) -> Symmetry {
        Symmetry::default()
    }

    /// Returns `true` if a turn by half a circle maps solutions to solutions. A field that has this symmetry
    /// and breaks rotations has an axis, but no sense along it.
    fn half_turn(&self) -> bool {
        self.symmetry().rotations
    }

    /// Turns the shape by `angle` (rad, anticlockwise), in place.
    fn rotate(&self, _angle: f64, _shape: &mut [f64]) {}

    /// `out_i = reference . R(2 pi i / out.len()) shape`: how well a shape fits another one when it is turned by equal angles. A body
    /// that overrides it gives the same bits.
    fn overlaps(&self, reference: &[f64], shape: &[f64], out: &mut [f64]) {
        overlaps_by_rotation(self, reference, shape, out);
    }

    /// The infinitesimal rotation: writes `d/d(angle) rotate(angle, shape)` at `angle = 0`.
    fn spin(&self, _shape: &[f64], out: &mut [f64]) {
        out.fill(0.0);
    }

    /// As [`Equivariant::spin`], in a vector of its own.
    fn spun(&self, shape: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; shape.len()];
        self.spin(shape, &mut out);
        out
    }

    /// The rates of change of a shape, in a vector of their own.
    fn rates(&self, shape: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; shape.len()];
        VectorField::<f64>::eval(self, 0.0, shape, &mut out);
        out
    }

    /// Mirrors the shape at the x axis (y -> -y), in place.
    fn mirror(&self, _shape: &mut [f64]) {}

    /// The largest angular index among its modes: a rotation by `angle` turns none by more than this times `angle`.
    fn highest_mode(&self) -> usize {
        self.dim() / 2
    }

    /// Speeds below this are round-off for this shape, or below what a run with absolute tolerance `atol` resolves: the
    /// body is at rest and has no heading. 0 if the velocity is itself an unknown, with its own relative accuracy.
    fn speed_resolution(&self, _shape: &[f64], _atol: f64) -> f64 {
        0.0
    }
}

/// [`Equivariant::overlaps`] by one rotation after the other.
pub fn overlaps_by_rotation<B: Equivariant + ?Sized>(
    body: &B,
    reference: &[f64],
    shape: &[f64],
    out: &mut [f64],
) {
    let cell = TAU / out.len() as f64;
    let mut turned = shape.to_vec();
    for (point, overlap) in out.iter_mut().enumerate() {
        turned.copy_from_slice(shape);
        body.rotate(cell * point as f64, &mut turned);
        *overlap = reference.iter().zip(&turned).map(|(a, b)| a * b).sum();
    }
}
