//! The units that equations have of themselves.

use super::balance::{balances, beside};
use super::uncertainty::round_off;
use crate::linear::norm;
use crate::periodic::Flow;
use motiform_dynamics::sample::ascending;
use motiform_dynamics::{Equivariant, StepControl, model};

/// Rays along which rates are looked at, and fewest for sizes.
const RAYS: usize = 2;

/// Unknowns of all rays along which sizes are looked for: their median is that of many directions, so that the order of few equations is
/// nothing to it.
const UNKNOWNS: usize = 128;

/// Coordinates that may have sizes of their own; of more than these, as of a field on a grid, all have one.
const ALONE: usize = 32;

/// A shape of no more than this part of the unit is no size.
const NOTHING: f64 = 1e-6;

/// Rates of fewer than this many errors by rounding say nothing about the size of a term.
const CLEAR: f64 = 30.0;

/// Least degree of terms by which rates change otherwise than in proportion.
const NONLINEAR: f64 = 2.0;

/// A shape that is larger than another size by more than this factor is far larger.
const FAR: f64 = 4.0;

/// The units of bounds and steps where the motion itself has no size: at rest, and for turning rates.
///
/// Each is a power of 1000, as prefixes of units are: equations of ordinary size have the units 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units {
    /// The size of shapes at which terms of the equations balance.
    pub length: f64,
    /// The rates at which shapes of that size change, as parts of them.
    pub rate: f64,
}

impl Units {
    /// The units of a field: along rays on which modes decay with the third power of their number, where it has a meaning, the median
    /// of the sizes at which terms balance, and the rate there.
    pub fn of(body: &dyn Equivariant) -> Self {
        Self::among(&[body])
    }

    /// The units of several fields that differ in the values of parameters: where a coefficient vanishes at one of them, the others have
    /// it.
    pub fn among(bodies: &[&dyn Equivariant]) -> Self {
        let length = balance(bodies);
        let centre = bodies.first().map_or_else(Vec::new, |body| vec![0.0; body.dim()]);
        Self { length: prefix(length), rate: prefix(fastest(bodies, &centre, length)) }
    }

    /// The same for shapes beside one, with changes of the size `vicinity`.
    pub fn beside(bodies: &[&dyn Equivariant], shape: &[f64], vicinity: f64) -> Self {
        Self { length: prefix(vicinity), rate: prefix(fastest(bodies, shape, vicinity)) }
    }

    /// A flow whose absolute tolerance is that of shapes of the unit's size.
    pub fn flow(self, flow: Flow) -> Flow {
        let control = match flow.control {
            StepControl::Adaptive { rtol, atol } => StepControl::Adaptive { rtol, atol: atol * self.length },
            fixed => fixed,
        };
        Flow { control, ..flow }
    }

    /// The largest speed of the centre of mass of the shapes of the unit's size along those rays.
    pub fn speed(self, body: &dyn Equivariant) -> f64 {
        let speed = |ray: Vec<f64>| {
            let shape: Vec<f64> = ray.iter().map(|w| self.length * w).collect();
            let velocity = model::velocity(body, &shape);
            libm::hypot(velocity[0], velocity[1])
        };
        rays(body, RAYS).into_iter().map(speed).fold(0.0, f64::max)
    }

    /// The units of times and angles in which they and the shapes that they lead to are changes of one size.
    pub(crate) fn time_and_angle(self) -> [f64; 2] {
        [1.0 / (self.length * self.rate), 1.0 / self.length]
    }

    /// The unit of turning rates in which a shape and its rotation are changes of one size: that of rates for each unit of length.
    pub(super) fn turning(self) -> f64 {
        self.rate / self.length
    }

    /// The size of a shape, which may be far from that at which terms balance, and the rate of shapes of that size.
    pub(crate) fn of_shape(body: &dyn Equivariant, shape: &[f64]) -> Self {
        let length = prefix(norm(shape));
        let centre = vec![0.0; body.dim()];
        Self { length, rate: prefix(fastest(&[body], &centre, length)) }
    }

    /// The size of a shape, or that of the equations for one that is as good as nothing.
    pub fn size(self, shape: f64) -> f64 {
        if shape > NOTHING * self.length { shape } else { self.length }
    }
}

/// The median of the sizes at which terms of some fields balance, along rays on which modes decay with the third power of their number;
/// 1 where none do.
pub fn balance(bodies: &[&dyn Equivariant]) -> f64 {
    let count = |body: &dyn Equivariant| (UNKNOWNS / body.dim().max(1)).max(RAYS);
    let of = |body: &&dyn Equivariant| balances(*body, &rays(*body, count(*body)));
    let mut sizes: Vec<f64> = bodies.iter().flat_map(of).collect();
    ascending(&mut sizes);
    sizes.get(sizes.len() / 2).copied().unwrap_or(1.0)
}

/// The largest of these sizes, also along each of at most 32 coordinates alone; 1 where no terms balance. Equations that do not act on
/// each other may have sizes of their own, and at the size of one the rates of another exceed it by so much that its terms do not show.
/// A shape has left every bound only where it is beyond all sizes.
pub fn largest_balance(body: &dyn Equivariant) -> f64 {
    let alone = if body.dim() <= ALONE { body.dim() } else { 0 };
    let axis = |i: usize| (0..body.dim()).map(|j| if i == j { 1.0 } else { 0.0 }).collect();
    let directions: Vec<Vec<f64>> = rays(body, RAYS).into_iter().chain((0..alone).map(axis)).collect();
    balances(body, &directions).last().copied().unwrap_or(1.0)
}

/// The size of changes of a shape at which terms of its equations balance, if that is far smaller than the shape: of each equation the
/// median, and the least of these. `None` where the size of the shape itself is the scale of its changes, as with rotations about
/// the shape 0.
///
/// Where nothing says that the shape 0 is a particular one, the size of a shape is that of an offset, or of a part that does not act on the
/// others: distances are not small because they are small against it.
pub fn vicinity(bodies: &[&dyn Equivariant], shape: &[f64]) -> Option<f64> {
    let first = bodies.first().filter(|body| !body.symmetry().rotations && norm(shape) > 0.0)?;
    let mut sizes = vec![Vec::new(); first.dim()];
    for body in bodies {
        let noise: Vec<f64> = round_off(*body, shape, 0.0).iter().map(|error| CLEAR * error).collect();
        for ray in diagonals(body.dim()) {
            let found = beside(*body, shape, &noise, &ray, norm(shape), NONLINEAR);
            sizes.iter_mut().zip(found).for_each(|(all, found)| all.extend(found));
        }
    }
    let median = |all: &mut Vec<f64>| {
        ascending(all);
        all.get(all.len() / 2).copied()
    };
    let least = sizes.iter_mut().filter_map(median).fold(f64::INFINITY, f64::min);
    (FAR * least < norm(shape)).then_some(least)
}

/// The size that distances from a shape are small against.
pub fn size_beside(body: &dyn Equivariant, shape: &[f64]) -> f64 {
    vicinity(&[body], shape).unwrap_or_else(|| norm(shape))
}

/// The power of 1000 closest to a number; 1 for what is none.
pub fn prefix(x: f64) -> f64 {
    if x > 0.0 && x.is_finite() { libm::pow(1000.0, (libm::log10(x) / 3.0).round()) } else { 1.0 }
}

/// Directions of length 1 in general position. Without rotations and mirror the number of a mode is a name: all have the same size.
fn rays(body: &dyn Equivariant, count: usize) -> Vec<Vec<f64>> {
    let (dim, symmetry) = (body.dim(), body.symmetry());
    let (mut unit, mut spin) = (vec![0.0; dim], vec![0.0; dim]);
    let mut number = |i: usize| {
        unit[i] = 1.0;
        body.spin(&unit, &mut spin);
        unit[i] = 0.0;
        if symmetry.rotations || symmetry.mirror { 1.0 + norm(&spin) } else { 1.0 }
    };
    let numbers: Vec<f64> = (0..dim).map(&mut number).collect();
    let part = |i: usize, ray: usize| {
        libm::cos((1.0 + (i + ray * dim) as f64) * 2.4) / (numbers[i] * numbers[i] * numbers[i]) // no two of these parts are alike
    };
    let ray = |ray: usize| {
        let mut direction: Vec<f64> = (0..dim).map(|i| part(i, ray)).collect();
        let length = norm(&direction);
        direction.iter_mut().for_each(|x| *x /= length);
        direction
    };
    (0..count).map(ray).collect()
}

/// Directions in general position in which all entries change by about the same.
fn diagonals(dim: usize) -> Vec<Vec<f64>> {
    let entry = |place: usize| {
        let part = libm::cos((1.0 + place as f64) * 2.4);
        part.signum() * (1.0 + 0.2 * part)
    };
    (0..RAYS).map(|ray| (0..dim).map(|i| entry(i + ray * dim)).collect()).collect()
}

/// The largest rate of some fields at changes of the size `length` from a shape.
fn fastest(bodies: &[&dyn Equivariant], shape: &[f64], length: f64) -> f64 {
    let of = |body: &&dyn Equivariant| {
        rays(*body, RAYS).iter().map(|ray| rate(*body, shape, ray, length)).fold(0.0, f64::max)
    };
    bodies.iter().map(of).fold(0.0, f64::max)
}

/// `sum_i |f_i w_i| / sum_i t w_i^2` at `u + t w`.
fn rate(body: &dyn Equivariant, shape: &[f64], ray: &[f64], t: f64) -> f64 {
    let shape: Vec<f64> = shape.iter().zip(ray).map(|(u, w)| u + t * w).collect();
    let rate = body.rates(&shape);
    rate.iter().zip(ray).map(|(f, w)| (f * w).abs()).sum::<f64>() / t
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_closest_power_of_1000() {
        for (x, expected) in
            [(1.0, 1.0), (31.0, 1.0), (32.0, 1e3), (0.04, 1.0), (0.03, 1e-3), (1e6, 1e6), (0.0, 1.0)]
        {
            assert_eq!(prefix(x), expected, "{x}");
        }
    }
}
