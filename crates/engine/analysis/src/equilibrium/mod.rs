//! Relative equilibria: shapes that do not change but for a steady rotation.

mod balance;
mod deflation;
mod family;
mod lost;
mod newton;
mod reached;
mod saddle;
mod silent;
mod spectrum;
mod uncertainty;
mod units;

use crate::linear::{add, basis, norm};
use crate::symmetry::align;
pub use balance::balances;
pub use deflation::Deflation;
use motiform_dynamics::tangent::jacobian;
use motiform_dynamics::{Equivariant, model};
use nalgebra::DMatrix;
pub use reached::REACHED;
pub use saddle::Saddle;
use serde::{Deserialize, Serialize};
pub use silent::modes;
pub use spectrum::rounding;
pub use uncertainty::{Uncertainty, round_off};
pub use units::{Units, balance, largest_balance, prefix, size_beside, vicinity};

/// A solution of `f(u) = omega G u`, with `G` the infinitesimal rotation: at rest or straight (`omega = 0`), or
/// circular.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RelativeEquilibrium {
    /// The shape.
    pub shape: Vec<f64>,
    /// Its turning rate omega (rad per model time).
    pub turning_rate: f64,
    /// Velocity of the centre of mass.
    pub velocity: [f64; 2],
    /// `|f - omega Gu|`, what Newton's method left.
    pub residual: f64,
    /// Eigenvalues of the reduced linearisation, largest real part first (inverse model time). The neutral direction of
    /// the rotations is removed exactly.
    pub eigenvalues: Vec<(f64, f64)>,
    /// Bound on the error of the real part of each eigenvalue, by rounding and by the error of the shape.
    /// Only as sharp as signs need: after the first eigenvalue that is clearly negative a bound of all of
    /// them.
    #[serde(default)]
    pub errors: Vec<f64>,
    /// Number of neutral directions that were removed (0 for a circle, which no rotation changes).
    pub neutral: usize,
    /// Size of the linearisation's entries: what its eigenvalues are small against.
    pub scale: f64,
}

/// A rate below this part of the linearisation's entries may be that of rounding: where two steady motions meet, Newton's method ends at
/// the square root of the rounding beside them.
const SLOW: f64 = 1e-4;

/// It is, where its error with the rounding that is seen near the shape is more than this part of it; elsewhere that error says nothing.
const DOUBTFUL: f64 = 0.1;

impl RelativeEquilibrium {
    /// The equilibrium at a solution of its equations, as far as Newton's method goes.
    fn describe(body: &dyn Equivariant, shape: Vec<f64>, omega: f64) -> Option<Self> {
        let columns = linearisation(body, &shape, omega);
        let scale = columns.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
        let neutral = neutral_direction(body, &shape);
        let turns = !neutral.is_empty();
        let omega = if turns { omega } else { 0.0 }; // a circle does not turn
        let matrix = matrix_of(&columns);
        let spectrum = |uncertainty: &Uncertainty| {
            let entries = uncertainty.of_linearisation(body, &shape, omega, &matrix);
            spectrum::across(&neutral, &matrix, &entries)
        };
        let (eigenvalues, mut errors) = spectrum(&Uncertainty::of(body, &shape, omega, turns))?;
        let slow = |rate: f64| rate.abs() < SLOW * scale;
        if eigenvalues.iter().any(|value| slow(value.0)) {
            let (_, larger) = spectrum(&Uncertainty::of_slow(body, &shape, omega, turns))?;
            for ((error, larger), (rate, _)) in errors.iter_mut().zip(larger).zip(&eigenvalues) {
                if slow(*rate) && larger > DOUBTFUL * rate.abs() {
                    *error = error.max(larger);
                }
            }
        }
        let velocity = model::velocity(body, &shape);
        let residual = norm(&uncertainty::residual(body, &shape, omega));
        let neutral = neutral.len();
        Some(Self { shape, turning_rate: omega, velocity, residual, eigenvalues, errors, neutral, scale })
    }

    /// The largest real part of an eigenvalue: negative if stable. `-inf` without any eigenvalue.
    pub fn growth(&self) -> f64 {
        self.eigenvalues.first().map_or(f64::NEG_INFINITY, |value| value.0)
    }

    /// Bound on the error of [`RelativeEquilibrium::growth`]: a growth rate closer to zero than this has no
    /// sign.
    pub fn growth_error(&self) -> f64 {
        self.errors.first().copied().unwrap_or(0.0)
    }

    /// Returns `true` if every perturbation decays, beyond the error of the growth rates.
    pub fn is_stable(&self) -> bool {
        self.growth() < -self.growth_error()
    }

    /// Number of directions that grow, beyond the error of their growth rates.
    pub fn growing(&self) -> usize {
        let clear = |(value, error): (&(f64, f64), &f64)| value.0 > *error;
        self.eigenvalues.iter().zip(&self.errors).filter(|&pair| clear(pair)).count()
    }

    /// Returns `true` if some direction grows, beyond the error of its growth rate.
    pub fn is_unstable(&self) -> bool {
        self.growing() > 0
    }

    /// Speed of the centre of mass.
    pub fn speed(&self) -> f64 {
        libm::hypot(self.velocity[0], self.velocity[1])
    }

    /// Distance of `shape` from it, rotations divided out.
    pub fn distance(&self, body: &dyn Equivariant, shape: &[f64]) -> f64 {
        align(body, shape, &self.shape, false).distance
    }
}

/// The columns of `Df - omega G`.
fn linearisation(body: &dyn Equivariant, shape: &[f64], omega: f64) -> Vec<Vec<f64>> {
    let dim = shape.len();
    let matrix = jacobian(body, shape);
    let mut unit = vec![0.0; dim];
    let mut spin = vec![0.0; dim];
    let column = |(j, column): (usize, &[f64])| {
        unit.fill(0.0);
        unit[j] = 1.0;
        body.spin(&unit, &mut spin); // the action is linear
        let mut column = column.to_vec();
        add(&mut column, -omega, &spin);
        column
    };
    matrix.chunks_exact(dim).enumerate().map(column).collect()
}

/// The direction of the group orbit, as a unit vector; none for a circle.
pub fn neutral_direction(body: &dyn Equivariant, shape: &[f64]) -> Vec<Vec<f64>> {
    let mut spin = body.spun(shape);
    let size = norm(&spin);
    if size <= 1e-12 * norm(shape) {
        return Vec::new();
    }
    spin.iter_mut().for_each(|x| *x /= size);
    vec![spin]
}

/// Unit vectors along the group and the flow at a shape: the directions in which nothing grows or decays along an orbit.
pub(crate) fn along_group_and_flow(body: &dyn Equivariant, shape: &[f64]) -> Vec<Vec<f64>> {
    let mut directions = neutral_direction(body, shape);
    let flow = body.rates(shape);
    directions.push(flow);
    basis(&directions.iter().map(Vec::as_slice).collect::<Vec<_>>(), 1e-8)
}

/// The matrix of these columns.
pub(crate) fn matrix_of(columns: &[Vec<f64>]) -> DMatrix<f64> {
    DMatrix::from_fn(columns.first().map_or(0, Vec::len), columns.len(), |i, j| columns[j][i])
}
