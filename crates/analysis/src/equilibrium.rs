//! Relative equilibria: shapes that do not change but for a steady rotation.

use crate::isotropy::Isotropy;
use crate::linear::{add, apply, basis, complement, dot, eigenvalues, least_squares, norm, restrict};
use crate::symmetry::{align, turning_of_shape};
use motiform_dynamics::tangent::jacobian;
use motiform_dynamics::{Equivariant, VectorField, model};
use serde::{Deserialize, Serialize};

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
    /// How many neutral directions were removed (0 for a circle, which no rotation changes).
    pub neutral: usize,
    /// Size of the linearisation's entries: what its eigenvalues are small against.
    pub scale: f64,
}

/// Steps that Newton's method may take.
const STEPS: usize = 30;

impl RelativeEquilibrium {
    /// Newton's method from `guess`; `None` where it does not converge.
    ///
    /// Each step solves `(Df - omega G) du - Gu domega = -(f - omega Gu)` for the smallest `(du, domega)`: there is one
    /// solution per direction along the group orbit, and the smallest step does not move along it. Works for circles,
    /// pure modes and bodies at rest alike.
    ///
    /// # Checked by  tests/all/equilibrium.rs: the analytic states of the reduced model, eigenvalues against its formulas
    #[must_use]
    pub fn find<B: Equivariant + ?Sized>(body: &B, guess: &[f64]) -> Option<Self> {
        let mut shape = guess.to_vec();
        let mut rate = vec![0.0; shape.len()];
        let mut spin = rate.clone();
        VectorField::<f64>::eval(body, 0.0, &shape, &mut rate);
        let mut omega = turning_of_shape(body, &shape, &rate);
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            VectorField::<f64>::eval(body, 0.0, &shape, &mut rate);
            body.spin(&shape, &mut spin);
            let mut residual = rate.clone();
            add(&mut residual, -omega, &spin);
            let size = norm(&residual);
            let columns = linearisation(body, &shape, omega);
            let scale = columns.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
            // against the guess too: towards a circle the shape shrinks with its residual
            let floor = 1e-14 * scale * norm(&shape).max(norm(guess));
            if !size.is_finite() {
                return None;
            }
            let still = size >= 0.5 * last && size <= 1e-9 * scale * norm(&shape).max(1e-12);
            if size <= floor || still {
                return Self::describe(body, shape, omega, size);
            }
            last = size;
            let mut unknowns = columns;
            unknowns.push(spin.iter().map(|g| -g).collect());
            let target: Vec<f64> = residual.iter().map(|x| -x).collect();
            let step = least_squares(&unknowns, &target)?;
            let turned = step.len() - 1;
            add(&mut shape, 1.0, &step[..turned]);
            omega += step[turned];
        }
        None
    }

    fn describe<B: Equivariant + ?Sized>(
        body: &B,
        shape: Vec<f64>,
        omega: f64,
        residual: f64,
    ) -> Option<Self> {
        let columns = linearisation(body, &shape, omega);
        let scale = columns.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
        let matrix: Vec<f64> = columns.into_iter().flatten().collect();
        let neutral = neutral_direction(body, &shape);
        let rest = complement(&neutral, shape.len());
        let eigenvalues = eigenvalues(&restrict(&rest, |x| apply(&matrix, x)))?;
        let velocity = model::velocity(body, &shape);
        let neutral = neutral.len();
        let turning_rate = if neutral == 0 { 0.0 } else { omega }; // a circle does not turn
        Some(Self { shape, turning_rate, velocity, residual, eigenvalues, neutral, scale })
    }

    /// The largest real part of an eigenvalue: negative if stable. `-inf` without any eigenvalue.
    #[must_use]
    pub fn growth(&self) -> f64 {
        self.eigenvalues.first().map_or(f64::NEG_INFINITY, |value| value.0)
    }

    /// Real parts closer to zero than this are round-off.
    #[must_use]
    pub fn resolution(&self) -> f64 {
        1e-11 * self.scale
    }

    /// Speed of the centre of mass.
    #[must_use]
    pub fn speed(&self) -> f64 {
        libm::hypot(self.velocity[0], self.velocity[1])
    }

    /// Distance of `shape` from it, rotations divided out.
    #[must_use]
    pub fn distance<B: Equivariant + ?Sized>(&self, body: &B, shape: &[f64]) -> f64 {
        align(body, shape, &self.shape, false).distance
    }

    /// The rates that decide about a cycle through this saddle: the fastest growth `lambda_+` and the leading rate
    /// `lambda_-` of the directions along which orbits arrive.
    ///
    /// Directions that keep all of the shape's own symmetry (a larger or smaller body of the same kind) carry no orbit
    /// from saddle to saddle and do not count. Where the shape has a mirror axis, orbits leave in one class (even or
    /// odd) and arrive in the other; `lambda_-` is then the leading rate of that other class. `None` unless exactly one
    /// direction grows, or one complex pair (the departure oscillates).
    ///
    /// Source: Krupa, Melbourne (1995), Ergod. Theory Dyn. Syst. 15, 121; for 1:2 modes Armbruster, Guckenheimer, Holmes
    /// (1988), Physica D 29, 257.
    #[must_use]
    pub fn saddle<B: Equivariant + ?Sized>(&self, body: &B) -> Option<Saddle> {
        let growing = self.eigenvalues.iter().filter(|value| value.0 > self.resolution()).count();
        let pair = growing == 2 && self.eigenvalues[0].1 != 0.0;
        if growing != 1 && !pair {
            return None;
        }
        let matrix: Vec<f64> = linearisation(body, &self.shape, self.turning_rate).concat();
        let classes = self.classes(body);
        let leading = |class: &[Vec<f64>]| {
            let values = eigenvalues(&restrict(class, |x| apply(&matrix, x)))?;
            values.first().map(|value| value.0)
        };
        let mut rates: Vec<f64> = classes.iter().filter_map(|class| leading(class)).collect();
        rates.sort_by(|a, b| b.total_cmp(a));
        match rates[..] {
            [out, inward, ..] if out > 0.0 && inward < 0.0 => Some(Saddle { out, inward }),
            [out] if out > 0.0 => {
                let inward = self.eigenvalues.get(growing)?.0;
                (inward < 0.0).then_some(Saddle { out, inward })
            }
            _ => None,
        }
    }

    /// Bases of the directions that break the shape's rotations, split into mirror-even and mirror-odd ones where it has
    /// a mirror axis.
    fn classes<B: Equivariant + ?Sized>(&self, body: &B) -> Vec<Vec<Vec<f64>>> {
        let dim = self.shape.len();
        let neutral = neutral_direction(body, &self.shape);
        let isotropy = Isotropy::of(body, &self.shape, 1e-6);
        let folds = isotropy.folds;
        let mean = |x: &[f64]| {
            let mut sum = vec![0.0; dim];
            for k in 0..folds {
                let mut turned = x.to_vec();
                body.rotate(std::f64::consts::TAU * k as f64 / folds as f64, &mut turned);
                add(&mut sum, 1.0 / folds as f64, &turned);
            }
            sum
        };
        let breaking = |x: &[f64]| {
            let mut out = x.to_vec();
            if folds > 1 {
                add(&mut out, -1.0, &mean(x));
            }
            for direction in &neutral {
                let along = dot(direction, &out);
                add(&mut out, -along, direction);
            }
            out
        };
        let all = complement(&[], dim);
        let span = |part: &dyn Fn(&[f64]) -> Vec<f64>| {
            let images: Vec<Vec<f64>> = all.iter().map(|x| part(x)).filter(|x| norm(x) > 1e-6).collect();
            basis(&images.iter().map(Vec::as_slice).collect::<Vec<_>>(), 1e-6)
        };
        let Some(axis) = isotropy.mirror else { return vec![span(&breaking)] };
        let reflect = |x: &[f64]| {
            let mut out = x.to_vec();
            body.mirror(&mut out);
            body.rotate(axis, &mut out);
            out
        };
        let half = |sign: f64| {
            move |x: &[f64]| {
                let mut out = breaking(x);
                let mirrored = reflect(&out);
                out.iter_mut().for_each(|x| *x *= 0.5);
                add(&mut out, 0.5 * sign, &mirrored);
                out
            }
        };
        vec![span(&half(1.0)), span(&half(-1.0))]
    }
}

/// Rates at a saddle of a cycle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Saddle {
    /// `lambda_+`: how fast orbits leave.
    pub out: f64,
    /// `lambda_-` (negative): how fast they arrive.
    pub inward: f64,
}

/// The columns of `Df - omega G`.
fn linearisation<B: Equivariant + ?Sized>(body: &B, shape: &[f64], omega: f64) -> Vec<Vec<f64>> {
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
pub fn neutral_direction<B: Equivariant + ?Sized>(body: &B, shape: &[f64]) -> Vec<Vec<f64>> {
    let mut spin = vec![0.0; shape.len()];
    body.spin(shape, &mut spin);
    let size = norm(&spin);
    if size <= 1e-10 || size <= 1e-12 * norm(shape) {
        return Vec::new();
    }
    spin.iter_mut().for_each(|x| *x /= size);
    vec![spin]
}
