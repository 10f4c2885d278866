//! Bounds on the distance between a computed relative equilibrium and the true one.

use super::{RelativeEquilibrium, linearisation, matrix_of};
use crate::graded::{EPS, spread};
use crate::linear::add;
use crate::lyapunov::SplitMix;
use motiform_dynamics::Equivariant;
use nalgebra::DMatrix;

/// Rounding of a sum of products, in units of the roundoff of its terms.
const ROUNDINGS: f64 = 2.0;

/// Changes of the shape that are tried.
const TRIES: u64 = 4;

/// Bounds, to first order, of the errors that the residual and rounding leave in a relative equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct Uncertainty {
    /// Of each entry of the shape, in the directions that are not along the group.
    pub shape: Vec<f64>,
    /// Of the turning rate (rad per model time).
    pub turning_rate: f64,
}

impl Uncertainty {
    /// Of the solution `(u, omega)` of `f(u) - omega Gu = 0`, `Gu . du = 0`: `|M^-1| (|r| + rho)` with the matrix M of these equations,
    /// their residual r and its rounding `rho_i = 2 eps sum_j |A_ij u_j|`, or what is seen of it where that is more (terms that cancel).
    ///
    /// A residual in a mode that decays fast moves nothing by much: it is divided by that mode's rate. Where
    /// M is singular the equilibrium is one of a family, and the distance is that to the nearest of them.
    pub(super) fn of(body: &dyn Equivariant, shape: &[f64], omega: f64, turns: bool) -> Self {
        let rounding = rounding_of(body, shape, omega, &linearisation(body, shape, omega));
        Self::under(body, shape, omega, turns, &rounding)
    }

    /// The same where some direction is so slow that rounding, and not the shape, may decide its rate: with the largest rounding that is
    /// seen at this shape and near it. Where two steady motions meet, the distance from theirs is up to twice what the first order says of
    /// it, and the rounding that is seen is some part of the largest.
    pub(super) fn of_slow(body: &dyn Equivariant, shape: &[f64], omega: f64, turns: bool) -> Self {
        let mut rounding = round_off(body, shape, omega);
        let scattered = scattered(body, shape, omega);
        rounding.iter_mut().zip(scattered).for_each(|(most, seen)| *most = MEETING * most.max(seen));
        Self::under(body, shape, omega, turns, &rounding)
    }

    /// The same with this rounding of the rates.
    fn under(body: &dyn Equivariant, shape: &[f64], omega: f64, turns: bool, rounding: &[f64]) -> Self {
        let dim = shape.len();
        let columns = linearisation(body, shape, omega);
        let spin = body.spun(shape);
        let mut bounds = residual(body, shape, omega);
        bounds.iter_mut().zip(rounding).for_each(|(bound, rounding)| *bound = bound.abs() + rounding);
        bounds.push(0.0);
        let entry = |i: usize, j: usize| match (i < dim, j < dim) {
            (true, true) => columns[j][i],
            (true, false) => {
                if turns {
                    -spin[i]
                } else {
                    0.0
                }
            }
            (false, true) => {
                if turns {
                    spin[j]
                } else {
                    0.0
                }
            }
            (false, false) => f64::from(u8::from(!turns)),
        };
        let matrix = DMatrix::from_fn(dim + 1, dim + 1, entry);
        match spread(matrix, &bounds) {
            Some(mut spread) => {
                let turning_rate = spread.pop().unwrap_or(f64::INFINITY);
                Self { shape: spread, turning_rate }
            }
            None => Self { shape: vec![f64::INFINITY; dim], turning_rate: f64::INFINITY },
        }
    }

    /// Bounds of the errors of `Df - omega G`: rounding against the largest entry of each row, and twice what
    /// some changes by the error of the shape make of it, with random signs: with signs of its own a change
    /// may be one along a family, which changes nothing.
    pub(super) fn of_linearisation(
        &self,
        body: &dyn Equivariant,
        shape: &[f64],
        omega: f64,
        matrix: &DMatrix<f64>,
    ) -> DMatrix<f64> {
        let mut errors = DMatrix::zeros(matrix.nrows(), matrix.ncols());
        let known = self.shape.iter().all(|x| x.is_finite());
        for seed in if known { 0..TRIES } else { 0..0 } {
            let mut random = SplitMix(200 + seed);
            let moved = shape.iter().zip(&self.shape).map(|(x, bound)| x + bound * random.next().signum());
            let moved = matrix_of(&linearisation(body, &moved.collect::<Vec<_>>(), omega));
            errors
                .zip_apply(&(moved - matrix), |error: &mut f64, moved| *error = error.max(2.0 * moved.abs()));
        }
        for (mut row, values) in errors.row_iter_mut().zip(matrix.row_iter()) {
            row.add_scalar_mut(2.0 * ROUNDINGS * EPS * values.amax());
        }
        errors
    }
}

impl RelativeEquilibrium {
    /// Bounds on its distance from the true one.
    pub fn uncertainty(&self, body: &dyn Equivariant) -> Uncertainty {
        Uncertainty::of(body, &self.shape, self.turning_rate, self.neutral > 0)
    }
}

/// The rounding error of each rate `f - omega Gu`: the largest one at a shape and at some shapes near it. (At a shape whose entries are
/// short numbers the terms may cancel exactly.)
pub fn round_off(body: &dyn Equivariant, shape: &[f64], omega: f64) -> Vec<f64> {
    let mut most = rounding_of(body, shape, omega, &linearisation(body, shape, omega));
    for moved in nearby(shape) {
        let beside = rounding_of(body, &moved, omega, &linearisation(body, &moved, omega));
        most.iter_mut().zip(beside).for_each(|(most, beside)| *most = most.max(beside));
    }
    most
}

/// Shapes near one.
fn nearby(shape: &[f64]) -> impl Iterator<Item = Vec<f64>> {
    (0..TRIES).map(|seed| {
        let mut random = SplitMix(400 + seed);
        shape.iter().map(|x| x + x * BESIDE * random.next()).collect()
    })
}

/// The rounding of each rate as its fourth differences show it: those of the rates themselves vanish as the fourth power of the distance
/// from shape to shape, relative 1e-6, and errors of single values remain. Where rates hardly change, smaller distances show nothing:
/// rounded products are the same there.
fn scattered(body: &dyn Equivariant, shape: &[f64], omega: f64) -> Vec<f64> {
    let mut most = vec![0.0_f64; shape.len()];
    for seed in 0..TRIES {
        let mut random = SplitMix(500 + seed);
        let direction: Vec<f64> = shape.iter().map(|x| x * APART * random.next()).collect();
        let mut sum = vec![0.0; shape.len()];
        for (place, weight) in (-2..).zip(FOURTH) {
            let mut there = shape.to_vec();
            add(&mut there, f64::from(place), &direction);
            add(&mut sum, weight, &residual(body, &there, omega));
        }
        most.iter_mut().zip(sum).for_each(|(most, sum)| *most = most.max(sum.abs() / HALF_SUM));
    }
    most
}

/// Factor of the rounding where two steady motions may meet.
const MEETING: f64 = 32.0;

/// Relative distance of shapes in a row.
const APART: f64 = 1e-6;

/// Weights of a fourth difference, and half the sum of their sizes.
const FOURTH: [f64; 5] = [1.0, -4.0, 6.0, -4.0, 1.0];
const HALF_SUM: f64 = 8.0;

/// Relative distance of the shapes near it.
const BESIDE: f64 = 1e-7;

/// Relative changes of a shape under which its residual changes by its derivatives, and by rounding.
const NUDGE: f64 = 8.0 * EPS;

/// Bound of the rounding of `f - omega Gu` with the derivatives `columns`: `2 eps sum_j |A_ij u_j|`, or what is seen of it where that is
/// more.
pub(super) fn rounding_of(
    body: &dyn Equivariant,
    shape: &[f64],
    omega: f64,
    columns: &[Vec<f64>],
) -> Vec<f64> {
    let spin = body.spun(shape);
    let mut bounds = seen(body, shape, omega, columns);
    for (i, bound) in bounds.iter_mut().enumerate() {
        let terms: f64 = columns.iter().zip(shape).map(|(column, u)| (column[i] * u).abs()).sum();
        *bound = bound.max(ROUNDINGS * EPS * (terms + (omega * spin[i]).abs()));
    }
    bounds
}

/// The rounding that is seen in `f - omega Gu`: by how much its changes under small changes of the shape differ from those of its
/// derivatives. Where terms cancel, as those of `(z + conj z)^3`, the derivatives do not show how large they are.
fn seen(body: &dyn Equivariant, shape: &[f64], omega: f64, columns: &[Vec<f64>]) -> Vec<f64> {
    let here = residual(body, shape, omega);
    let mut seen = vec![0.0_f64; shape.len()];
    for seed in 0..TRIES {
        let mut random = SplitMix(300 + seed);
        let moved: Vec<f64> = shape.iter().map(|x| x + x * NUDGE * random.next().signum()).collect();
        let there = residual(body, &moved, omega);
        for (i, seen) in seen.iter_mut().enumerate() {
            let change: f64 = columns
                .iter()
                .zip(&moved)
                .zip(shape)
                .map(|((column, to), from)| column[i] * (to - from))
                .sum();
            *seen = seen.max((there[i] - here[i] - change).abs());
        }
    }
    seen
}

/// `f - omega Gu`.
pub(super) fn residual(body: &dyn Equivariant, shape: &[f64], omega: f64) -> Vec<f64> {
    let (mut rate, spin) = (body.rates(shape), body.spun(shape));
    add(&mut rate, -omega, &spin);
    rate
}
