//! Orbits followed look by look until they blow up, are captured, or time is over.

use crate::analyse::settings_of;
use crate::captured::{LAST_LOOKS, captured, is_regular};
use crate::pool::Jobs;
use motiform_analysis::classify;
use motiform_analysis::regime::Settings;
use motiform_dynamics::drive::drive;
use motiform_dynamics::ensemble::Propagation;
use motiform_dynamics::simd::has_lanes;
use motiform_dynamics::{InPlane, Model, Outcome, Request, StepControl, StopOnly, Watch};
use motiform_kernels::{Kernel, Start, propagate_bodies};
use motiform_study::{Error, Scales, ScanPlan};
use serde::{Deserialize, Serialize};
use std::cell::RefCell;
use std::collections::BTreeMap;

/// The reason why an orbit was not followed any further.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) enum End {
    /// It blew up.
    BlewUp,
    /// It came close to a stable steady motion, whose slowest perturbation decays at this rate (inverse model time).
    Captured { rate: f64 },
    /// Time was over.
    Lasting,
    /// Time was over, and it moved regularly.
    Regular,
    /// The numerics could not go on.
    Lost,
}

/// An orbit that was followed, and for how long (model time).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Followed {
    pub(super) end: End,
    pub(super) time: f64,
}

/// Follows the orbits of a plan.
pub(super) struct Follower<'p> {
    plan: &'p ScanPlan,
    models: Vec<Box<dyn Model>>,
    looks: usize,
    look: f64,
    /// Size of a typical state of each model.
    sizes: Vec<f64>,
    settings: Settings,
    watch: &'p dyn Watch,
    /// The kernel of all orbits, whether or not this machine has lanes: with one, the position is integrated too.
    kernel: Option<Kernel>,
}

/// An orbit on its way: looks done, and its state then.
#[derive(Clone)]
struct Way {
    looks: usize,
    shape: Vec<f64>,
}

impl<'p> Follower<'p> {
    pub(super) fn new(plan: &'p ScanPlan, looks: usize, watch: &'p dyn Watch) -> Result<Self, Error> {
        let (info, c, look) = (plan.info()?, &plan.computation, plan.look_of(0)?);
        let models: Vec<_> = (0..plan.cells()).map(|cell| plan.model_of(cell)).collect::<Result<_, _>>()?;
        let bounds = (c.escape_norm, c.max_steps);
        let of = (info, &plan.parameters_of(0)?[..]);
        let settings = settings_of(of, plan.method()?, c.control, bounds, LAST_LOOKS * look);
        let sizes = (0..plan.cells())
            .map(|cell| Scales::typical(info, &plan.parameters_of(cell)?))
            .collect::<Result<_, Error>>()?;
        let adaptive = matches!(c.control.into(), StepControl::Adaptive { .. });
        let suited = c.stepper == "dop853" && adaptive;
        let kernel = suited.then(|| Kernel::of_all(models.iter().map(AsRef::as_ref))).flatten();
        Ok(Self { plan, models, looks, look, sizes, settings, watch, kernel })
    }

    /// Follows the orbits that a thread takes, in lanes where there are any.
    pub(super) fn run(&self, jobs: &Jobs<'_, Followed>) {
        let StepControl::Adaptive { rtol, atol } = self.settings.control else {
            return self.one_by_one(jobs);
        };
        let Some(kernel) = self.kernel.filter(|_| has_lanes()) else { return self.one_by_one(jobs) };
        let times = [self.look];
        let how = Propagation { times: &times, rtol, atol, escape_norm: self.settings.escape_norm };
        self.in_lanes(kernel, &how, jobs);
    }

    pub(super) fn one_by_one(&self, jobs: &Jobs<'_, Followed>) {
        jobs.each(|job| {
            let mut way = Way { looks: 0, shape: self.start(job)? };
            loop {
                if let Some(answer) = self.single(job, &mut way)? {
                    return Ok(answer);
                }
            }
        });
    }

    /// Each lane runs a look; what goes on enters again.
    fn in_lanes(&self, kernel: Kernel, how: &Propagation<'_>, jobs: &Jobs<'_, Followed>) {
        let on_the_way: RefCell<BTreeMap<usize, Way>> = RefCell::new(BTreeMap::new());
        let waiting: RefCell<Vec<usize>> = RefCell::new(Vec::new());
        let mut next = || {
            let key = waiting.borrow_mut().pop().or_else(|| self.enter(jobs, &on_the_way))?;
            let mut state = on_the_way.borrow().get(&key)?.shape.clone();
            state.extend([0.0, 0.0]);
            Some(Start { key, body: self.model(key), state })
        };
        let mut done = |key: usize, states: Option<Vec<&[f64]>>| {
            let Some(mut way) = on_the_way.borrow_mut().remove(&key) else { return };
            let found = match states.as_deref() {
                Some([.., state]) => self.arrived(key, &mut way, &state[..state.len() - 2]),
                _ => self.single(key, &mut way),
            };
            match found {
                Ok(None) => {
                    on_the_way.borrow_mut().insert(key, way);
                    waiting.borrow_mut().push(key);
                }
                Ok(Some(answer)) => jobs.done(key, Ok(answer)),
                Err(error) => jobs.done(key, Err(error)),
            }
        };
        propagate_bodies(kernel, how, &mut next, &mut done, self.watch);
    }

    /// Takes a job of which the start is sound.
    fn enter(&self, jobs: &Jobs<'_, Followed>, on_the_way: &RefCell<BTreeMap<usize, Way>>) -> Option<usize> {
        let job = jobs.next()?;
        match self.start(job) {
            Ok(shape) => {
                on_the_way.borrow_mut().insert(job, Way { looks: 0, shape });
                Some(job)
            }
            Err(error) => {
                jobs.done(job, Err(error));
                None
            }
        }
    }

    fn model(&self, job: usize) -> &dyn Model {
        self.models[job / self.plan.computation.samples].as_ref()
    }

    fn start(&self, job: usize) -> Result<Vec<f64>, Error> {
        let samples = self.plan.computation.samples;
        self.plan.start(job / samples, job % samples, self.model(job))
    }

    /// One look of a single orbit; `None` if it goes on, `Some(None)` if it was stopped.
    fn single(&self, job: usize, way: &mut Way) -> Result<Option<Option<Followed>>, Error> {
        let (model, method, control) = (self.model(job), self.settings.method, self.settings.control);
        let dim = way.shape.len();
        let mut state = way.shape.clone();
        let body = InPlane(model);
        let mut orbit = if self.kernel.is_some() {
            state.extend([0.0, 0.0]);
            method.orbit(&body, control, 0.0, &state)?
        } else {
            method.shape_orbit(model, control, 0.0, &state)?
        };
        let request = Request {
            max_steps: self.settings.max_steps,
            escape_norm: self.settings.escape_norm,
            watched: dim,
            watch: &StopOnly(self.watch),
            ..Request::until(self.look, state.len())
        };
        let outcome = drive(orbit.as_mut(), &request, &mut ())?;
        let time = way.looks as f64 * self.look + outcome.t();
        match outcome {
            Outcome::Completed { .. } => self.arrived(job, way, &orbit.state()[..dim]),
            Outcome::Interrupted { .. } => Ok(Some(None)),
            Outcome::Escaped { .. } => Ok(Some(Some(Followed { end: End::BlewUp, time }))),
            _ => Ok(Some(Some(Followed { end: End::Lost, time }))),
        }
    }

    /// After a look: captured, at the end, or `None` if it goes on.
    fn arrived(&self, job: usize, way: &mut Way, shape: &[f64]) -> Result<Option<Option<Followed>>, Error> {
        let model = self.model(job);
        way.looks += 1;
        way.shape.copy_from_slice(shape);
        let time = way.looks as f64 * self.look;
        if let Some(steady) = captured(model, shape, self.sizes[job / self.plan.computation.samples]) {
            let end = End::Captured { rate: -steady.growth() };
            return Ok(Some(Some(Followed { end, time: time - 0.5 * self.look }))); // at some moment of this look
        }
        if way.looks < self.looks {
            return Ok(None);
        }
        let Some(verdict) = classify(model, shape, &self.settings, &StopOnly(self.watch))? else {
            return Ok(Some(None));
        };
        let end = if is_regular(&verdict) { End::Regular } else { End::Lasting };
        Ok(Some(Some(Followed { end, time })))
    }
}
