//! Plan to dataset: the run itself.

use crate::Error;
use crate::dataset::{Dataset, Manifest, VERSION};
use crate::live::start;
use crate::plan::{Computation, Control, Named, NoiseSettings, Plan};
use crate::study::ReturnMapSettings;
use crate::table::Table;
use motiform_dynamics::drive::drive;
use motiform_dynamics::escape::norm;
use motiform_dynamics::model::{turning_rate, velocity, velocity_and_acceleration};
use motiform_dynamics::noise::{Noise, NoisyOrbit, Normal};
use motiform_dynamics::section::Crossing;
use motiform_dynamics::{
    Direction, InPlane, Integration, Model, Outcome, Request, Section, Sink, StepControl, Trajectory,
};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

/// How the caller watches and stops a run.
pub trait Monitor: Sync {
    /// The part of the work that is done, 0 to 1; called often.
    fn progress(&self, _done: f64) {}

    /// Whether to stop here and keep what there is.
    fn stopped(&self) -> bool {
        false
    }
}

/// Nobody watches.
impl Monitor for () {}

/// A flag that stops a run.
impl Monitor for AtomicBool {
    fn stopped(&self) -> bool {
        self.load(Ordering::Relaxed)
    }
}

/// Runs a plan.
///
/// # Errors
/// Input that only the numerics can refuse. A run that ends early is a [`Dataset`] with its [`Outcome`].
pub fn simulate(plan: &Plan, monitor: &dyn Monitor) -> Result<Dataset, Error> {
    let info = plan.info()?;
    let model = info.build(&plan.computation.parameters.values())?;
    let body = InPlane(model.as_ref());
    let run = Run { plan, computation: &plan.computation, model: model.as_ref(), body: &body, monitor };
    run.all()
}

/// The state `(shape, x, y)` after the plan's transient, or how the run ended before it was over.
pub(crate) fn after_transient(
    plan: &Plan,
    model: &dyn Model,
    monitor: &dyn Monitor,
) -> Result<(Option<Outcome>, Vec<f64>), Error> {
    let run = Run { plan, computation: &plan.computation, model, body: &InPlane(model), monitor };
    run.transient(1.0)
}

struct Run<'r> {
    plan: &'r Plan,
    computation: &'r Computation,
    model: &'r dyn Model,
    body: &'r InPlane<&'r dyn Model>,
    monitor: &'r dyn Monitor,
}

/// A recorded stretch.
struct Recording {
    outcome: Outcome,
    trajectory: Trajectory,
    last: Vec<f64>,
    steps: u64,
    rejected: u64,
}

impl Run<'_> {
    fn all(&self) -> Result<Dataset, Error> {
        let centring = self.computation.return_map.as_ref().is_some_and(|map| map.centre);
        let passes = if centring { 2.0 } else { 1.0 };
        let (ended, start) = self.transient(passes)?;
        if let Some(outcome) = ended {
            let nothing = Trajectory::new(start.len());
            let recording = Recording { outcome, trajectory: nothing, last: start, steps: 0, rejected: 0 };
            return Ok(self.dataset(&recording, None));
        }
        let first = self.record(&start, passes, 0.0)?;
        if !(centring && first.outcome.is_complete()) {
            return Ok(self.dataset(&first, None));
        }
        // The flow does not depend on the position: the second pass is the first one, moved.
        let path = first.trajectory.iter().map(|(t, u)| (t, [u[u.len() - 2], u[u.len() - 1]]));
        let end = first.trajectory.times().last().copied().unwrap_or(1.0);
        let centre = centre_of(path, 0.0, end);
        let mut moved = start;
        let place = moved.len() - 2;
        moved[place] -= centre[0];
        moved[place + 1] -= centre[1];
        let second = self.record(&moved, passes, 1.0)?;
        Ok(self.dataset(&second, Some(centre)))
    }

    /// The start after the transient, position put back; or how the run ended before it was over.
    fn transient(&self, passes: f64) -> Result<(Option<Outcome>, Vec<f64>), Error> {
        let c = self.computation;
        let mut u = start(self.plan, self.model);
        if c.transient == 0.0 {
            return Ok((None, u));
        }
        let shape = ..u.len() - 2;
        let orbit = self.plan.method()?.shape_orbit(self.model, c.control.into(), -c.transient, &u[shape])?;
        let mut orbit = noisy(c, orbit, self.model.dim(), 0)?;
        let total = c.transient + passes * c.t_end;
        let mut sink = Watched {
            trajectory: None,
            monitor: self.monitor,
            start: -c.transient,
            done: 0.0,
            total,
            ticks: 0,
        };
        let request = Request { t_end: 0.0, ..self.request(&[]) };
        let outcome = drive(orbit.as_mut(), &request, &mut sink)?;
        u[shape].copy_from_slice(orbit.state());
        Ok(((!outcome.is_complete()).then_some(outcome), u))
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

    fn record(&self, start: &[f64], passes: f64, pass: f64) -> Result<Recording, Error> {
        let c = self.computation;
        let orbit = self.plan.method()?.orbit(self.body, c.control.into(), 0.0, start)?;
        let mut orbit = noisy(c, orbit, self.model.dim(), 1)?;
        let mut trajectory = Trajectory::new(start.len());
        let height = c.return_map.as_ref().map_or(0.0, |map| map.y);
        let above = |_t: f64, u: &[f64]| u[u.len() - 1] - height;
        let sections = [Section { g: &above, direction: Direction::Either, terminal: false }];
        let wanted = if c.return_map.is_some() { &sections[..] } else { &[] };
        let request = Request { sample_every: Some(c.dt_out), ..self.request(wanted) };
        let total = c.transient + passes * c.t_end;
        let done = c.transient + pass * c.t_end;
        let mut sink = Watched {
            trajectory: Some(&mut trajectory),
            monitor: self.monitor,
            start: 0.0,
            done,
            total,
            ticks: 0,
        };
        let outcome = drive(orbit.as_mut(), &request, &mut sink)?;
        let counters = orbit.counters();
        let last = orbit.state().to_vec();
        Ok(Recording { outcome, trajectory, last, steps: counters.steps, rejected: counters.rejected })
    }

    /// The local error of a fixed step at the end of the run, by halving it; `None` for adaptive steps, and where the
    /// step cannot be made.
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

    fn dataset(&self, recording: &Recording, centre: Option<[f64; 2]>) -> Dataset {
        let (shape, position) = recording.last.split_at(recording.last.len() - 2);
        let mut values = shape.to_vec();
        self.model.decode(shape, &mut values);
        let names = self.model.coordinates().iter().map(|c| c.name.to_owned());
        let manifest = Manifest {
            motiform: VERSION.to_owned(),
            plan: self.plan.clone(),
            plan_hash: self.plan.hash(),
            seed: self.computation.seed,
            outcome: finite(recording.outcome),
            steps: recording.steps,
            rejected_steps: recording.rejected,
            state: Named(names.zip(values).collect()),
            position: [position[0], position[1]],
            velocity: velocity(self.model, shape),
            measures: measures(self.model, shape),
            step_error: self.step_error(shape),
            centre,
        };
        let map = self.computation.return_map.as_ref();
        Dataset {
            manifest,
            trajectory: motion(self.model, &recording.trajectory, self.computation.control),
            crossings: map.map(|map| crossings(&recording.trajectory, map)),
        }
    }
}

/// The orbit with the plan's noise on its leading `entries`, if it has any. Every stretch has a stream of deviates of its own, far
/// from those of the starts: a run's transient is number 0, its recording 1.
pub(crate) fn noisy<'o>(
    computation: &Computation,
    orbit: Box<dyn Integration + 'o>,
    entries: usize,
    stretch: u64,
) -> Result<Box<dyn Integration + 'o>, Error> {
    let Some(NoiseSettings { amplitude, every }) = computation.noise else { return Ok(orbit) };
    let normal = Normal::new(computation.seed, u64::MAX - stretch);
    Ok(Box::new(NoisyOrbit::new(orbit, Noise { amplitude, every, entries }, normal)?))
}

/// The norm of a finite state may overflow. Files hold no infinity: it becomes the largest number.
pub(crate) fn finite(outcome: Outcome) -> Outcome {
    match outcome {
        Outcome::Escaped { t, norm, singular, t_last } => {
            Outcome::Escaped { t, norm: norm.min(f64::MAX), singular, t_last }
        }
        other => other,
    }
}

/// A sink that records, reports progress and listens for the stop.
struct Watched<'w> {
    trajectory: Option<&'w mut Trajectory>,
    monitor: &'w dyn Monitor,
    start: f64,
    done: f64,
    total: f64,
    ticks: u32,
}

impl Sink for Watched<'_> {
    fn sample(&mut self, t: f64, u: &[f64]) {
        if let Some(trajectory) = &mut self.trajectory {
            trajectory.sample(t, u);
        }
    }

    fn crossing(&mut self, crossing: &Crossing<'_>) {
        if let Some(trajectory) = &mut self.trajectory {
            trajectory.crossing(crossing);
        }
    }

    fn tick(&mut self, t: f64) -> ControlFlow<()> {
        self.ticks = self.ticks.wrapping_add(1);
        if self.ticks.is_multiple_of(256) {
            self.monitor.progress((self.done + t - self.start) / self.total);
            if self.monitor.stopped() {
                return ControlFlow::Break(());
            }
        }
        ControlFlow::Continue(())
    }
}

/// The time average of the position with a smooth window that vanishes with all its derivatives at both ends: for a
/// periodic or quasi-periodic path it converges to the centre faster than any power of the time.
pub(crate) fn centre_of(path: impl Iterator<Item = (f64, [f64; 2])>, start: f64, end: f64) -> [f64; 2] {
    let (mut weight_sum, mut centre) = (0.0, [0.0; 2]);
    for (t, [x, y]) in path {
        let s = (t - start) / (end - start);
        let weight = if s > 0.0 && s < 1.0 { libm::exp(-1.0 / (s * (1.0 - s))) } else { 0.0 };
        weight_sum += weight;
        centre[0] += weight * x;
        centre[1] += weight * y;
    }
    if weight_sum > 0.0 { centre.map(|sum| sum / weight_sum) } else { [0.0; 2] }
}

/// The trajectory as a table, with what is read off it.
pub(crate) fn motion(model: &dyn Model, trajectory: &Trajectory, control: Control) -> Table {
    let atol = control.absolute_tolerance();
    let shape = ..model.dim();
    let rows = trajectory.len();
    let read = |of: &dyn Fn(&[f64]) -> f64| -> Vec<f64> { trajectory.iter().map(|(_, u)| of(u)).collect() };
    let mut table = Table::default();
    table.push("t", "model time", trajectory.times().to_vec());
    table.push("x", "position of the centre of mass (model length)", read(&|u| u[u.len() - 2]));
    table.push("y", "position of the centre of mass (model length)", read(&|u| u[u.len() - 1]));
    let mut coordinates = vec![Vec::with_capacity(rows); model.coordinates().len()];
    let mut observed = vec![Vec::with_capacity(rows); model.observables().len()];
    let mut measured = vec![Vec::with_capacity(rows); model.measures().len()];
    let (mut named, mut seen) = (vec![0.0; coordinates.len()], vec![0.0; observed.len()]);
    let mut boundary = vec![0.0; measured.len()];
    let (mut speed, mut turning) = (Vec::with_capacity(rows), Vec::with_capacity(rows));
    for (_, u) in trajectory.iter() {
        model.decode(&u[shape], &mut named);
        model.observe(&u[shape], &mut seen);
        model.measure(&u[shape], &mut boundary);
        let columns = coordinates.iter_mut().chain(&mut observed).chain(&mut measured);
        for (column, &value) in columns.zip(named.iter().chain(&seen).chain(&boundary)) {
            column.push(value);
        }
        let (size, rate) = pace(model, &u[shape], atol);
        speed.push(size);
        turning.push(rate);
    }
    for (coordinate, values) in model.coordinates().iter().zip(coordinates) {
        table.push(coordinate.name, coordinate.meaning, values);
    }
    table.push("speed", "|v| (model length per model time)", speed);
    table.push(
        "turning_rate",
        "d(heading)/dt (rad per model time); undefined where the body is at rest",
        turning,
    );
    for (observable, values) in model.observables().iter().zip(observed) {
        table.push(observable.name, observable.meaning, values);
    }
    for (measure, values) in model.measures().iter().zip(measured) {
        table.push(measure.name, measure.meaning, values);
    }
    table
}

/// Speed and turning rate of a shape; the latter is NaN at rest: below what a run with absolute tolerance `atol` resolves.
pub(crate) fn pace(model: &dyn Model, shape: &[f64], atol: f64) -> (f64, f64) {
    let (v, a) = velocity_and_acceleration(model, shape);
    let speed = libm::hypot(v[0], v[1]);
    let moves = speed > model.speed_resolution(shape, atol);
    (speed, turning_rate(v, a).filter(|_| moves).unwrap_or(f64::NAN))
}

/// The measures of a shape that are defined, by name.
pub(crate) fn measures(model: &dyn Model, shape: &[f64]) -> Named {
    let mut values = vec![0.0; model.measures().len()];
    model.measure(shape, &mut values);
    let names = model.measures().iter().map(|measure| measure.name.to_owned());
    Named(names.zip(values).filter(|entry| !entry.1.is_nan()).collect())
}

/// The crossings of the segment, in order.
fn crossings(trajectory: &Trajectory, map: &ReturnMapSettings) -> Table {
    let inside = |x: f64| map.x_min < x && x < map.x_max;
    let kept: Vec<_> = trajectory
        .crossings()
        .iter()
        .filter(|crossing| inside(crossing.state[crossing.state.len() - 2]))
        .collect();
    let mut table = Table::default();
    table.push("t", "time of the crossing", kept.iter().map(|c| c.t).collect());
    table.push(
        "x",
        "x where the path crosses the segment",
        kept.iter().map(|c| c.state[c.state.len() - 2]).collect(),
    );
    table.push(
        "y",
        "y of the segment, to round-off",
        kept.iter().map(|c| c.state[c.state.len() - 1]).collect(),
    );
    table.push(
        "rising",
        "1 where y grows, 0 where it falls",
        kept.iter().map(|c| f64::from(u8::from(c.rising))).collect(),
    );
    table
}
