//! Relative periodic orbits: shapes that come back turned (and mirrored), after a period.

use crate::linear::{add, norm};
use crate::multiple_shooting::refine;
use crate::newton_picard::Newton;
use crate::symmetry::align;
use motiform_dynamics::drive::drive;
use motiform_dynamics::steppers::Method;
use motiform_dynamics::{Equivariant, Request, StepControl, Watch};
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
    /// `true` if the image is a mirror image. Twice the time then brings the body back without any net
    /// rotation.
    pub mirrored: bool,
    /// `|Phi_T(u) - R [M] u|`, what Newton's method left.
    pub residual: f64,
    /// Floquet multipliers over T, largest modulus first, the neutral ones (time, rotations) removed; the
    /// leading ones in systems of more than 16 unknowns.
    pub multipliers: Vec<(f64, f64)>,
    /// Bounds on the errors of the moduli of the multipliers, from the accuracy of the flow; in a large
    /// system also from the distance of the directions that were followed from its space. Empty where each
    /// multiplier has the accuracy of the shape, on a branch.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub errors: Vec<f64>,
}

/// The start of Newton's method.
#[derive(Clone, Copy, Debug)]
pub struct PeriodicGuess<'s> {
    /// A shape near the orbit.
    pub shape: &'s [f64],
    /// The time after which it nearly returns.
    pub time: f64,
    /// The rotation between the two.
    pub angle: f64,
    /// `true` if it returns mirrored.
    pub mirrored: bool,
}

/// Steps that Newton's method may take.
const STEPS: usize = 12;

/// Systems up to this size are looked at closely all the time: a look or a try costs little.
const SMALL: usize = 8;

/// Systems up to this size are solved in all directions by Newton's method.
const WHOLE: usize = 16;

/// Returns `true` if a system of this dimension is small.
pub(crate) const fn is_small(dim: usize) -> bool {
    dim <= SMALL
}

/// Returns `true` if Newton's method follows a system of this dimension in all directions.
pub(crate) const fn is_whole(dim: usize) -> bool {
    dim <= WHOLE
}

/// A shape whose image is farther from it than this part of its size does not return.
const NO_RETURN: f64 = 0.6;

/// The growth of deviations on the way beyond which round-off alone is far above every tolerance at the end.
const HOPELESS: f64 = 1e12;

/// The growth of a small deviation on the way beyond which several short shots are used ([`refine`]).
const SENSITIVE: f64 = 1e4;

/// Steps of a tighter relative tolerance are round-off.
const TIGHTEST: f64 = 1e-13;

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

impl Flow {
    /// The same with a tolerance that is tighter by this factor, as far as rounding allows; `None` where it cannot be tighter.
    pub(crate) fn tighter(&self, factor: f64) -> Option<Self> {
        let StepControl::Adaptive { rtol, atol } = self.control else { return None };
        let control = StepControl::Adaptive { rtol: (factor * rtol).max(TIGHTEST), atol: factor * atol };
        (rtol > 2.0 * TIGHTEST).then_some(Self { control, ..*self })
    }

    /// The same with an absolute tolerance of at least this: steps of a tighter one are round-off of the equations.
    #[must_use]
    pub fn above(self, least: f64) -> Self {
        let control = match self.control {
            StepControl::Adaptive { rtol, atol } => StepControl::Adaptive { rtol, atol: atol.max(least) },
            fixed => fixed,
        };
        Self { control, ..self }
    }

    /// The residual of an orbit that is closed, as a part of the size of its shape.
    pub(crate) fn closed(&self) -> f64 {
        match self.control {
            StepControl::Adaptive { rtol, .. } => 30.0 * rtol,
            StepControl::Fixed { .. } => 1e-6,
        }
    }

    /// The relative accuracy of states and maps over a period.
    pub fn accuracy(&self) -> f64 {
        match self.control {
            StepControl::Adaptive { rtol, .. } => 1e3 * rtol,
            StepControl::Fixed { .. } => 1e-6,
        }
    }
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
    /// # Checked by  tests/all/periodic.rs: van der Pol's period, Hopf's multiplier (both exact), the tensor model's zigzag
    pub fn find(
        body: &dyn Equivariant,
        guess: &PeriodicGuess<'_>,
        flow: &Flow,
        watch: &dyn Watch,
    ) -> Option<Self> {
        let mut effort = f64::INFINITY;
        Self::find_within(body, guess, flow, &mut effort, watch)
    }

    /// The orbit near `shape` that comes back, mirrored or not, after nearly `time`: Newton's method with the
    /// rotation that brings the shape after that time closest to itself.
    pub fn near(
        body: &dyn Equivariant,
        shape: &[f64],
        time: f64,
        mirrored: bool,
        flow: &Flow,
        watch: &dyn Watch,
    ) -> Option<Self> {
        let mut orbit = flow.method.shape_orbit(body, flow.control, 0.0, shape).ok()?;
        let request = Request { max_steps: flow.max_steps, watch, ..Request::around(time, shape) };
        drive(orbit.as_mut(), &request, &mut ()).ok()?;
        let angle = align(body, orbit.state(), shape, mirrored).angle;
        Self::find(body, &PeriodicGuess { shape, time, angle, mirrored }, flow, watch)
    }

    /// As [`PeriodicOrbit::find`], but it integrates no more than `effort` of model time, and takes what it integrated from it.
    pub(crate) fn find_within(
        body: &dyn Equivariant,
        guess: &PeriodicGuess<'_>,
        flow: &Flow,
        effort: &mut f64,
        watch: &dyn Watch,
    ) -> Option<Self> {
        let mut state = Newton::new(body, guess);
        let size = norm(guess.shape);
        let tolerance = flow.closed();
        if state.miss(flow, watch)? > NO_RETURN * size {
            return None;
        }
        let mut first = f64::INFINITY;
        let mut before = f64::INFINITY;
        for step in 0..STEPS {
            *effort -= state.time;
            if *effort < 0.0 {
                return None;
            }
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
                let sensitive = state.is_whole() && image.amplification() > SENSITIVE;
                let found = state.described(&image, residual, flow, watch)?;
                return if sensitive { refine(body, &found, flow, tolerance, watch) } else { Some(found) };
            }
            let amplification = image.amplification();
            if state.is_whole() && amplification > HOPELESS {
                return None;
            }
            if step >= 2 && amplification > SENSITIVE && residual > 0.5 * before {
                return None; // what is left is round-off
            }
            before = residual;
            // Where Newton's method works at all it gains a factor per step.
            if step >= 2 && residual > 0.5 * first || step >= 5 && residual > 0.05 * first {
                return None;
            }
            state.step(&image)?;
        }
        None
    }

    /// The time after which the shape is back without a mirror, turned by [`PeriodicOrbit::net_rotation`].
    /// (The period of a motion also depends on its form: see [`crate::regime`].)
    pub fn period(&self) -> f64 {
        if self.mirrored { 2.0 * self.time } else { self.time }
    }

    /// Net rotation per period (rad, in -pi..pi): exactly 0 where the orbit is its own mirror image.
    pub fn net_rotation(&self) -> f64 {
        if self.mirrored { 0.0 } else { self.angle }
    }

    /// The largest modulus of a multiplier: below 1 if stable.
    pub fn growth(&self) -> f64 {
        self.multipliers.first().map_or(0.0, |m| libm::hypot(m.0, m.1))
    }

    /// Returns `true` if every deviation decays, beyond the errors of the multipliers.
    pub fn is_stable(&self) -> bool {
        self.growth() < 1.0 - self.growth_error()
    }

    /// Returns `true` if some deviation grows, beyond the errors of the multipliers.
    pub fn is_unstable(&self) -> bool {
        self.growth() > 1.0 + self.growth_error()
    }

    /// Bound on the error of [`PeriodicOrbit::growth`].
    pub fn growth_error(&self) -> f64 {
        let moduli = self.multipliers.iter().map(|m| libm::hypot(m.0, m.1));
        // one that is nearly the largest may be the largest
        moduli.zip(&self.errors).map(|(size, error)| size + error).fold(0.0, f64::max) - self.growth()
    }

    /// Floquet exponents `ln |multiplier| / T`, largest first: round-off where a multiplier is below the
    /// accuracy of the matrix of a period.
    pub fn exponents(&self) -> Vec<f64> {
        self.multipliers.iter().map(|m| libm::log(libm::hypot(m.0, m.1)) / self.time).collect()
    }
}

/// The inverse of the symmetry `R(angle) [M]`: `M R(-angle)`.
pub fn back(body: &dyn Equivariant, angle: f64, mirrored: bool, x: &mut [f64]) {
    body.rotate(-angle, x);
    if mirrored {
        body.mirror(x);
    }
}
