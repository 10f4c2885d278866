//! The work of a job: branch by branch, each told as soon as it is there.

use super::Known;
use crate::answers::{Gone, text};
use crate::protocol::{BranchesBegun, Follow, FollowEnd, FollowProgress, Said, Side};
use crate::task::{Task, Tell, lock};
use motiform_diagrams::{Branches, follow};
use motiform_dynamics::Watch;
use motiform_lab::clock::Moment;
use motiform_study::branches::{Along, BranchSettings};
use motiform_study::plan::check;
use motiform_study::{BranchPlan, Error, Study};
use serde::{Deserialize, Serialize};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

/// Between two messages with the progress.
const EVERY: Duration = Duration::from_millis(120);

/// Most points of a branch to each side, and most branches of a job.
const MOST: (usize, u16) = (2000, 24);

/// The task: to follow branches from the motion that the start of a plan settles on, at most so many.
#[derive(Serialize, Deserialize)]
pub(crate) struct Job {
    pub(super) epoch: u32,
    pub(super) branches: u16,
    pub(super) plan: BranchPlan,
}

#[allow(clippy::large_enum_variant, reason = "what is found: few at a time")]
#[derive(Serialize, Deserialize)]
pub(crate) enum Found {
    /// A message to the page.
    Said { text: String },
    /// All branches so far; those from `old` on are new.
    Branches { known: Known, old: usize },
}

/// Follows branches.
pub(crate) struct Following;

impl Task for Following {
    type Job = Job;
    type Report = Found;

    const NAME: &'static str = "branches";
    /// The reader asked for them: they go before the map.
    const NICE: i32 = 5;

    fn run(job: Job, watch: &dyn Watch, tell: Tell<'_, Found>) -> Result<(), Gone> {
        FollowingJob { job: &job, begun: Moment::now(), watch: Telling::new(&job, watch, tell) }.run()
    }
}

struct FollowingJob<'w> {
    job: &'w Job,
    begun: Moment,
    watch: Telling<'w>,
}

impl FollowingJob<'_> {
    fn run(&self) -> Result<(), Gone> {
        let mut plan = self.job.plan.clone();
        self.watch.say(begun(self.job.epoch, &plan))?;
        let mut before: Option<Branches> = None;
        for count in 1..=self.watch.total {
            let old = before.as_ref().map_or(0, |found| found.branches.len());
            plan.computation.branches = count;
            self.watch.count.store(count, Ordering::Relaxed);
            let found = match follow(&plan, before, &self.watch) {
                Ok(found) => found,
                Err(error) => return self.end(None, Some(error.to_string())),
            };
            if self.watch.stopped() {
                return self.gone(); // the request that made it stale reports the end
            }
            let known = Known { epoch: self.job.epoch, plan: plan.clone(), found: found.clone() };
            (self.watch.tell)(Found::Branches { known, old })?;
            let whole = found.left == 0;
            before = Some(found);
            if whole {
                break;
            }
        }
        self.end(before.as_ref(), None)
    }

    fn end(&self, found: Option<&Branches>, why: Option<String>) -> Result<(), Gone> {
        if self.watch.stopped() {
            return self.gone();
        }
        self.watch.say(FollowEnd {
            epoch: self.job.epoch,
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

/// The plan of a wish: without noise, over a range that holds the body.
pub(super) fn plan(follow: &Follow, study: &Study) -> Result<BranchPlan, Error> {
    let mut study = study.clone();
    study.run.silence();
    let Side { name, low, high } = follow.along.clone();
    let value = study.info()?.parameters().iter().position(|spec| spec.name == name);
    let value = value.and_then(|place| Some(*study.values().ok()?.get(place)?)).unwrap_or(low);
    let branches = f64::from(follow.branches);
    check("branches", branches, (1..=MOST.1).contains(&follow.branches), "give 1 to 24 branches")?;
    // a range that does not rise is refused as it is
    let (from, to) = if low < high { (low.min(value), high.max(value)) } else { (low, high) };
    let along = Along { name, from, to };
    BranchPlan::new(&study, &BranchSettings { points: MOST.0, branches: 1, ..BranchSettings::over(along) })
}

fn begun(epoch: u32, plan: &BranchPlan) -> BranchesBegun {
    let c = &plan.computation;
    let along = Side { name: c.along.name.clone(), low: c.along.from, high: c.along.to };
    BranchesBegun { epoch, along, parameters: c.start.parameters.clone() }
}

/// Stops with the job, and tells how far it is.
struct Telling<'w> {
    epoch: u32,
    watch: &'w dyn Watch,
    tell: Tell<'w, Found>,
    /// Branches that were asked for, and the one under way, from 1.
    total: usize,
    count: AtomicUsize,
    told: Mutex<Option<Moment>>,
    gone: AtomicBool,
}

impl<'w> Telling<'w> {
    fn new(job: &Job, watch: &'w dyn Watch, tell: Tell<'w, Found>) -> Self {
        Self {
            epoch: job.epoch,
            watch,
            tell,
            total: usize::from(job.branches),
            count: AtomicUsize::new(1),
            told: Mutex::new(None),
            gone: AtomicBool::new(false),
        }
    }

    fn say(&self, said: impl Into<Said>) -> Result<(), Gone> {
        (self.tell)(Found::Said { text: text(&said.into()) })
    }
}

impl Watch for Telling<'_> {
    fn stopped(&self) -> bool {
        self.gone.load(Ordering::Relaxed) || self.watch.stopped()
    }

    /// A part of as many branches as there are so far: as a part of all.
    fn progress(&self, done: f64) {
        let mut told = lock(&self.told);
        if self.stopped() || told.is_some_and(|told| told.elapsed() < EVERY) {
            return;
        }
        *told = Some(Moment::now());
        let count = self.count.load(Ordering::Relaxed);
        let done = done * count as f64 / self.total as f64;
        if self.say(FollowProgress { epoch: self.epoch, done, branch: count - 1 }).is_err() {
            self.gone.store(true, Ordering::Relaxed);
        }
    }
}
