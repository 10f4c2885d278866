//! One orbit of a stiff semilinear field, step by step.

use crate::control::Tolerance;
use crate::interpolant::Interpolant;
use crate::model::drift;
use crate::step_sizes::StepTables;
use crate::steppers::ExponentialTableau;
use crate::steppers::exponential::{self, Stages};
use crate::stepping::{Counters, FixedGrid, StepFailure, check_start};
use crate::{Dual, Error, Semilinear, Shape, StepControl};

mod integration;
mod problem;

use problem::{DriftOf, End, Problem, Start};

/// Below this an entry of a shape is 0. What decays for long, as the modes that a symmetric motion does not
/// have, would come to the numbers below 2e-308, stay there by rounding, and make each operation take a
/// hundred times as long.
const VANISHED: f64 = 1e-290;

/// An initial-value problem `u' = Lambda u + N(t, u)` in progress, by an exponential method.
///
/// Adaptive steps have sizes `2^(k/4)`, so that the coefficients of a size are computed once:
/// [`crate::Integration::advance`] allocates only when a size occurs for the first time. Dense output is cubic Hermite.
///
/// The dynamics does not depend on the position of a body ([`ExponentialOrbit::in_plane`]), so it is not a stage of the method but a
/// quadrature: `x_new = x + h (v + v_new)/2 + h^2 (v' - v_new')/12`, order 4 like the method, for one evaluation of
/// the velocity per step instead of four. (Source: Euler-Maclaurin; Hairer, Norsett, Wanner, I, II.1.) If noise kicks stiff
/// entries the derivatives `v'` are meaningless, and the rule omits them.
///
/// If the field corrects the end of a step ([`crate::System::project`]), the next step has its first stage and its
/// first velocity at the corrected state. Inside a step dense output and position are those of the flow: at its end the
/// shape jumps, the position does not.
///
/// ```
/// use motiform_dynamics::{ExponentialOrbit, Integration, Scalar, Semilinear, StepControl, System, VectorField};
/// use motiform_dynamics::steppers::KROGSTAD4;
/// /// u' = -1000 u + 1000
/// struct Stiff;
/// impl System for Stiff { fn dim(&self) -> usize { 1 } }
/// impl<T: Scalar> VectorField<T> for Stiff {
///     fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) { du[0] = u[0].constant(1e3) - u[0] * 1e3; }
/// }
/// impl<T: Scalar> Semilinear<T> for Stiff {
///     fn linear(&self, lambda: &mut [T::Real]) { lambda[0] = lambda[0].constant(-1e3); }
///     fn nonlinear(&self, _t: T::Real, u: &[T], du: &mut [T]) { du[0] = u[0].constant(1e3); }
/// }
/// let mut orbit = ExponentialOrbit::new(&Stiff, &KROGSTAD4, StepControl::Fixed { step: 0.1 }, 0.0, &[0.0])?;
/// orbit.advance(0.1).expect("the field is smooth");
/// assert!((orbit.state()[0] - 1.0).abs() < 1e-15);
/// # Ok::<(), motiform_dynamics::Error>(())
/// ```
pub struct ExponentialOrbit<'f, F: ?Sized> {
    problem: Problem<'f, F>,
    tableau: &'static ExponentialTableau,
    control: StepControl,
    tables: StepTables,
    stages: Stages,
    restep: Stages,
    t: f64,
    t_old: f64,
    new: End,
    old: End,
    trial: End,
    /// The end of the last step before the field corrected it, if it did: `jumped`.
    landed: End,
    jumped: bool,
    errors: Vec<f64>,
    interpolant: Interpolant,
    grid: FixedGrid,
    /// `true` if `N` at the current state is the end stage of the step just accepted.
    accepted: bool,
    prepared: bool,
    counters: Counters,
}

/// Minimum step (model time).
const SMALLEST: f64 = 1e-18;

impl<'f, F: Semilinear<f64> + ?Sized> ExponentialOrbit<'f, F> {
    /// An orbit of `field` from `u` at time `t`.
    ///
    /// # Errors
    /// As [`crate::Orbit::new`].
    pub fn new(
        field: &'f F,
        tableau: &'static ExponentialTableau,
        control: StepControl,
        t: f64,
        u: &[f64],
    ) -> Result<Self, Error> {
        check_start(field.dim(), t, u)?;
        Self::start(field, None, tableau, control, t, u)
    }

    /// An orbit of a body in the plane: `u` is the shape followed by the position `x, y`.
    ///
    /// # Errors
    /// As [`crate::Orbit::new`].
    pub fn in_plane(
        model: &'f F,
        tableau: &'static ExponentialTableau,
        control: StepControl,
        t: f64,
        u: &[f64],
    ) -> Result<Self, Error>
    where
        F: Shape<Dual<f64, 1>>,
    {
        check_start(model.dim() + 2, t, u)?;
        Self::start(model, Some(drift::<F>), tableau, control, t, u)
    }

    fn start(
        field: &'f F,
        drift: Option<DriftOf<'f, F>>,
        tableau: &'static ExponentialTableau,
        control: StepControl,
        t: f64,
        u: &[f64],
    ) -> Result<Self, Error> {
        control.validate_for(tableau.name, tableau.is_adaptive())?;
        let dim = field.dim();
        let mut lambda = vec![0.0; dim];
        field.linear(&mut lambda);
        let end = End { state: u.to_vec(), slope: vec![0.0; u.len()], acceleration: [0.0; 2] };
        let stages = Stages::new(tableau, dim);
        let mut orbit = Self {
            tables: StepTables::new(tableau, &lambda),
            problem: Problem { field, drift, lambda, rough: false },
            tableau,
            control,
            restep: stages.clone(),
            stages,
            t,
            t_old: t,
            old: end.clone(),
            trial: end.clone(),
            landed: end.clone(),
            jumped: false,
            new: end,
            errors: vec![0.0; dim],
            interpolant: Interpolant::hermite(u.len()),
            grid: FixedGrid::from(t),
            accepted: true,
            prepared: false,
            counters: Counters::default(),
        };
        orbit.problem.evaluate(t, orbit.stages.get_mut(tableau.stages()), &mut orbit.new);
        orbit.choose_first_step();
        Ok(orbit)
    }

    /// A first step on which the state changes by about the square root of its tolerance; step-size control then adapts it.
    fn choose_first_step(&mut self) {
        let StepControl::Adaptive { rtol, atol } = self.control else { return };
        let tolerance = Tolerance { rtol: rtol.sqrt(), atol: atol.sqrt() };
        let shape = ..self.problem.field.controlling();
        let state = &self.new.state[shape];
        let rate = tolerance.norm(&self.new.slope[shape], state, state);
        self.tables.set_size((0.1 / rate).clamp(1e-6, 1.0));
    }

    fn advance_fixed(&mut self, step: f64, limit: f64) -> Result<(), StepFailure> {
        let (t_new, h) = self.grid.next(step, self.t, limit);
        self.begin();
        if h == step {
            self.tables.select_fixed(self.tableau, &self.problem.lambda, h);
        } else {
            self.tables.select_odd(self.tableau, &self.problem.lambda, h);
        }
        self.try_step(h);
        self.accept(t_new)?;
        self.grid = self.grid.after(t_new, limit);
        Ok(())
    }

    fn advance_adaptive(&mut self, tolerance: Tolerance, limit: f64) -> Result<(), StepFailure> {
        self.begin();
        loop {
            let remaining = limit - self.t;
            let last = self.tables.size() >= remaining;
            let h = if last { remaining } else { self.tables.size() };
            if h <= 16.0 * f64::EPSILON * self.t.abs() && !last || h < SMALLEST {
                return Err(StepFailure::Underflow { step: h });
            }
            if last {
                self.tables.select_odd(self.tableau, &self.problem.lambda, h);
            } else {
                self.tables.select_size(self.tableau, &self.problem.lambda);
            }
            self.try_step(h);
            let error = self.error(tolerance);
            if self.tables.judge(error, h, self.tableau.order, last) {
                return self.accept(if last { limit } else { self.t + h });
            }
            self.counters.rejected += 1;
        }
    }

    /// The norm of the estimated error of the step tried, on the part of the shape that controls steps.
    fn error(&mut self, tolerance: Tolerance) -> f64 {
        let shape = ..self.problem.field.controlling();
        exponential::error(self.tableau, self.tables.selected(), &self.stages, &mut self.errors);
        tolerance.norm(&self.errors[shape], &self.new.state[shape], &self.trial.state[shape])
    }

    /// The end stage of the last step is the first stage of the next one.
    fn begin(&mut self) {
        if self.accepted {
            self.stages.copy(self.tableau.stages(), 0);
            self.accepted = false;
        }
        self.t_old = self.t;
        self.jumped = false;
        self.prepared = false;
    }

    /// Takes a trial step of size `h` from the current state with the selected coefficients.
    fn try_step(&mut self, h: f64) {
        let at = Start { t: self.t, h, end: &self.new };
        self.problem.step(self.tableau, self.tables.selected(), &at, &mut self.stages, &mut self.trial);
    }

    /// Repeats the last step, but to `t`, into the trial end and the spare stages.
    fn restep_to(&mut self, t: f64) {
        let h = t - self.t_old;
        self.stages.copy_to(0, &mut self.restep);
        self.tables.select_odd(self.tableau, &self.problem.lambda, h);
        let at = Start { t: self.t_old, h, end: &self.old };
        self.problem.step(self.tableau, self.tables.selected(), &at, &mut self.restep, &mut self.trial);
    }

    /// Checks that the trial step led to a state from which the orbit can continue.
    fn check(&self) -> Result<(), StepFailure> {
        let ends = [&self.new, &self.trial];
        // Every number is looked at, also after one that is not finite: that is one comparison of vectors.
        let finite = |numbers: &Vec<f64>| numbers.iter().fold(true, |all, x| all & x.is_finite());
        if ends.iter().all(|end| finite(&end.state) & finite(&end.slope)) {
            return Ok(());
        }
        let reason =
            ends.iter().find_map(|end| self.problem.field.obstacle(&end.state[..self.problem.lambda.len()]));
        Err(reason.map_or(StepFailure::NotFinite, StepFailure::Obstacle))
    }

    /// Lets the field correct the end of the trial step, if it does so, and re-evaluates it.
    fn project(&mut self, t_new: f64) -> Result<(), StepFailure> {
        let dim = self.problem.lambda.len();
        let (shape, position) = self.landed.state.split_at_mut(dim);
        if !self.problem.field.project(&self.trial.state[..dim], shape).map_err(StepFailure::Obstacle)? {
            return Ok(());
        }
        position.copy_from_slice(&self.trial.state[dim..]);
        std::mem::swap(&mut self.trial, &mut self.landed);
        self.jumped = true;
        self.problem.evaluate(t_new, self.stages.get_mut(self.tableau.stages()), &mut self.trial);
        self.check()
    }

    /// Makes an end of the trial step 0 where it has decayed to [`VANISHED`].
    fn vanish(&mut self) {
        let shape = ..self.problem.lambda.len();
        for x in &mut self.trial.state[shape] {
            *x = if x.abs() < VANISHED { 0.0 } else { *x };
        }
    }

    fn accept(&mut self, t_new: f64) -> Result<(), StepFailure> {
        self.check()?;
        self.project(t_new)?;
        self.vanish();
        std::mem::swap(&mut self.old, &mut self.new);
        std::mem::swap(&mut self.new, &mut self.trial);
        self.t_old = self.t;
        self.t = t_new;
        self.accepted = true;
        self.counters.steps += 1;
        Ok(())
    }
}
