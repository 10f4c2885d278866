//! One orbit, step by step; the caller provides the loop.

use crate::control::{Controller, Layout, Tolerance};
use crate::ensemble::Pace;
pub use crate::interpolant::DenseStep;
use crate::interpolant::{Ends, Interpolant};
use crate::steppers::runge_kutta::{self, Slopes, Step};
use crate::steppers::{DOP853, Tableau};
pub use crate::stepping::{Counters, StepFailure};
use crate::stepping::{FixedGrid, check_start};
use crate::{Bundle, Error, Integration, StepControl, VectorField};

/// An initial-value problem in progress. [`Integration::advance`] takes one accepted step and allocates nothing.
///
/// ```
/// use motiform_dynamics::{Integration, Orbit, Scalar, StepControl, System, VectorField, steppers::DOP853};
/// struct Decay;
/// impl System for Decay { fn dim(&self) -> usize { 1 } }
/// impl<T: Scalar> VectorField<T> for Decay {
///     fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) { du[0] = -u[0]; }
/// }
/// let control = StepControl::Adaptive { rtol: 1e-12, atol: 1e-14 };
/// let mut orbit = Orbit::new(&Decay, &DOP853, control, 0.0, &[1.0])?;
/// while orbit.t() < 1.0 {
///     orbit.advance(1.0).expect("the exponential is smooth");
/// }
/// assert!((orbit.state()[0] - (-1.0_f64).exp()).abs() < 1e-12);
/// # Ok::<(), motiform_dynamics::Error>(())
/// ```
pub struct Orbit<'f, F: ?Sized> {
    field: &'f F,
    tableau: &'static Tableau,
    control: StepControl,
    controller: Controller<f64>,
    t: f64,
    t_old: f64,
    u: Vec<f64>,
    u_old: Vec<f64>,
    scratch: Vec<f64>,
    errors: Vec<f64>,
    slopes: Slopes<f64>,
    restep: Slopes<f64>,
    interpolant: Interpolant,
    /// Size of the next step to try (adaptive), or the fixed step.
    h: f64,
    /// Fixed steps count from here, so that times have no accumulated rounding error.
    grid: FixedGrid,
    /// `true` if the current state's slope is the end slope of the step just accepted.
    accepted: bool,
    /// `true` if the field corrected the end of the last step: `landed` is that end, `corrected` the slope
    /// after it.
    jumped: bool,
    landed: Vec<f64>,
    corrected: Vec<f64>,
    /// `true` if the interpolant is that of the last step.
    prepared: bool,
    counters: Counters,
}

impl<'f, F: VectorField<f64> + ?Sized> Orbit<'f, F> {
    /// An orbit of `field` from `u` at time `t`.
    ///
    /// # Errors
    /// [`Error::Shape`] if `u` is not the field's dimension, [`Error::OutOfRange`] for a time or state that is not
    /// finite, and the errors of [`StepControl::validate`].
    pub fn new(
        field: &'f F,
        tableau: &'static Tableau,
        control: StepControl,
        t: f64,
        u: &[f64],
    ) -> Result<Self, Error> {
        control.validate(tableau)?;
        check_start(field.dim(), t, u)?;
        let mut slopes = Slopes::new(tableau, u);
        field.eval(t, u, slopes.get_mut(tableau.stages()));
        let mut orbit = Self {
            field,
            tableau,
            control,
            controller: Controller::new(tableau),
            t,
            t_old: t,
            u: u.to_vec(),
            u_old: u.to_vec(),
            scratch: vec![0.0; u.len()],
            errors: vec![0.0; 2 * u.len()],
            restep: slopes.clone(),
            slopes,
            interpolant: Interpolant::new(tableau, u.len()),
            h: 0.0,
            grid: FixedGrid::from(t),
            accepted: true,
            jumped: false,
            landed: vec![0.0; u.len()],
            corrected: vec![0.0; u.len()],
            prepared: false,
            counters: Counters::default(),
        };
        orbit.h = match control {
            StepControl::Fixed { step } => step,
            StepControl::Adaptive { rtol, atol } => orbit.first_step(Tolerance { rtol, atol }),
        };
        Ok(orbit)
    }

    /// An orbit by DOP853 that continues from `u` at time `t` at the pace of an earlier stretch, or starts there, for members that a lane
    /// of an ensemble could not finish.
    ///
    /// # Errors
    /// As [`Orbit::new`].
    pub fn resume(
        field: &'f F,
        control: StepControl,
        t: f64,
        u: &[f64],
        pace: Option<Pace>,
    ) -> Result<Self, Error> {
        let mut orbit = Self::new(field, &DOP853, control, t, u)?;
        if let Some(pace) = pace {
            orbit.h = pace.h;
            orbit.controller.remember(0, pace.previous);
        }
        Ok(orbit)
    }

    /// The data that an orbit or a lane needs, beside time and state, to continue from here.
    pub fn pace(&self) -> Pace {
        Pace { h: self.h, previous: self.controller.previous() }
    }

    fn first_step(&mut self, tolerance: Tolerance) -> f64 {
        let slope = self.slopes.get(self.tableau.stages());
        let room = [&mut self.scratch[..], self.restep.get_mut(0)];
        tolerance.first_step(self.field, self.tableau.order, self.t, &self.u, slope, room)
    }

    fn advance_fixed(&mut self, step: f64, limit: f64) -> Result<(), StepFailure> {
        let (t_new, h) = self.grid.next(step, self.t, limit);
        self.begin();
        self.try_step(h);
        if self.scratch.iter().any(|x| !x.is_finite()) {
            return Err(self.explain(StepFailure::NotFinite));
        }
        self.evaluate_end(h);
        self.accept(t_new)?;
        self.grid = self.grid.after(t_new, limit);
        Ok(())
    }

    fn advance_adaptive(&mut self, tolerance: Tolerance, limit: f64) -> Result<(), StepFailure> {
        self.begin();
        loop {
            let remaining = limit - self.t;
            let last = self.h >= remaining;
            // Two equal steps to the end rather than a full one and a crumb.
            let h = if last { remaining } else { self.h.min(0.5 * remaining) };
            if h <= 16.0 * f64::EPSILON * self.t.abs() && !last || h < f64::MIN_POSITIVE {
                return Err(self.explain(StepFailure::Underflow { step: h }));
            }
            self.try_step(h);
            let needs_end = self.tableau.error_needs_end();
            if needs_end {
                self.evaluate_end(h);
            }
            let error = {
                let (ends, layout) = ([&self.u[..], &self.scratch[..]], Layout::of(self.field));
                tolerance.step_error(self.tableau, &self.slopes, h, ends, layout, &mut self.errors)
            };
            let judgement = self.controller.judge(error);
            if judgement.accepted.has(0) {
                if !needs_end {
                    self.evaluate_end(h);
                }
                // A step cut short by the limit says little about the next one.
                let next = h * judgement.factor;
                self.h = if last { Bundle::max(self.h, next) } else { next };
                return self.accept(if last { limit } else { self.t + h });
            }
            self.counters.rejected += 1;
            self.h = h * judgement.factor;
        }
    }

    /// The model's own reason for a failed step, if it has one.
    fn explain(&self, failure: StepFailure) -> StepFailure {
        self.field.obstacle(&self.scratch).map_or(failure, StepFailure::Obstacle)
    }

    /// The end slope of the last step is the first slope of the next one.
    fn begin(&mut self) {
        if self.accepted {
            if self.jumped {
                self.slopes.get_mut(0).copy_from_slice(&self.corrected);
                self.jumped = false;
            } else {
                self.slopes.copy(self.tableau.stages(), 0);
            }
            self.accepted = false;
        }
        self.t_old = self.t; // until a step is accepted, the last step is empty
        self.prepared = false;
    }

    /// Computes the stages and the new state (into `scratch`) for a step of size `h` from the current state.
    fn try_step(&mut self, h: f64) {
        let at = Step { t: self.t, h, u: &self.u };
        runge_kutta::step(self.tableau, self.field, &at, &mut self.slopes, &mut self.scratch);
    }

    fn evaluate_end(&mut self, h: f64) {
        let at = Step { t: self.t, h, u: &self.u };
        runge_kutta::end_slope(self.tableau, self.field, &at, &mut self.slopes, &self.scratch);
    }

    fn accept(&mut self, t_new: f64) -> Result<(), StepFailure> {
        if self.field.project(&self.scratch, &mut self.landed).map_err(StepFailure::Obstacle)? {
            std::mem::swap(&mut self.scratch, &mut self.landed);
            self.field.eval(t_new, &self.scratch, &mut self.corrected);
            self.jumped = true;
        }
        std::mem::swap(&mut self.u_old, &mut self.u);
        std::mem::swap(&mut self.u, &mut self.scratch);
        self.t_old = self.t;
        self.t = t_new;
        self.accepted = true;
        self.counters.steps += 1;
        Ok(())
    }

    fn place(&mut self, u: &[f64]) {
        self.u.copy_from_slice(u);
        self.u_old.copy_from_slice(u);
        self.t_old = self.t;
        self.accepted = true;
        self.jumped = false;
        self.prepared = false;
    }
}

impl<F: VectorField<f64> + ?Sized> Integration for Orbit<'_, F> {
    fn advance(&mut self, limit: f64) -> Result<(), StepFailure> {
        match self.control {
            StepControl::Fixed { step } => self.advance_fixed(step, limit),
            StepControl::Adaptive { rtol, atol } => self.advance_adaptive(Tolerance { rtol, atol }, limit),
        }
    }

    /// Computes the extra stages of dense output where the method has any.
    fn dense(&mut self) -> DenseStep<'_> {
        if !self.prepared {
            let h = self.t - self.t_old;
            let at = Step { t: self.t_old, h, u: &self.u_old };
            runge_kutta::extra_stages(self.tableau, self.field, &at, &mut self.slopes);
            let new = if self.jumped { &self.landed } else { &self.u };
            let ends = Ends { h, old: &self.u_old, new };
            self.interpolant.prepare(self.tableau, &self.slopes, &ends);
            self.prepared = true;
        }
        DenseStep {
            t_old: self.t_old,
            t: self.t,
            old: &self.u_old,
            new: &self.u,
            interpolant: &self.interpolant,
        }
    }

    fn step_to(&mut self, t: f64, out: &mut [f64]) {
        self.restep.get_mut(0).copy_from_slice(self.slopes.get(0));
        let at = Step { t: self.t_old, h: t - self.t_old, u: &self.u_old };
        runge_kutta::step(self.tableau, self.field, &at, &mut self.restep, out);
    }

    fn end_step_at(&mut self, t: f64) {
        let mut state = std::mem::take(&mut self.scratch);
        self.step_to(t, &mut state);
        self.scratch = std::mem::replace(&mut self.u, state);
        self.t = t;
        self.grid = FixedGrid::from(t);
        self.field.eval(t, &self.u, self.slopes.get_mut(self.tableau.stages()));
        self.jumped = false;
        self.prepared = false;
    }

    fn restart(&mut self, u: &[f64]) {
        self.field.eval(self.t, u, self.slopes.get_mut(self.tableau.stages()));
        self.place(u);
    }

    fn restart_with(&mut self, u: &[f64], rates: &[f64]) {
        self.slopes.get_mut(self.tableau.stages()).copy_from_slice(rates);
        self.place(u);
    }

    fn t(&self) -> f64 {
        self.t
    }

    fn t_old(&self) -> f64 {
        self.t_old
    }

    fn state(&self) -> &[f64] {
        &self.u
    }

    fn slope(&self) -> &[f64] {
        match (self.accepted, self.jumped) {
            (false, _) => self.slopes.get(0),
            (true, false) => self.slopes.get(self.tableau.stages()),
            (true, true) => &self.corrected,
        }
    }

    fn counters(&self) -> Counters {
        self.counters
    }
}
