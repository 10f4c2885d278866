//! The scale on which motions vary, and how well their equations are known.

use super::family::Bodies;
use motiform_analysis::equilibrium::{Units, round_off, vicinity};
use motiform_analysis::linear::{add, norm};
use motiform_dynamics::Equivariant;
use motiform_dynamics::tangent::jacobian;

/// Round-off is seen in a few samples: its bound is so many times the largest.
const SAFE: f64 = 4.0;

/// The scale of the shapes along a branch. The size of a shape is that scale where rotations single out the shape 0, and where terms of the
/// equations balance at that size or above; elsewhere it may be that of an offset, or of a part that does not act on the others.
#[derive(Clone)]
pub(super) struct Vicinity {
    /// The shape from which changes are measured: 0, or one of the branch.
    pub(super) centre: Vec<f64>,
    /// The unit of changes of a shape.
    pub(super) size: f64,
    /// The units of the equations there.
    pub(super) units: Units,
    /// The round-off of the equations, which the solutions inherit, in the units of size and rate.
    pub(super) round_off: f64,
}

impl Vicinity {
    /// Returns `true` if changes are measured from a shape of the branch.
    pub(super) fn is_offset(&self) -> bool {
        self.centre.iter().any(|x| *x != 0.0)
    }
}

impl Bodies<'_> {
    /// The scale of a motion with these shapes.
    pub(super) fn vicinity(
        self,
        body: &dyn Equivariant,
        (parameters, widths): (&[f64], &[f64]),
        shapes: &[&[f64]],
    ) -> Vicinity {
        let beside = self.beside(parameters, widths);
        let all: Vec<&dyn Equivariant> = [body].into_iter().chain(beside.iter().map(AsRef::as_ref)).collect();
        let (centre, extent) = spread(shapes.iter().copied());
        let largest = shapes.iter().map(|shape| norm(shape)).fold(0.0, f64::max);
        let near = vicinity(&all, &centre).map(|size| size.max(extent)).filter(|size| *size < largest);
        // a shape that is as good as nothing is no offset
        let near = near.filter(|_| Units::among(&all).size(largest) <= largest);
        let (centre, size, units) = match near {
            Some(size) => {
                let units = Units::beside(&all, &centre, size);
                (centre, size, units)
            }
            None => {
                let units = Units::among(&all);
                (vec![0.0; body.dim()], units.size(largest), units)
            }
        };
        let unknown = shapes.iter().map(|shape| unknown(body, shape, units.rate)).fold(0.0, f64::max);
        Vicinity { centre, size, units, round_off: SAFE * unknown / size }
    }
}

/// The mean of some shapes, and the largest distance of one from it.
pub(super) fn spread<'x>(shapes: impl Iterator<Item = &'x [f64]> + Clone) -> (Vec<f64>, f64) {
    let count = shapes.clone().count() as f64;
    let mut mean = vec![0.0; shapes.clone().next().map_or(0, <[f64]>::len)];
    shapes.clone().for_each(|shape| add(&mut mean, 1.0 / count, shape));
    let apart = |shape: &[f64]| {
        let apart: Vec<f64> = shape.iter().zip(&mean).map(|(a, b)| a - b).collect();
        norm(&apart)
    };
    let extent = shapes.map(apart).fold(0.0, f64::max);
    (mean, extent)
}

/// The changes of a shape that its equations do not see for round-off: errors of rates over the rates of the modes, or over `rate` where
/// that is larger.
fn unknown(body: &dyn Equivariant, shape: &[f64], rate: f64) -> f64 {
    let (errors, matrix) = (round_off(body, shape, 0.0), jacobian(body, shape));
    let largest = |i: usize| matrix[i..].iter().step_by(shape.len()).fold(rate, |most, x| most.max(x.abs()));
    let parts: Vec<f64> = errors.iter().enumerate().map(|(i, error)| error / largest(i)).collect();
    norm(&parts)
}
