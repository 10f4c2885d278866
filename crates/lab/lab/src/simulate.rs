//! Plan to dataset: the run itself.

use crate::ensemble::{Track, named};
use crate::live::start;
use crate::readings::{self, measures};
use crate::recorder::{Centre, Record, Recorder, Rows, Unless};
use motiform_dynamics::drive::drive;
use motiform_dynamics::escape::norm;
use motiform_dynamics::model::velocity;
use motiform_dynamics::{
    Direction, InPlane, Integration, Model, Noise, NoiseSteps, NoisyOrbit, Normal, Outcome, Part, Request,
    Section, StepControl, Trajectory, Watch,
};
use motiform_store::table::Table;
use motiform_study::dataset::{Dataset, Manifest, VERSION};
use motiform_study::plan::{Computation, Control, Named, NoiseSettings, Plan};
use motiform_study::{Ending, Error};

/// Runs a plan.
///
/// # Errors
/// Input that only the numerics can reject. A run that ends early is a [`Dataset`] with its [`Outcome`].
pub fn simulate(plan: &Plan, watch: &dyn Watch) -> Result<Dataset, Error> {
    plan.check_in_memory()?;
    let mut trajectory = columns(plan)?;
    let Run { manifest, crossings } = simulate_into(plan, &mut trajectory, watch)?;
    Ok(Dataset { manifest, trajectory, crossings })
}

/// The columns of a plan's trajectory, without rows.
///
/// # Errors
/// An unknown model.
pub fn columns(plan: &Plan) -> Result<Table, Error> {
    Ok(readings::columns(plan.body()?.as_ref()))
}

/// Runs a plan whose trajectory goes to `rows` as it is computed: nothing of it is kept here.
///
/// # Errors
/// As [`simulate`], and what `rows` cannot take: the run then ends.
pub fn simulate_into(plan: &Plan, rows: &mut dyn Rows, watch: &dyn Watch) -> Result<Run, Error> {
    let model = plan.body()?;
    let body = InPlane(model.as_ref());
    let run = Simulation { plan, computation: &plan.computation, model: model.as_ref(), body: &body, watch };
    run.all(rows)
}

/// A run without its trajectory.
pub struct Run {
    /// The plan, and how the run ended.
    pub manifest: Manifest,
    /// The crossings of the return map's segment.
    pub crossings: Option<Table>,
}

/// The state `(shape, x, y)` after the plan's transient, and how the run ended if it ended before that was over.
pub(crate) fn after_transient(
    plan: &Plan,
    model: &dyn Model,
    watch: &dyn Watch,
) -> Result<(Option<Ending>, Vec<f64>), Error> {
    let run = Simulation { plan, computation: &plan.computation, model, body: &InPlane(model), watch };
    let stretch = run.transient(0.0, 1.0)?;
    Ok((stretch.early(), stretch.last))
}

pub(crate) struct Simulation<'r> {
    plan: &'r Plan,
    pub(crate) computation: &'r Computation,
    pub(crate) model: &'r dyn Model,
    body: &'r InPlane<&'r dyn Model>,
    watch: &'r dyn Watch,
}

/// A part of a run: how it ended.
struct RunPart {
    ending: Ending,
    last: Vec<f64>,
    steps: u64,
    rejected: u64,
}

impl RunPart {
    /// The ending, if it came before the end of the stretch.
    fn early(&self) -> Option<Ending> {
        (!self.ending.is_complete()).then_some(self.ending)
    }
}

impl Simulation<'_> {
    fn all(&self, rows: &mut dyn Rows) -> Result<Run, Error> {
        let map = self.computation.return_map.as_ref();
        let mut record = Recorder::new(self, rows);
        let centring = map.is_some_and(|map| map.centre); // two passes
        let passes = if centring { 2.0 } else { 1.0 };
        let settled = self.transient(0.0, passes)?;
        if let Some(ending) = settled.early() {
            self.before(ending, &mut record)?;
            return Ok(self.run(&settled, None, record.finish()?));
        }
        let (start, end) = (settled.last, self.computation.t_end);
        let first = self.record(&start, (0.0, end), passes, 0.0, &mut record)?;
        let Some(centre) = record.centre().filter(|_| first.ending.is_complete()) else {
            return Ok(self.run(&first, None, record.finish()?));
        };
        // The flow does not depend on the position: the second pass is the first one, moved.
        let centre = match centre {
            Ok(centre) => centre,
            Err(last) => {
                let mut again = Centre::new(0.0, last);
                self.record(&start, (0.0, end), passes, 0.0, &mut again)?;
                again.found()
            }
        };
        let mut moved = start;
        let place = moved.len() - 2;
        moved[place] -= centre[0];
        moved[place + 1] -= centre[1];
        record.restart()?;
        let second = self.record(&moved, (0.0, end), passes, 1.0, &mut record)?;
        Ok(self.run(&second, Some(centre), record.finish()?))
    }

    /// The shape through the transient, except for its last part of length `rest`; the position is reset.
    fn transient(&self, rest: f64, passes: f64) -> Result<RunPart, Error> {
        let c = self.computation;
        let mut last = start(self.plan, self.model);
        let shape = ..last.len() - 2;
        let method = self.plan.method()?;
        let orbit = method.shape_orbit(self.model, c.control.into(), -c.transient, &last[shape])?;
        let mut orbit = noisy(c, orbit, self.model, 0)?;
        let total = c.transient + passes * c.t_end;
        let watch = Part { watch: self.watch, from: 0.0, to: c.transient / total };
        let request = Request { t_end: -rest, watch: &watch, ..self.request(&[]) };
        let outcome = drive(orbit.as_mut(), &request, &mut ())?;
        last[shape].copy_from_slice(orbit.state());
        let counters = orbit.counters();
        let ending = Ending::of_transient(outcome, c.transient);
        Ok(RunPart { ending, last, steps: counters.steps, rejected: counters.rejected })
    }

    /// Records the last interval of a run that ended during its transient, as long as the recording would have been. Nothing with noise,
    /// which is not drawn a second time, and after an interruption, which must not wait.
    fn before(&self, ending: Ending, record: &mut dyn Record) -> Result<(), Error> {
        let c = self.computation;
        let lasted = ending.t_last();
        if c.noise.is_some() || matches!(ending.outcome, Outcome::Interrupted { .. }) || lasted == 0.0 {
            return Ok(());
        }
        let from = (lasted - c.t_end).max(0.0);
        let settled = self.transient(c.transient - from, 1.0)?;
        self.record(&settled.last, (from, lasted), 1.0, 0.0, record).map(drop)
    }

    fn request<'g>(&self, sections: &'g [Section<'g>]) -> Request<'g> {
        let c = self.computation;
        Request {
            max_steps: c.max_steps,
            escape_norm: c.escape_norm,
            watched: self.model.dim(),
            sections,
            ..Request::until(c.t_end, self.model.dim() + 2)
        }
    }

    fn record(
        &self,
        start: &[f64],
        (from, to): (f64, f64),
        passes: f64,
        pass: f64,
        record: &mut dyn Record,
    ) -> Result<RunPart, Error> {
        let c = self.computation;
        let orbit = self.plan.method()?.orbit(self.body, c.control.into(), from, start)?;
        let mut orbit = noisy(c, orbit, self.model, 1)?;
        let height = c.return_map.as_ref().map_or(0.0, |map| map.y);
        let above = |_t: f64, u: &[f64]| u[u.len() - 1] - height;
        let sections = [Section { g: &above, direction: Direction::Either, terminal: false }];
        let wanted = if c.return_map.is_some() { &sections[..] } else { &[] };
        let total = c.transient + passes * c.t_end;
        let share = |pass: f64| (c.transient + pass * c.t_end) / total;
        let stop = record.full();
        let watch = Unless { watch: self.watch, stop: &stop };
        let watch = Part { watch: &watch, from: share(pass), to: share(pass + 1.0) };
        let request =
            Request { t_end: to, sample_every: Some(c.dt_out), watch: &watch, ..self.request(wanted) };
        let outcome = drive(orbit.as_mut(), &request, record.sink())?;
        let counters = orbit.counters();
        let last = orbit.state().to_vec();
        let ending = Ending::from(outcome);
        Ok(RunPart { ending, last, steps: counters.steps, rejected: counters.rejected })
    }

    /// The local error of a fixed step at the end of the run, by halving it; `None` for adaptive steps, and if the
    /// step is impossible.
    fn step_error(&self, shape: &[f64]) -> Option<f64> {
        let Control::Fixed { step } = self.computation.control else { return None };
        let method = self.plan.method().ok()?;
        let after = |h: f64| {
            let mut orbit =
                method.shape_orbit(self.model, StepControl::Fixed { step: h }, 0.0, shape).ok()?;
            while orbit.t() < step {
                orbit.advance(step).ok()?;
            }
            Some(orbit.state().to_vec())
        };
        let (whole, halves) = (after(step)?, after(0.5 * step)?);
        let difference: Vec<f64> = whole.iter().zip(&halves).map(|(a, b)| a - b).collect();
        let relative = norm(&difference) / norm(&halves);
        relative.is_finite().then_some(relative)
    }

    fn run(&self, recording: &RunPart, centre: Option<[f64; 2]>, crossings: Option<Table>) -> Run {
        let (shape, position) = recording.last.split_at(recording.last.len() - 2);
        let values = self.model.decoded(shape);
        let names = self.model.coordinates().iter().map(|c| c.name.to_owned());
        let manifest = Manifest {
            motiform: VERSION.to_owned(),
            plan: self.plan.clone(),
            plan_hash: self.plan.hash(),
            seed: self.computation.seed,
            outcome: finite(recording.ending),
            regime: None,
            steps: recording.steps,
            rejected_steps: recording.rejected,
            state: Named(names.zip(values).collect()),
            position: [position[0], position[1]],
            velocity: velocity(self.model, shape),
            measures: measures(self.model, shape),
            step_error: self.step_error(shape),
            centre,
        };
        Run { manifest, crossings }
    }
}

/// The orbit of `model` with the plan's noise, if it has any. Every stretch has a separate stream of deviates, far from those
/// of the starts: a run's transient is number 0, its recording 1.
pub(crate) fn noisy<'o>(
    computation: &Computation,
    orbit: Box<dyn Integration + 'o>,
    model: &dyn Model,
    stretch: u64,
) -> Result<Box<dyn Integration + 'o>, Error> {
    let Some(settings) = computation.noise else { return Ok(orbit) };
    let steps = noise_steps(computation, settings, model, stretch, orbit.t(), orbit.state().len())?;
    Ok(Box::new(NoisyOrbit::of(orbit, steps)))
}

/// The noise of a stretch that starts at this time with states of this length.
pub(crate) fn noise_steps(
    computation: &Computation,
    settings: NoiseSettings,
    model: &dyn Model,
    stretch: u64,
    t: f64,
    dim: usize,
) -> Result<NoiseSteps, Error> {
    let noise = Noise::on(model, settings.velocity, settings.shape, settings.step);
    let normal = Normal::new(computation.seed, u64::MAX - stretch);
    let steps = NoiseSteps::new(&noise, normal, t, dim)?;
    Ok(match model.noise().diffusion {
        Some(diffusion) => steps.with(diffusion),
        None => steps,
    })
}

/// The run of a plan as a track of its rows; `None` if the watch stopped it.
pub(crate) fn track(plan: &Plan, model: &dyn Model, watch: &dyn Watch) -> Result<Option<Track>, Error> {
    let run = Simulation { plan, computation: &plan.computation, model, body: &InPlane(model), watch };
    plan.check_in_memory()?;
    let settled = run.transient(0.0, 1.0)?;
    let mut trajectory = Trajectory::new(settled.last.len());
    let recorded = match settled.early() {
        Some(_) => settled,
        None => run.record(&settled.last, (0.0, plan.computation.t_end), 1.0, 0.0, &mut trajectory)?,
    };
    let outcome = recorded.ending.outcome;
    let states = trajectory.iter().map(|(_, state)| named(model, state)).collect();
    Ok((!matches!(outcome, Outcome::Interrupted { .. })).then_some(Track { states, outcome }))
}

/// The norm of a finite state may overflow. Files hold no infinity: it becomes the largest number.
pub(crate) fn finite(mut ending: Ending) -> Ending {
    if let Outcome::Escaped { norm, .. } = &mut ending.outcome {
        *norm = norm.min(f64::MAX);
    }
    ending
}
