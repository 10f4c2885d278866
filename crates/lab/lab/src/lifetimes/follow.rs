//! Orbits followed look by look until they blow up, are captured, or time is over.

use super::Looks;
use crate::analyse::settings_of;
use crate::captured::{LAST_LOOKS, captured, is_regular};
use crate::pool::Jobs;
use motiform_analysis::classify;
use motiform_analysis::regime::Settings;
use motiform_dynamics::drive::drive;
use motiform_dynamics::ensemble::Propagation;
use motiform_dynamics::simd::{InstructionSet, has_lanes};
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
    /// One for each value of the axis.
    bodies: Vec<Followable>,
    watch: &'p dyn Watch,
    /// The kernel of all orbits, whether or not this machine has lanes: with one, the position is integrated too.
    kernel: Option<Kernel>,
}

/// A body whose orbits are followed.
struct Followable {
    model: Box<dyn Model>,
    /// Size of a typical state.
    size: f64,
    /// The looks of an orbit, and the time of each.
    looks: Looks,
    settings: Settings,
}

/// An orbit on its way: looks done, and its state then.
#[derive(Clone)]
struct Way {
    looks: usize,
    shape: Vec<f64>,
}

impl Followable {
    fn new(plan: &ScanPlan, cell: usize) -> Result<Self, Error> {
        let (info, c, values) = (plan.info()?, &plan.computation, plan.parameters_of(cell)?);
        let looks = Looks::of(plan, cell)?;
        let budget = LAST_LOOKS * looks.time;
        let settings =
            settings_of(info, &values, plan.method()?, c.control, c.escape_norm, c.max_steps, budget);
        Ok(Self { model: plan.model_of(cell)?, size: Scales::typical(info, &values)?, looks, settings })
    }
}

impl<'p> Follower<'p> {
    pub(super) fn new(plan: &'p ScanPlan, watch: &'p dyn Watch) -> Result<Self, Error> {
        let bodies: Vec<_> =
            (0..plan.cells()).map(|cell| Followable::new(plan, cell)).collect::<Result<_, _>>()?;
        let c = &plan.computation;
        let suited = c.stepper == "dop853" && matches!(c.control.into(), StepControl::Adaptive { .. });
        let kernel = suited.then(|| Kernel::of_all(bodies.iter().map(|body| body.model.as_ref()))).flatten();
        Ok(Self { plan, bodies, watch, kernel })
    }

    /// Follows the orbits that a thread takes, in lanes where there are any.
    pub(super) fn run(&self, jobs: &Jobs<'_, Followed>) {
        let kernel = self.kernel.filter(|_| has_lanes());
        let (Some(kernel), StepControl::Adaptive { rtol, atol }) =
            (kernel, self.plan.computation.control.into())
        else {
            return self.one_by_one(jobs);
        };
        let mut first = jobs.next();
        while let Some(job) = first.filter(|_| !self.watch.stopped()) {
            let times = [self.body(job).looks.time];
            let how = Propagation {
                times: &times,
                rtol,
                atol,
                escape_norm: self.plan.computation.escape_norm,
                set: InstructionSet::widest(),
            };
            first = self.in_lanes(kernel, &how, job, jobs);
        }
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

    /// Each lane runs a look; what goes on enters again. Returns the next job, which has looks of another duration.
    fn in_lanes(
        &self,
        kernel: Kernel,
        how: &Propagation<'_>,
        first: usize,
        jobs: &Jobs<'_, Followed>,
    ) -> Option<usize> {
        let on_the_way: RefCell<BTreeMap<usize, Way>> = RefCell::new(BTreeMap::new());
        let waiting: RefCell<Vec<usize>> = RefCell::new(Vec::new());
        let mut following = Some(first);
        let mut next = || {
            let mut enter = || {
                let job = following.filter(|job| [self.body(*job).looks.time] == how.times)?;
                following = jobs.next();
                self.enter(job, jobs, &on_the_way)
            };
            let key = waiting.borrow_mut().pop().or_else(&mut enter)?;
            let mut state = on_the_way.borrow().get(&key)?.shape.clone();
            state.extend([0.0, 0.0]);
            Some(Start { key, body: self.body(key).model.as_ref(), state })
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
        following
    }

    /// Takes a job if its start is sound.
    fn enter(
        &self,
        job: usize,
        jobs: &Jobs<'_, Followed>,
        on_the_way: &RefCell<BTreeMap<usize, Way>>,
    ) -> Option<usize> {
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

    fn body(&self, job: usize) -> &Followable {
        &self.bodies[job / self.plan.computation.samples]
    }

    fn start(&self, job: usize) -> Result<Vec<f64>, Error> {
        let samples = self.plan.computation.samples;
        self.plan.start(job / samples, job % samples, self.body(job).model.as_ref())
    }

    /// One look of a single orbit; `None` if it goes on, `Some(None)` if it was stopped.
    fn single(&self, job: usize, way: &mut Way) -> Result<Option<Option<Followed>>, Error> {
        let Followable { model, looks, settings, .. } = self.body(job);
        let dim = way.shape.len();
        let mut state = way.shape.clone();
        let body = InPlane(model.as_ref());
        let mut orbit = if self.kernel.is_some() {
            state.extend([0.0, 0.0]);
            settings.method.orbit(&body, settings.control, 0.0, &state)?
        } else {
            settings.method.shape_orbit(model.as_ref(), settings.control, 0.0, &state)?
        };
        let request = Request {
            max_steps: settings.max_steps,
            escape_norm: settings.escape_norm,
            watched: dim,
            watch: &StopOnly(self.watch),
            ..Request::until(looks.time, state.len())
        };
        let outcome = drive(orbit.as_mut(), &request, &mut ())?;
        let time = way.looks as f64 * looks.time + outcome.t();
        match outcome {
            Outcome::Completed { .. } => self.arrived(job, way, &orbit.state()[..dim]),
            Outcome::Interrupted { .. } => Ok(Some(None)),
            Outcome::Escaped { .. } => Ok(Some(Some(Followed { end: End::BlewUp, time }))),
            _ => Ok(Some(Some(Followed { end: End::Lost, time }))),
        }
    }

    /// After a look: captured, at the end, or `None` if it goes on.
    fn arrived(&self, job: usize, way: &mut Way, shape: &[f64]) -> Result<Option<Option<Followed>>, Error> {
        let Followable { model, size, looks, settings } = self.body(job);
        way.looks += 1;
        way.shape.copy_from_slice(shape);
        let time = way.looks as f64 * looks.time;
        if let Some(steady) = captured(model.as_ref(), shape, *size) {
            let end = End::Captured { rate: -steady.growth() };
            return Ok(Some(Some(Followed { end, time: time - 0.5 * looks.time }))); // at some moment of this look
        }
        if way.looks < looks.count {
            return Ok(None);
        }
        let Some(verdict) = classify(model.as_ref(), shape, settings, &StopOnly(self.watch))? else {
            return Ok(Some(None));
        };
        let end = if is_regular(&verdict) { End::Regular } else { End::Lasting };
        Ok(Some(Some(Followed { end, time })))
    }
}
