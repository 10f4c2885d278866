//! Runs of many bodies under noise, in the lanes of vector registers.

use crate::ensemble::{Track, named};
use crate::live::start;
use crate::pool::{Jobs, spread};
use crate::simulate::{noise_steps, track};
use motiform_dynamics::ensemble::NoisySpan;
use motiform_dynamics::simd::{InstructionSet, has_lanes};
use motiform_dynamics::{Model, Outcome, Part, StepControl, Watch};
use motiform_kernels::{Kernel, NoisyStart, NoisyStates, Stretch, propagate_noisy_bodies};
use motiform_study::plan::NoiseSettings;
use motiform_study::{Error, Plan};

/// Returns `true` if [`noisy_tracks`] computes this plan in lanes: noise on the tensor model or on amplitude
/// equations of at most four modes, with dop853 and a tolerance, on a machine with vector registers.
///
/// # Errors
/// An unknown model.
pub fn has_noisy_lanes(plan: &Plan) -> Result<bool, Error> {
    let model = plan.body()?;
    Ok(plan.computation.noise.is_some() && setting(plan, model.as_ref()).is_some())
}

/// The kernel and the tolerances with which the lanes compute a plan; `None` if they do not.
fn setting(plan: &Plan, model: &dyn Model) -> Option<(Kernel, [f64; 2])> {
    let StepControl::Adaptive { rtol, atol } = plan.computation.control.into() else { return None };
    let suited = has_lanes() && plan.computation.stepper == "dop853";
    suited.then_some((Kernel::of(model)?, [rtol, atol]))
}

/// The rows of the runs of `plans`, which differ in nothing but their seeds and starts: transient and
/// recording, as [`crate::simulate::simulate`] gives them, to the bit; in lanes if there are any
/// ([`has_noisy_lanes`]). `None` if the watch stopped it. A run that ended during its transient has no rows.
///
/// # Errors
/// Input that only the numerics can reject.
///
/// # Checked by  tests/all/noisy_lanes.rs: against single runs, for both models, threads, escapes
pub fn noisy_tracks(plans: &[Plan], threads: usize, watch: &dyn Watch) -> Result<Option<Vec<Track>>, Error> {
    let Some(first) = plans.first() else { return Ok(Some(Vec::new())) };
    let model = first.body()?;
    let model = model.as_ref();
    let (Some(noise), Some((kernel, tolerances))) = (first.computation.noise, setting(first, model)) else {
        return spread(plans.len(), threads, watch, |jobs| jobs.each(|job| track(&plans[job], model, watch)));
    };
    let bodies = Bodies { plans, model, noise, kernel, tolerances };
    let c = &first.computation;
    let share = c.transient / (c.transient + c.t_end);
    let early = Part { watch, from: 0.0, to: share };
    let settled = spread(plans.len(), threads, &early, |jobs| bodies.settle(jobs, watch))?;
    let Some(settled) = settled else { return Ok(None) };
    let late = Part { watch, from: share, to: 1.0 };
    spread(plans.len(), threads, &late, |jobs| bodies.record(&settled, jobs, watch))
}

/// Runs of one model with one kind of noise.
struct Bodies<'b> {
    plans: &'b [Plan],
    model: &'b dyn Model,
    noise: NoiseSettings,
    kernel: Kernel,
    tolerances: [f64; 2],
}

impl Bodies<'_> {
    fn span(&self, times: (f64, f64), every: Option<f64>) -> NoisySpan {
        let c = &self.plans[0].computation;
        let [rtol, atol] = self.tolerances;
        NoisySpan {
            times,
            every,
            rtol,
            atol,
            escape_norm: c.escape_norm,
            max_steps: c.max_steps,
            set: InstructionSet::widest(),
        }
    }

    fn start(&self, key: usize, state: Vec<f64>, t: f64, stretch: u64) -> Result<NoisyStart<'_>, Error> {
        let noise =
            noise_steps(&self.plans[key].computation, self.noise, self.model, stretch, t, state.len())?;
        Ok(NoisyStart { key, body: self.model, state, noise })
    }

    /// The shapes after the transient; nothing for a body that did not reach its end.
    fn settle(&self, jobs: &Jobs<'_, Option<Vec<f64>>>, watch: &dyn Watch) {
        let begin = 0.0 - self.plans[0].computation.transient;
        let span = self.span((begin, 0.0), None);
        let mut next = || {
            let key = jobs.next()?;
            let mut state = start(&self.plans[key], self.model);
            state.truncate(self.model.dim());
            entered(jobs, key, self.start(key, state, begin, 0))
        };
        let mut done = |key: usize, states: Option<NoisyStates<'_>>| {
            jobs.done(key, Ok(Some(states.map(|states| states.last.to_vec()))));
        };
        propagate_noisy_bodies(self.kernel, Stretch::Shape, &span, &mut next, &mut done, watch);
    }

    /// The rows of those that have settled; single runs say what happened to the others.
    fn record(&self, settled: &[Option<Vec<f64>>], jobs: &Jobs<'_, Track>, watch: &dyn Watch) {
        let c = &self.plans[0].computation;
        let span = self.span((0.0, c.t_end), Some(c.dt_out));
        let alone = |key: usize| jobs.done(key, track(&self.plans[key], self.model, watch));
        let mut next = || {
            loop {
                let key = jobs.next()?;
                let Some(shape) = &settled[key] else {
                    alone(key);
                    continue;
                };
                let mut state = start(&self.plans[key], self.model);
                state[..shape.len()].copy_from_slice(shape);
                return entered(jobs, key, self.start(key, state, 0.0, 1));
            }
        };
        let mut done = |key: usize, states: Option<NoisyStates<'_>>| match states {
            Some(NoisyStates { rows, .. }) => {
                let states = rows.iter().map(|row| named(self.model, row)).collect();
                jobs.done(key, Ok(Some(Track { states, outcome: Outcome::Completed { t: c.t_end } })));
            }
            None => alone(key),
        };
        propagate_noisy_bodies(self.kernel, Stretch::Plane, &span, &mut next, &mut done, watch);
    }
}

/// A start, or its error as the answer to the job.
fn entered<'m, A>(
    jobs: &Jobs<'_, A>,
    key: usize,
    start: Result<NoisyStart<'m>, Error>,
) -> Option<NoisyStart<'m>> {
    start.map_err(|error| jobs.done(key, Err(error))).ok()
}
