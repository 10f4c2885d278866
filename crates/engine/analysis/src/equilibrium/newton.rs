//! Newton's method for relative equilibria.

use super::uncertainty::{residual, rounding_of};
use super::{RelativeEquilibrium, Units, linearisation};
use crate::graded::scale;
use crate::isotropy::mean_over_rotations;
use crate::linear::{add, least_squares, norm};
use crate::symmetry::turning_of_shape;
use motiform_dynamics::Equivariant;

/// A residual that no longer falls is at most so many times the rounding of its terms.
const LEFT: f64 = 1e6;

/// Steps that Newton's method may take.
const STEPS: usize = 30;

impl RelativeEquilibrium {
    /// Newton's method from `guess`; `None` where it does not converge.
    ///
    /// Each step solves `(Df - omega G) du - Gu domega = -(f - omega Gu)` for the smallest `(du, domega)`: there is one
    /// solution per direction along the group orbit, and the smallest step does not move along it. Works for circles,
    /// pure modes and bodies at rest alike. Each equation is measured against its own largest coefficient: the rates of modes differ by
    /// many powers of ten. `domega` is measured in the unit of rates over the size of the guess ([`Units`]): the smallest step is the same
    /// one in other units.
    ///
    /// # Checked by  tests/all/equilibrium.rs: the analytic states of the reduced model, eigenvalues against its formulas
    pub fn find(body: &dyn Equivariant, guess: &[f64]) -> Option<Self> {
        let mut shape = guess.to_vec();
        let rate = body.rates(&shape);
        let mut omega = turning_of_shape(body, &shape, &rate);
        let turning = Units::of_shape(body, guess).turning();
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let (unknowns, target) = equations(body, &shape, omega, turning);
            let size = norm(&target);
            if !size.is_finite() {
                return None;
            }
            // against the guess too: towards a circle the shape shrinks with its residual
            let floor = 1e-14 * norm(&shape).max(norm(guess));
            let still = size >= 0.5 * last && size <= 1e-9 * norm(&shape).max(1e-12);
            let step = least_squares(&unknowns, &target);
            // a circle has no terms to compare with
            let shrinks = norm(&shape) <= CIRCLE * norm(guess);
            if (size <= floor || still) && (size <= floor && shrinks || is_rounding(body, &shape, omega)) {
                let is_circle = step.is_some_and(|step| round(body, &mut shape, &step));
                return Self::describe(body, shape, if is_circle { 0.0 } else { omega });
            }
            last = size;
            let step = step?;
            let turned = step.len() - 1;
            add(&mut shape, 1.0, &step[..turned]);
            omega += turning * step[turned];
        }
        None
    }

    /// The length of the first step of Newton's method from a shape: about the distance of a steady motion, where one is close.
    /// `None` where there is no step.
    pub fn first_step(body: &dyn Equivariant, shape: &[f64]) -> Option<f64> {
        let omega = turning_of_shape(body, shape, &body.rates(shape));
        let (unknowns, target) = equations(body, shape, omega, Units::of_shape(body, shape).turning());
        least_squares(&unknowns, &target).map(|step| norm(&step[..shape.len()]))
    }
}

/// A shape below this part of the guess is on its way to a circle.
const CIRCLE: f64 = 1e-6;

/// Returns `true` if the residual is rounding: one that is small against the largest coefficients alone may be no solution, as along a
/// slow direction far out.
fn is_rounding(body: &dyn Equivariant, shape: &[f64], omega: f64) -> bool {
    let columns = linearisation(body, shape, omega);
    let bounds = rounding_of(body, shape, omega, &columns);
    norm(&residual(body, shape, omega)) <= LEFT * norm(&bounds)
}

/// Least part of its distance from a circle that a Newton step from a solution moves a shape which is a circle but for its error.
const ROUNDING: f64 = 0.5;

/// Makes a circle (without rotations: nothing) of a shape that differs from it by no more than Newton's method would move it still: what is
/// left of other modes is its error, which has no symmetry, but the motion has all. Whether it is one.
fn round(body: &dyn Equivariant, shape: &mut [f64], step: &[f64]) -> bool {
    let rotations = body.symmetry().rotations;
    let circle =
        if rotations { mean_over_rotations(body, shape, shape.len() + 1) } else { vec![0.0; shape.len()] };
    let mut rest = circle.clone();
    add(&mut rest, -1.0, shape);
    let is_circle = norm(&step[..shape.len()]) >= ROUNDING * norm(&rest);
    if is_circle {
        shape.copy_from_slice(&circle);
    }
    is_circle
}

/// The columns of `[Df - omega G, -turning Gu]` and `-(f - omega Gu)`, each row divided by the largest coefficient of its equation: the
/// last unknown is `domega` in units of `turning` ([`Units::turning`]).
pub(super) fn equations(
    body: &dyn Equivariant,
    shape: &[f64],
    omega: f64,
    turning: f64,
) -> (Vec<Vec<f64>>, Vec<f64>) {
    let mut columns = linearisation(body, shape, omega);
    let spin = body.spun(shape);
    let mut target = residual(body, shape, omega);
    let scales: Vec<f64> = (0..shape.len()).map(|i| scale(columns.iter().map(|column| &column[i]))).collect();
    columns.push(spin);
    let last = columns.len() - 1;
    for (i, scale) in scales.iter().enumerate() {
        columns.iter_mut().for_each(|column| column[i] *= scale);
        columns[last][i] *= -turning;
        target[i] *= -scale;
    }
    (columns, target)
}
