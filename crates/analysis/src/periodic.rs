//! Relative periodic orbits: shapes that come back turned (and mirrored), after a period.

use crate::equilibrium::neutral_direction;
use crate::linear::{add, basis, dot, eigenvalues, least_squares, norm, orthonormalise};
use crate::lyapunov::SplitMix;
use crate::multiple_shooting::refine;
use crate::symmetry::wrap;
use motiform_dynamics::drive::drive;
use motiform_dynamics::steppers::Method;
use motiform_dynamics::{Equivariant, Request, StepControl, System, Tangent, VectorField, Watch};
use serde::{Deserialize, Serialize};

/// A solution of `Phi_T(u) = R(angle) [M] u`: after the time T the shape is its own image.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PeriodicOrbit {
    /// A shape on the orbit.
    pub shape: Vec<f64>,
    /// The time T (model time).
    pub time: f64,
    /// The rotation (rad, in -pi..pi), after the mirror.
    pub angle: f64,
    /// Whether the image is a mirror image. Twice the time then brings the body back without any net rotation.
    pub mirrored: bool,
    /// `|Phi_T(u) - R [M] u|`, what Newton's method left.
    pub residual: f64,
    /// Floquet multipliers over T, largest modulus first, the neutral ones (time, rotations) removed: all of them for
    /// small systems, the leading ones for large ones.
    pub multipliers: Vec<(f64, f64)>,
}

/// Where Newton's method starts.
#[derive(Clone, Copy, Debug)]
pub struct PeriodicGuess<'s> {
    /// A shape near the orbit.
    pub shape: &'s [f64],
    /// The time after which it nearly returns.
    pub time: f64,
    /// The rotation between the two.
    pub angle: f64,
    /// Whether it returns mirrored.
    pub mirrored: bool,
}

/// Steps that Newton's method may take.
const STEPS: usize = 12;

/// Directions that are followed exactly; the others contract within a period and are iterated.
const DIRECTIONS: usize = 5;

/// Systems up to this size are followed in all directions.
const SMALL: usize = 8;

/// Where a small deviation grows by more than this on the way, several short shots are asked ([`refine`]).
const SENSITIVE: f64 = 1e4;

/// Method and tolerance of the flow over a period.
#[derive(Clone, Copy, Debug)]
pub struct Flow {
    /// Stepper.
    pub method: Method,
    /// Its control.
    pub control: StepControl,
    /// Most steps over one period.
    pub max_steps: u64,
}

impl PeriodicOrbit {
    /// Newton's method on `(u, T, angle)`; `None` where it does not converge to an orbit near the guess, or `stop` ends it.
    ///
    /// Newton in the span of the leading tangent vectors (all of them in small systems), fixed-point iteration in the
    /// rest, which contracts strongly: the Newton-Picard method. Each step is the smallest one, so that it moves neither
    /// along the orbit nor along the group. A small system whose orbit amplifies deviations by more than 1e4 on the way is solved by
    /// multiple shooting from there.
    ///
    /// Source: Lust, Roose, Spence, Champneys (1998), SIAM J. Sci. Comput. 19, 1188.
    ///
    /// # Checked by  tests/periodic.rs: van der Pol's period, Hopf's multiplier (both exact), the tensor model's zigzag
    #[must_use]
    pub fn find<B: Equivariant + ?Sized>(
        body: &B,
        guess: &PeriodicGuess<'_>,
        flow: &Flow,
        watch: &dyn Watch,
    ) -> Option<Self> {
        let mut state = Newton::new(body, guess);
        let size = norm(guess.shape);
        let tolerance = match flow.control {
            StepControl::Adaptive { rtol, .. } => 30.0 * rtol,
            StepControl::Fixed { .. } => 1e-6,
        };
        let mut first = f64::INFINITY;
        for step in 0..STEPS {
            let image = state.image(flow, watch)?;
            let residual = norm(&image.rest);
            if step == 0 {
                first = residual;
            }
            let mut moved = state.shape.clone();
            add(&mut moved, -1.0, guess.shape);
            let near = norm(&moved) < 0.3 * size && (state.time / guess.time - 1.0).abs() < 0.2;
            if !residual.is_finite() || !near {
                return None;
            }
            if step > 0 && residual <= tolerance * size {
                let found = state.describe(&image, residual)?;
                return if state.is_small() && image.amplification() > SENSITIVE {
                    refine(body, &found, flow, tolerance, watch)
                } else {
                    Some(found)
                };
            }
            // Where Newton's method works at all it gains a factor per step.
            if step >= 2 && residual > 0.5 * first || step >= 5 && residual > 0.05 * first {
                return None;
            }
            state.step(&image)?;
        }
        None
    }

    /// Period of the reduced motion: the time after which the body is back without a mirror.
    #[must_use]
    pub fn period(&self) -> f64 {
        if self.mirrored { 2.0 * self.time } else { self.time }
    }

    /// Net rotation per period (rad, in -pi..pi): exactly 0 where the orbit is its own mirror image.
    #[must_use]
    pub fn net_rotation(&self) -> f64 {
        if self.mirrored { 0.0 } else { self.angle }
    }

    /// The largest modulus of a multiplier: below 1 if stable.
    #[must_use]
    pub fn growth(&self) -> f64 {
        self.multipliers.first().map_or(0.0, |m| libm::hypot(m.0, m.1))
    }

    /// Floquet exponents `ln |multiplier| / T`, largest first.
    #[must_use]
    pub fn exponents(&self) -> Vec<f64> {
        self.multipliers.iter().map(|m| libm::log(libm::hypot(m.0, m.1)) / self.time).collect()
    }
}

/// The inverse of the symmetry `R(angle) [M]`: `M R(-angle)`.
pub(crate) fn back<B: Equivariant + ?Sized>(body: &B, angle: f64, mirrored: bool, x: &mut [f64]) {
    body.rotate(-angle, x);
    if mirrored {
        body.mirror(x);
    }
}

/// The eigenvalues of a reduced map, largest modulus first.
pub(crate) fn multipliers(columns: &[Vec<f64>]) -> Option<Vec<(f64, f64)>> {
    let mut values = eigenvalues(columns)?;
    values.sort_by(|a, b| libm::hypot(b.0, b.1).total_cmp(&libm::hypot(a.0, a.1)));
    Some(values)
}

/// The state of Newton's method.
struct Newton<'b, B: ?Sized> {
    body: &'b B,
    shape: Vec<f64>,
    time: f64,
    angle: f64,
    mirrored: bool,
    /// Orthonormal tangent vectors.
    directions: Vec<Vec<f64>>,
}

/// What the flow over T gives, brought back by the inverse of the symmetry.
struct Image {
    /// `P(u) - u`.
    rest: Vec<f64>,
    /// `DP` applied to the directions.
    directions: Vec<Vec<f64>>,
    /// `dP/dT`.
    by_time: Vec<f64>,
    /// `dP/d(angle)`.
    by_angle: Vec<f64>,
}

impl Image {
    /// By how much the longest direction has grown.
    fn amplification(&self) -> f64 {
        self.directions.iter().map(|direction| norm(direction)).fold(0.0, f64::max)
    }
}

impl<'b, B: Equivariant + ?Sized> Newton<'b, B> {
    fn new(body: &'b B, guess: &PeriodicGuess<'_>) -> Self {
        let dim = guess.shape.len();
        let count = if dim <= SMALL { dim } else { DIRECTIONS };
        let mut random = SplitMix(2);
        let mut directions: Vec<Vec<f64>> =
            (0..count).map(|_| (0..dim).map(|_| random.next()).collect()).collect();
        // The neutral directions are among the leading ones from the start.
        VectorField::<f64>::eval(body, 0.0, guess.shape, &mut directions[0]);
        if body.is_symmetric() && count > 1 {
            body.spin(guess.shape, &mut directions[1]);
        }
        let mut newton = Self {
            body,
            shape: guess.shape.to_vec(),
            time: guess.time,
            angle: guess.angle,
            mirrored: guess.mirrored,
            directions,
        };
        newton.orthonormalise();
        newton
    }

    fn orthonormalise(&mut self) {
        orthonormalise(&mut self.directions.iter_mut().map(Vec::as_mut_slice).collect::<Vec<_>>());
    }

    fn back(&self, x: &mut [f64]) {
        back(self.body, self.angle, self.mirrored, x);
    }

    /// Whether it is followed in all directions.
    fn is_small(&self) -> bool {
        self.directions.len() == self.shape.len()
    }

    fn image(&self, flow: &Flow, watch: &dyn Watch) -> Option<Image> {
        let dim = self.shape.len();
        let tangent = Tangent::new(self.body, self.directions.len());
        let start: Vec<f64> = self.shape.iter().chain(self.directions.iter().flatten()).copied().collect();
        let mut orbit = flow.method.shape_orbit(&tangent, flow.control, 0.0, &start).ok()?;
        let request = Request {
            max_steps: flow.max_steps,
            watched: dim,
            watch,
            ..Request::until(self.time, tangent.dim())
        };
        let outcome = drive(orbit.as_mut(), &request, &mut ()).ok()?;
        if !outcome.is_complete() {
            return None;
        }
        let (end, vectors) = orbit.state().split_at(dim);
        let mut by_time = end.to_vec();
        VectorField::<f64>::eval(self.body, 0.0, end, &mut by_time);
        let mut by_angle = end.to_vec();
        self.body.spin(end, &mut by_angle);
        by_angle.iter_mut().for_each(|x| *x = -*x);
        let mut rest = end.to_vec();
        let mut directions: Vec<Vec<f64>> = vectors.chunks_exact(dim).map(<[f64]>::to_vec).collect();
        for x in [&mut rest, &mut by_time, &mut by_angle].into_iter().chain(&mut directions) {
            self.back(x);
        }
        add(&mut rest, -1.0, &self.shape);
        Some(Image { rest, directions, by_time, by_angle })
    }

    /// One Newton-Picard step.
    fn step(&mut self, image: &Image) -> Option<()> {
        let inside = |x: &[f64]| self.directions.iter().map(|q| dot(q, x)).collect::<Vec<f64>>();
        let mut columns: Vec<Vec<f64>> = Vec::new();
        for (k, direction) in image.directions.iter().enumerate() {
            let mut column = inside(direction);
            column[k] -= 1.0;
            columns.push(column);
        }
        columns.push(inside(&image.by_time));
        columns.push(inside(&image.by_angle));
        let along = inside(&image.rest);
        let target: Vec<f64> = along.iter().map(|x| -x).collect();
        let solution = least_squares(&columns, &target)?;
        let mut outside = image.rest.clone();
        for (q, r) in self.directions.iter().zip(&along) {
            add(&mut outside, -r, q);
        }
        let count = self.directions.len();
        for (q, y) in self.directions.iter().zip(&solution) {
            add(&mut self.shape, *y, q);
        }
        add(&mut self.shape, 1.0, &outside);
        self.time += solution[count];
        self.angle += solution[count + 1];
        if !self.is_small() {
            self.directions.clone_from(&image.directions);
            self.orthonormalise();
        }
        (self.time > 0.0).then_some(())
    }

    fn describe(&self, image: &Image, residual: f64) -> Option<PeriodicOrbit> {
        let mut flow = self.shape.clone();
        VectorField::<f64>::eval(self.body, 0.0, &self.shape, &mut flow);
        let mut fixed: Vec<Vec<f64>> = neutral_direction(self.body, &self.shape);
        fixed.push(flow);
        // Neutral directions first: the rest of the span is what remains of the others.
        let columns: Vec<&[f64]> = fixed.iter().chain(&self.directions).map(Vec::as_slice).collect();
        let neutral = basis(&columns[..fixed.len()], 1e-8).len();
        let all = basis(&columns, 1e-5);
        let free = &all[neutral..];
        let act = |x: &[f64]| {
            let mut out = vec![0.0; x.len()];
            for (q, w) in self.directions.iter().zip(&image.directions) {
                add(&mut out, dot(q, x), w);
            }
            out
        };
        let multipliers = multipliers(&crate::linear::restrict(free, act))?;
        Some(PeriodicOrbit {
            shape: self.shape.clone(),
            time: self.time,
            angle: wrap(self.angle),
            mirrored: self.mirrored,
            residual,
            multipliers,
        })
    }
}
