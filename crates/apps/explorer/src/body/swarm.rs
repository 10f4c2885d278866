//! A swarm: further bodies beside the body, with its parameters, from many starts or under many noises; and the motion that each ends in.

use super::setting::Setting;
use crate::answers::{Answers, Gone, text};
use crate::frames::{self, Swimmer};
use crate::protocol::{Member, Swarm, SwarmStart};
use crate::task::{Crew, Task, Tell, Worker};
use motiform_analysis::regime::Regime;
use motiform_dynamics::{InPlane, Model, Normal, Outline, Watch};
use motiform_lab::analyse;
use motiform_lab::live::{Record, Stretch, start};
use motiform_lab::pool::{all_cores, on_threads};
use motiform_lab::scan::Row;
use motiform_study::plan::check;
use motiform_study::{Error, RunPlan};
use serde::{Deserialize, Serialize};
use std::cell::RefCell;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

/// Maximum number of bodies.
const MOST: u16 = 200;
/// Points of an outline of a swarm.
const POINTS: usize = 28;
/// Computing time of a picture of the whole swarm.
const PICTURE: Duration = Duration::from_millis(22);
/// Streams of noise of the swarm begin here; so many for each revision.
const STREAMS: (u64, u64) = (1 << 40, 256);

/// The data of a swarm that are kept from one change of the body to the next.
pub(super) struct Group {
    from: SwarmStart,
    /// Shape, then x and y.
    states: Vec<Vec<f64>>,
}

/// The swarm of a session.
pub(crate) struct Swarms {
    group: RefCell<Option<Group>>,
    pub(super) worker: Worker<Classification>,
}

/// Bodies to be classified; those that make no plan have no motion.
#[derive(Serialize, Deserialize)]
pub(crate) struct Job {
    revision: u32,
    plans: Vec<Option<RunPlan>>,
}

/// Classifies all bodies, on all cores. Its reports are messages to the page.
pub(crate) struct Classification;

impl Task for Classification {
    type Job = Job;
    type Report = String;

    const NAME: &'static str = "swarm";
    /// Pictures, and the name of the body itself, go first.
    const NICE: i32 = 6;

    fn run(job: Job, watch: &dyn Watch, tell: Tell<'_, String>) -> Result<(), Gone> {
        let next = AtomicUsize::new(0);
        let work = || {
            loop {
                let body = next.fetch_add(1, Ordering::Relaxed);
                let Some(plan) = job.plans.get(body) else { return };
                let regime = plan.as_ref().map_or(Some(Regime::Undetermined), |plan| regime(plan, watch));
                let told = regime.filter(|_| !watch.stopped()).map(|regime| {
                    let regime = regime.name();
                    tell(text(&Member { revision: job.revision, body, regime }.into()))
                });
                // A page that has gone takes its session along.
                if watch.stopped() || told.is_some_and(|told| told.is_err()) {
                    return;
                }
            }
        };
        on_threads(all_cores().min(job.plans.len()), work);
        Ok(())
    }
}

/// The motion that a body ends in; `None` if this was stopped.
fn regime(plan: &RunPlan, watch: &dyn Watch) -> Option<Regime> {
    Row::of_evaluation(0, 0, analyse::classify(plan, 0.0, watch)).map(|row| row.regime)
}

impl Swarms {
    pub(crate) fn new(answers: &Answers, crew: &Crew) -> std::io::Result<Self> {
        Ok(Self { group: RefCell::new(None), worker: Worker::telling(crew, answers)? })
    }

    /// Returns `true` if there is one that goes on after a change.
    pub(super) fn goes_on(&self) -> bool {
        self.group.borrow().is_some()
    }

    /// A swarm in these states.
    #[cfg(test)]
    pub(super) fn hold(&self, states: Vec<Vec<f64>>) {
        self.group.replace(Some(Group { from: SwarmStart::Near, states }));
    }

    /// There is no swarm any more.
    pub(super) fn end(&self) {
        self.worker.clear();
        self.group.replace(None);
    }
}

/// A swarm in motion.
pub(super) struct Swimmers<'s> {
    from: SwarmStart,
    members: Vec<Stretch<'s>>,
    /// Nothing of their motion is kept.
    record: Record,
}

impl<'s> Swimmers<'s> {
    /// Begins a swarm; `None` for one without bodies.
    pub(super) fn begin(
        wish: Swarm,
        setting: &'s Setting,
        body: &'s InPlane<&'s dyn Model>,
        (t, state): (f64, &[f64]),
        swarms: &Swarms,
    ) -> Result<Option<Self>, Error> {
        swarms.end();
        if wish.bodies == 0 {
            return Ok(None);
        }
        let bodies = f64::from(wish.bodies);
        check("bodies", bodies, wish.bodies <= MOST, "a swarm has at most 200 bodies")?;
        let remedy = "bodies that begin near each other are up to the size of the shape apart: give 0 to 1";
        check("spread", wish.spread, (0.0..=1.0).contains(&wish.spread), remedy)?;
        let states: Result<_, Error> = (0..wish.bodies).map(|k| begins(wish, k, setting, state)).collect();
        swarms.group.replace(Some(Group { from: wish.from, states: states? }));
        Self::again(setting, body, t, swarms).inspect_err(|_| swarms.end())
    }

    /// Goes on with the swarm that there was before a change of the body, if there is one and its shapes are those of the model.
    pub(super) fn again(
        setting: &'s Setting,
        body: &'s InPlane<&'s dyn Model>,
        t: f64,
        swarms: &Swarms,
    ) -> Result<Option<Self>, Error> {
        let group = swarms.group.borrow();
        let Some(Group { from, states }) = group.as_ref() else { return Ok(None) };
        let (model, plan) = (setting.model(), setting.plan());
        if states.iter().any(|state| state.len() != model.dim() + 2) {
            return Ok(None);
        }
        let stream = STREAMS.0 + STREAMS.1 * u64::from(setting.revision());
        let numbered = states.iter().zip(stream..);
        let members: Result<_, Error> =
            numbered.map(|(state, number)| Stretch::new(plan, body, t, state, number)).collect();
        if *from == SwarmStart::Starts {
            let plan = |state: &Vec<f64>| {
                let mut study = setting.study_at(state);
                study.run.silence();
                RunPlan::new(&study).ok()
            };
            let plans = states.iter().map(plan).collect();
            swarms.worker.put(Job { revision: setting.revision(), plans });
        }
        let record = Record::new(model, &plan.computation, 2);
        Ok(Some(Self { from: *from, members: members?, record }))
    }

    /// Keeps the states for the body after the next change.
    pub(super) fn keep(&self, swarms: &Swarms) {
        let states = self.members.iter().map(|member| member.state().to_vec()).collect();
        swarms.group.replace(Some(Group { from: self.from, states }));
    }

    /// Advances all to this time, as far as there is time for it.
    pub(super) fn advance(&mut self, to: f64, model: &dyn Model) {
        let each = PICTURE / u32::try_from(self.members.len().max(1)).unwrap_or(1);
        for member in &mut self.members {
            member.advance(to, each, &mut self.record, model);
        }
    }

    /// The binary message; `state` is that of the body.
    pub(super) fn encode(&self, setting: &Setting, t: f64, state: &[f64], radius: f64) -> Vec<u8> {
        let model = setting.model();
        let dim = model.dim();
        let swimmer = |member: &Stretch<'_>| {
            let (shape, position) = member.state().split_at(dim);
            let outline = match model.outline(shape, radius, POINTS) {
                Outline::Curve(points) => points,
                _ => Vec::new(),
            };
            let squares = shape.iter().zip(state).map(|(a, b)| (a - b) * (a - b));
            Swimmer { position: [position[0], position[1]], distance: squares.sum::<f64>().sqrt(), outline }
        };
        let swimmers: Vec<Swimmer> = self.members.iter().map(swimmer).collect();
        frames::swarm(setting.revision(), t, POINTS, &swimmers)
    }
}

/// The state that a body of the swarm begins in: at the place of the body.
fn begins(wish: Swarm, k: u16, setting: &Setting, state: &[f64]) -> Result<Vec<f64>, Error> {
    let dim = setting.model().dim();
    let mut begun = state.to_vec();
    match wish.from {
        SwarmStart::Noises => {}
        SwarmStart::Near => {
            let mut normal = Normal::new(setting.study().run.seed, (2 << 40) + u64::from(k));
            let direction: Vec<f64> = (0..dim).map(|_| normal.next()).collect();
            let norm = |u: &[f64]| u.iter().map(|x| x * x).sum::<f64>().sqrt();
            let part = wish.spread * norm(&state[..dim]) / norm(&direction).max(f64::MIN_POSITIVE);
            begun.iter_mut().zip(direction).for_each(|(entry, d)| *entry += part * d);
        }
        SwarmStart::Starts => {
            let mut study = setting.study().clone();
            study.initial.clear();
            study.random = None;
            study.random = Some(study.starts(2)?);
            study.run.transient = 0.0;
            study.run.seed = u64::from(k) + 1;
            let random = start(&RunPlan::new(&study)?, setting.model());
            begun[..dim].copy_from_slice(&random[..dim]);
        }
    }
    Ok(begun)
}
