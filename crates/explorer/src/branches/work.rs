//! The work of a job: branch by branch, each told as soon as it is there.

use super::{Job, Known, told};
use crate::answers::{Answers, Gone};
use crate::protocol::{BranchesBegun, FollowEnd, FollowProgress, Side};
use crate::worker::{Current, lock};
use motiform_branching::{Branches, follow};
use motiform_dynamics::Watch;
use motiform_study::branches::{Along, BranchSettings};
use motiform_study::{BranchPlan, Error};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Between two messages with the progress.
const EVERY: Duration = Duration::from_millis(120);

/// Most points of a branch to each side, and most branches of a job.
const MOST: (usize, u16) = (2000, 24);

/// Follows the branches of a job, unless it becomes stale.
pub(super) fn follow_all(
    job: &Job,
    known: &Mutex<Option<Known>>,
    current: &Current<'_>,
    answers: &Answers,
) -> Result<(), Gone> {
    let work = Work {
        job,
        known,
        current,
        answers,
        begun: Instant::now(),
        watch: Telling::new(job, current, answers),
    };
    match work.run() {
        Ok(done) => done,
        Err(error) => work.end(None, Some(error.to_string())),
    }
}

struct Work<'w> {
    job: &'w Job,
    known: &'w Mutex<Option<Known>>,
    current: &'w Current<'w>,
    answers: &'w Answers,
    begun: Instant,
    watch: Telling<'w>,
}

impl Work<'_> {
    fn run(&self) -> Result<Result<(), Gone>, Error> {
        let mut plan = plan(self.job)?;
        if let Err(gone) = self.answers.say(begun(self.job.follow.epoch, &plan)) {
            return Ok(Err(gone));
        }
        let mut before: Option<Branches> = None;
        for count in 1..=self.watch.total {
            let old = before.as_ref().map_or(0, |found| found.branches.len());
            plan.computation.branches = count;
            self.watch.count.store(count, Ordering::Relaxed);
            let found = follow(&plan, before, &self.watch)?;
            if self.watch.stopped() {
                return Ok(self.gone()); // the request that made it stale reports the end
            }
            if let Err(gone) = self.tell(&plan, &found, old) {
                return Ok(Err(gone));
            }
            let whole = found.left == 0;
            before = Some(found);
            if whole {
                break;
            }
        }
        Ok(self.end(before.as_ref(), None))
    }

    /// Keeps what was found, and sends what is new of it.
    fn tell(&self, plan: &BranchPlan, found: &Branches, old: usize) -> Result<(), Gone> {
        let mut known = lock(self.known);
        if self.current.stopped() {
            return Ok(());
        }
        let now =
            known.insert(Known { epoch: self.job.follow.epoch, plan: plan.clone(), found: found.clone() });
        let new: Vec<_> =
            (old..found.branches.len()).filter_map(|number| told::branch(now, number)).collect();
        let specials = told::specials(now);
        drop(known);
        for branch in new {
            self.answers.say(branch)?;
        }
        self.answers.say(specials)
    }

    fn end(&self, found: Option<&Branches>, why: Option<String>) -> Result<(), Gone> {
        if self.current.stopped() {
            return self.gone();
        }
        self.answers.say(FollowEnd {
            epoch: self.job.follow.epoch,
            branches: found.map_or(0, |found| found.branches.len()),
            left: found.map_or(0, |found| found.left),
            seconds: self.begun.elapsed().as_secs_f64(),
            why,
        })
    }

    fn gone(&self) -> Result<(), Gone> {
        if self.watch.gone.load(Ordering::Relaxed) { Err(Gone) } else { Ok(()) }
    }
}

/// The plan of a job: without noise, over a range that holds the body.
fn plan(job: &Job) -> Result<BranchPlan, Error> {
    let mut study = job.study.clone();
    study.run.silence();
    let Side { name, low, high } = job.follow.along.clone();
    let value = study.info()?.parameters().iter().position(|spec| spec.name == name);
    let value = value.and_then(|place| Some(*study.values().ok()?.get(place)?)).unwrap_or(low);
    let along = Along { name, from: low.min(value), to: high.max(value) };
    BranchPlan::new(&study, &BranchSettings { along, origin: None, points: MOST.0, branches: 1, samples: 0 })
}

fn begun(epoch: u32, plan: &BranchPlan) -> BranchesBegun {
    let c = &plan.computation;
    let along = Side { name: c.along.name.clone(), low: c.along.from, high: c.along.to };
    BranchesBegun { epoch, along, parameters: c.start.parameters.clone() }
}

/// Stops with the job, and tells how far it is.
struct Telling<'w> {
    epoch: u32,
    current: &'w Current<'w>,
    answers: &'w Answers,
    /// Branches that were asked for, and the one under way, from 1.
    total: usize,
    count: AtomicUsize,
    told: Mutex<Option<Instant>>,
    gone: AtomicBool,
}

impl<'w> Telling<'w> {
    fn new(job: &Job, current: &'w Current<'w>, answers: &'w Answers) -> Self {
        Self {
            epoch: job.follow.epoch,
            current,
            answers,
            total: usize::from(job.follow.branches.clamp(1, MOST.1)),
            count: AtomicUsize::new(1),
            told: Mutex::new(None),
            gone: AtomicBool::new(false),
        }
    }
}

impl Watch for Telling<'_> {
    fn stopped(&self) -> bool {
        self.gone.load(Ordering::Relaxed) || self.current.stopped()
    }

    /// A part of as many branches as there are so far: as a part of all.
    fn progress(&self, done: f64) {
        let mut told = lock(&self.told);
        if self.stopped() || told.is_some_and(|told| told.elapsed() < EVERY) {
            return;
        }
        *told = Some(Instant::now());
        let count = self.count.load(Ordering::Relaxed);
        let done = done * count as f64 / self.total as f64;
        if self.answers.say(FollowProgress { epoch: self.epoch, done, branch: count - 1 }).is_err() {
            self.gone.store(true, Ordering::Relaxed);
        }
    }
}
