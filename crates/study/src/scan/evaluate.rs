//! What is computed for one row.

use super::ScanPlan;
use crate::Error;
use crate::simulate::Monitor;
use motiform_analysis::regime::{Attractor, Regime, Spread, Verdict};
use motiform_dynamics::drive::drive;
use motiform_dynamics::escape::norm;
use motiform_dynamics::model::velocity;
use motiform_dynamics::{Integration, Model, Outcome, Request, Sink};
use std::ops::ControlFlow;

/// What is asked of each row.
pub trait Evaluate: Sync {
    /// The verdict on initial state `sample` of `cell`, a function of the plan and these two numbers alone; `None` if
    /// `stop` asked to stop.
    ///
    /// # Errors
    /// Input that only the numerics can refuse; the row then says so and is undetermined.
    fn evaluate(
        &self,
        plan: &ScanPlan,
        cell: usize,
        sample: usize,
        stop: &dyn Monitor,
    ) -> Result<Option<Verdict>, Error>;
}

// TO BE REPLACED by `motiform_analysis::regime::classify`. Until then scans know three answers.
/// Runs the shape for the budget: it blows up, ends on a fixed shape, or is undetermined.
#[derive(Clone, Copy, Debug, Default)]
pub struct ShapeRun;

/// Model time of a run where the plan leaves it open.
const DEFAULT_BUDGET: f64 = 200.0;

impl Evaluate for ShapeRun {
    fn evaluate(
        &self,
        plan: &ScanPlan,
        cell: usize,
        sample: usize,
        stop: &dyn Monitor,
    ) -> Result<Option<Verdict>, Error> {
        let c = &plan.computation;
        let model = plan.model_of(cell)?;
        let start = plan.start(cell, sample, model.as_ref())?;
        let mut orbit = plan.method()?.shape_orbit(model.as_ref(), c.control.into(), 0.0, &start)?;
        let t_end = if c.budget > 0.0 { c.budget } else { DEFAULT_BUDGET };
        let request = Request {
            max_steps: c.max_steps,
            escape_norm: c.escape_norm,
            ..Request::until(t_end, model.dim())
        };
        let outcome = drive(orbit.as_mut(), &request, &mut Stop { monitor: stop, ticks: 0 })?;
        Ok(match outcome {
            Outcome::Interrupted { .. } => None,
            outcome => Some(verdict(model.as_ref(), orbit.as_ref(), outcome)),
        })
    }
}

fn verdict(model: &dyn Model, orbit: &dyn Integration, outcome: Outcome) -> Verdict {
    let time = orbit.t();
    if let Outcome::Escaped { t, .. } = outcome {
        let verdict = Verdict::new(Regime::BlowUp, Attractor::Escape, outcome.to_string(), time);
        return Verdict { escape_time: Some(t), ..verdict };
    }
    let rate = norm(orbit.slope());
    if outcome.is_complete() && rate < 1e-6 * (1.0 + norm(orbit.state())) {
        let why = format!("the shape changes at a rate of {rate:.1e} at the end");
        let [vx, vy] = velocity(model, orbit.state());
        let speed = libm::hypot(vx, vy);
        let regime = if speed < 1e-6 { Regime::Motionless } else { Regime::Straight };
        let verdict = Verdict::new(regime, Attractor::Equilibrium, why, time);
        return Verdict { speed: Some(Spread { mean: speed, min: speed, max: speed }), ..verdict };
    }
    Verdict::new(Regime::Undetermined, Attractor::Unknown, outcome.to_string(), time)
}

/// Listens for the stop.
struct Stop<'m> {
    monitor: &'m dyn Monitor,
    ticks: u32,
}

impl Sink for Stop<'_> {
    fn tick(&mut self, _t: f64) -> ControlFlow<()> {
        self.ticks = self.ticks.wrapping_add(1);
        let stopped = self.ticks.is_multiple_of(64) && self.monitor.stopped();
        if stopped { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}
