//! Deflation: Newton's method that does not come back to what is known.

use super::newton::equations;
use super::uncertainty::residual;
use super::{RelativeEquilibrium, Units, linearisation, matrix_of, neutral_direction, size_beside};
use crate::graded::EPS;
use crate::linear::{add, dot, least_squares, norm, solve};
use crate::singular::svd;
use crate::symmetry::{Copies, turning_of_shape};
use motiform_dynamics::tangent::jacobian;
use motiform_dynamics::{Equivariant, VectorField};
use nalgebra::{DMatrix, DVector};

/// Steps that the deflated method may take.
const STEPS: usize = 60;

/// A step this small against the distance from the nearest known equilibrium leads to another one: Newton's method itself does the rest.
const CLOSE: f64 = 1e-2;

/// The distance from the known equilibria, in errors, beyond which an equilibrium is a new one: errors are
/// bounds to first order.
const APART: f64 = 100.0;

/// Equations are solved by elimination unless they are this near to singular ones.
const SINGULAR: f64 = 1e-10;

/// Equilibria nearer to each other than this, relative to their size, are one. If eigenvalues vanish, Newton's method gives few digits.
const SAME: f64 = 1e-6;

/// Least size that differences count against, in the unit of the equations.
const LEAST: f64 = 1e-3;

/// Two solutions nearer than this, relative to their size, are one if what lies between them is a solution, too: a root of higher order
/// (where branches meet), whose neighbourhood solves the equations to Newton's accuracy.
const FLAT: f64 = 1e-2;

/// Singular values below this part of the largest one belong to directions along which the equations are flat.
const NULL: f64 = 1e-4;

/// Residual between two such solutions along these directions, in units of the larger one of theirs.
const BETWEEN: f64 = 2.0;

/// Step of differences, in units of the size of the shape, and how well they must agree with derivatives.
const DIFFERENCE: f64 = 1e-4;
const RESOLVED: f64 = 0.01;

/// Equilibria that are known, for a search of others.
///
/// The deflated method solves `M(u) (f(u) - omega Gu) = 0`, `M = prod_i (L/|u - u_i| + 1)`: a known root `u_i` is none of these
/// equations, because M grows as fast as the residual falls. The distance from `u_i` is that from the nearest of its rotated
/// copies. As only a scalar is new, the step is Newton's step d times `1/(1 - d . grad ln M)`.
///
/// Equilibria that their linearisation does not determine (one of a family) are not deflated, since the next
/// one is beside them, and none of them is found.
///
/// Source: Farrell, Birkisson, Funke (2015), SIAM J. Sci. Comput. 37, A2026: power 1, shift 1; the scalar is
/// from the formula of Sherman and Morrison. In random equations of 4 to 6 unknowns power 2 takes half as
/// many starts more: it drives away from the other roots near a known one.
///
/// # Checked by  tests/all/deflation.rs: all roots of known fields, rotated copies, families; lab's tests/all/equilibria/: other searches
#[derive(Clone, Debug)]
pub struct Deflation {
    known: Vec<Known>,
    /// The unit of the equations' shapes.
    unit: f64,
}

/// A known equilibrium.
#[derive(Clone, Debug)]
struct Known {
    copies: Copies,
    /// Bound on its distance from the true one.
    error: f64,
    /// See [`RelativeEquilibrium`].
    turning_rate: f64,
    /// `true` if it is isolated: no member of a family of equilibria.
    isolated: bool,
}

impl Deflation {
    /// Without any known equilibrium.
    pub fn of(body: &dyn Equivariant) -> Self {
        Self { known: Vec::new(), unit: Units::of(body).length }
    }

    /// Returns `true` if two equilibria are one, up to rotations.
    pub fn is_same(
        &self,
        body: &dyn Equivariant,
        one: &RelativeEquilibrium,
        other: &RelativeEquilibrium,
    ) -> bool {
        one.is_same(body, other, self.unit)
    }

    /// Returns `true` if a solution is nearer to a root of higher order than a known one of the same root.
    pub fn is_better(
        &self,
        body: &dyn Equivariant,
        new: &RelativeEquilibrium,
        known: &RelativeEquilibrium,
    ) -> bool {
        new.residual < known.residual
            && !near(body, new.distance(body, &known.shape), &known.shape, self.unit)
    }

    /// Adds an equilibrium to the known ones.
    pub fn add(&mut self, body: &dyn Equivariant, known: &RelativeEquilibrium) {
        let error = norm(&known.uncertainty(body).shape);
        let copies = Copies::of(body, &known.shape);
        let isolated = known.is_isolated(error, self.unit);
        self.known.push(Known { copies, error, turning_rate: known.turning_rate, isolated });
    }

    /// An equilibrium that is none of the known ones, by the deflated method from `guess` with `L = reach`; `None` where that does not
    /// converge.
    ///
    /// A step is limited to the size of the shape, or to the reach where that is larger. Where steps become small against the
    /// distance from the known ones, [`RelativeEquilibrium::find`] completes the result.
    pub fn find(&self, body: &dyn Equivariant, guess: &[f64], reach: f64) -> Option<RelativeEquilibrium> {
        let mut shape = guess.to_vec();
        let rate = body.rates(&shape);
        let mut omega = turning_of_shape(body, &shape, &rate);
        let turning = Units::of_shape(body, guess).turning();
        for _ in 0..STEPS {
            let step = step(body, &shape, omega, turning)?;
            let (turned, step) = step.split_last()?;
            let length = norm(step);
            let (pull, nearest) = self.pull(body, &shape, step, reach);
            if length <= CLOSE * nearest {
                return RelativeEquilibrium::find(body, &shape).filter(|found| self.lacks(body, found));
            }
            let most = norm(&shape).max(reach) / length;
            let part = (1.0 / (1.0 - pull)).clamp(-most, most);
            add(&mut shape, part, step);
            omega += part * turning * turned;
        }
        None
    }

    /// `d . grad ln M` for the step d, and the distance from the nearest equilibrium that is deflated.
    ///
    /// `grad ln (L/D + 1) = -1/(1 + D/L) (u - u_i)/D^2`, `u_i` the nearest of its rotated copies.
    fn pull(&self, body: &dyn Equivariant, shape: &[f64], step: &[f64], reach: f64) -> (f64, f64) {
        let (mut sum, mut nearest) = (0.0, f64::INFINITY);
        for known in self.known.iter().filter(|known| known.isolated) {
            let mut away = known.copies.nearest(body, shape);
            away.iter_mut().zip(shape).for_each(|(x, u)| *x = u - *x);
            let square = dot(&away, &away).max(f64::MIN_POSITIVE);
            let distance = square.sqrt();
            sum -= dot(&away, step) / square / (1.0 + distance / reach);
            nearest = distance.min(nearest);
        }
        (sum, nearest.min(norm(shape).max(reach)))
    }

    /// Returns `true` if it is determined by its linearisation and none of the known ones, beyond its error
    /// and theirs.
    fn lacks(&self, body: &dyn Equivariant, found: &RelativeEquilibrium) -> bool {
        let error = norm(&found.uncertainty(body).shape);
        let apart = |known: &Known| {
            let errors = error + if known.isolated { known.error } else { 0.0 };
            let distance = found.distance(body, known.copies.shape());
            distance > APART * errors
                && !near(body, distance, known.copies.shape(), self.unit)
                && !is_flat(body, found, &known.copies, known.turning_rate, self.unit)
        };
        found.is_isolated(error, self.unit) && self.known.iter().all(apart) && is_resolved(body, &found.shape)
    }
}

/// Returns `true` if differences of the field's values confirm its derivatives, to the part [`RESOLVED`] of
/// the largest one of each equation.
///
/// Far away, terms that cancel exactly (those of `(z + conj z)^3` for an imaginary z) leave derivatives that
/// are rounding alone: any shape then seems to solve the equations, as the residual is small against them.
fn is_resolved(body: &dyn Equivariant, shape: &[f64]) -> bool {
    let (dim, step) = (shape.len(), DIFFERENCE * norm(shape));
    if step == 0.0 {
        return true;
    }
    let matrix = jacobian(body, shape);
    let largest = |i: usize| (0..dim).fold(0.0, |most: f64, j| most.max(matrix[j * dim + i].abs()));
    let rate = |j: usize, step: f64| {
        let (mut beside, mut rate) = (shape.to_vec(), vec![0.0; dim]);
        beside[j] += step;
        VectorField::<f64>::eval(body, 0.0, &beside, &mut rate);
        rate
    };
    (0..dim).all(|j| {
        let (above, below) = (rate(j, step), rate(j, -step));
        let off = |i: usize| ((above[i] - below[i]) / (2.0 * step) - matrix[j * dim + i]).abs();
        (0..dim).all(|i| off(i) <= RESOLVED * largest(i))
    })
}

/// Newton's step `(du, domega)`, with du across the group orbit and domega in units of `turning`; the smallest step where that is not
/// determined.
fn step(body: &dyn Equivariant, shape: &[f64], omega: f64, turning: f64) -> Option<Vec<f64>> {
    let (unknowns, target) = equations(body, shape, omega, turning);
    let (mut square, mut rhs) = (unknowns.clone(), target.clone());
    match neutral_direction(body, shape).pop() {
        Some(neutral) => {
            rhs.push(0.0);
            square.iter_mut().zip(neutral.iter().chain(&[0.0])).for_each(|(column, x)| column.push(*x));
        }
        None => square.truncate(shape.len()),
    }
    let Some(mut step) = solve(&square, &rhs, SINGULAR) else { return least_squares(&unknowns, &target) };
    step.resize(unknowns.len(), 0.0);
    Some(step)
}

impl RelativeEquilibrium {
    /// Returns `true` if it is isolated, as its linearisation shows: no eigenvalue is zero within its error.
    fn is_isolated(&self, error: f64, unit: f64) -> bool {
        let rates = self.eigenvalues.iter().zip(&self.errors);
        let mut leading = rates.take_while(|(value, error)| value.0 >= -APART * **error);
        APART * error < norm(&self.shape).max(LEAST * unit)
            && leading.all(|(value, error)| libm::hypot(value.0, value.1) > APART * *error)
    }

    /// Returns `true` if these are one equilibrium of equations with this unit of shapes ([`Units`]), up to
    /// rotations.
    pub fn is_same(&self, body: &dyn Equivariant, other: &Self, unit: f64) -> bool {
        near(body, self.distance(body, &other.shape), &other.shape, unit)
            || is_flat(body, self, &Copies::of(body, &other.shape), other.turning_rate, unit)
    }
}

/// Returns `true` if a solution and a known one (its copies and turning rate) are near, and what is in the middle between them solves the
/// equations as well as they do.
fn is_flat(
    body: &dyn Equivariant,
    found: &RelativeEquilibrium,
    copies: &Copies,
    turning_rate: f64,
    unit: f64,
) -> bool {
    let copy = copies.nearest(body, &found.shape);
    let apart: Vec<f64> = copy.iter().zip(&found.shape).map(|(a, b)| a - b).collect();
    let distance = norm(&apart);
    let whole = norm(&found.shape).max(LEAST * unit);
    if distance > FLAT * whole || distance > FLAT * size(body, &found.shape, unit) {
        return false;
    }
    let middle: Vec<f64> = copy.iter().zip(&found.shape).map(|(a, b)| 0.5 * (a + b)).collect();
    let omega = 0.5 * (turning_rate + found.turning_rate);
    let Some(svd) = svd(bordered(body, &middle, omega)) else { return false };
    let Some(left) = &svd.u else { return false };
    let largest = svd.singular_values.max();
    let limit = NULL * largest;
    let mut null = (0..svd.singular_values.len()).filter(|&k| svd.singular_values[k] <= limit).peekable();
    let between = DVector::from_vec(residual(body, &middle, omega));
    let theirs = |shape: &[f64], omega| norm(&residual(body, shape, omega));
    let solved = theirs(&copy, turning_rate).max(theirs(&found.shape, found.turning_rate));
    let most = BETWEEN * solved.max(EPS * largest * whole);
    // across the others a small step leads back to the solutions
    let along = |k: usize| left.column(k).rows(0, between.len()).dot(&between).abs();
    null.peek().is_some() && null.all(|k| along(k) <= most)
}

/// The linearisation, bordered by the neutral direction of rotations, with the size of its largest entry: as singular as that is in the
/// others.
fn bordered(body: &dyn Equivariant, shape: &[f64], omega: f64) -> DMatrix<f64> {
    let matrix = matrix_of(&linearisation(body, shape, omega));
    let (dim, size) = (shape.len(), matrix.amax());
    let Some(neutral) = neutral_direction(body, shape).pop() else { return matrix };
    let mut all = matrix.resize(dim + 1, dim + 1, 0.0);
    for (i, x) in neutral.iter().enumerate() {
        all[(i, dim)] = size * x;
        all[(dim, i)] = size * x;
    }
    all
}

/// Returns `true` if a shape at this distance from `shape` is the same.
fn near(body: &dyn Equivariant, distance: f64, shape: &[f64], unit: f64) -> bool {
    distance < SAME * norm(shape).max(LEAST * unit) && distance < SAME * size(body, shape, unit)
}

/// The size that differences from a shape count against.
fn size(body: &dyn Equivariant, shape: &[f64], unit: f64) -> f64 {
    size_beside(body, shape).max(LEAST * unit)
}
