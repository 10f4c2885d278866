//! Branches of the motion on the screen: followed along a parameter on a worker, and the orbit of any of their points.

mod orbit;
mod told;
mod work;

use crate::answers::Answers;
use crate::protocol::Follow;
use crate::worker::{Worker, lock};
use motiform_branching::{Branches, Sample};
use motiform_study::{BranchPlan, Study};
pub(crate) use orbit::OrbitJob;
use std::sync::{Arc, Mutex};

/// The reader asked for them: they go before the map.
const NICE: i32 = 5;

/// The orbit of a point that was clicked is waited for.
const SOON: i32 = 3;

/// What to follow: the motion that a study settles on.
pub(crate) struct Job {
    pub(crate) follow: Follow,
    pub(crate) study: Study,
}

/// The branches so far.
struct Known {
    epoch: u32,
    plan: BranchPlan,
    found: Branches,
}

/// A point of a branch, with the plan that it belongs to.
pub(crate) struct Spot {
    pub(crate) plan: BranchPlan,
    pub(crate) sample: Sample,
}

/// The branches of a session.
pub(crate) struct BranchService {
    worker: Worker<Job>,
    orbits: Worker<OrbitJob>,
    known: Arc<Mutex<Option<Known>>>,
}

impl BranchService {
    pub(crate) fn new(answers: &Answers) -> std::io::Result<Self> {
        let known = Arc::new(Mutex::new(None));
        let (shared, told) = (Arc::clone(&known), answers.clone());
        let worker = Worker::new("branches", NICE, move |job: Job, current| {
            // A page that has gone takes its session along.
            let _ = work::follow_all(&job, &shared, current, &told);
        })?;
        let told = answers.clone();
        let orbits = Worker::new("orbit", SOON, move |job: OrbitJob, current| {
            let _ = orbit::tell(&job, current, &told);
        })?;
        Ok(Self { worker, orbits, known })
    }

    /// Follows the branches of another motion, instead of those before.
    pub(crate) fn follow(&self, job: Job) {
        self.forget();
        self.worker.put(job);
    }

    /// Stops, and keeps what was found.
    pub(crate) fn stop(&self) {
        self.worker.clear();
    }

    /// Stops: the branches are those of another body.
    pub(crate) fn forget(&self) {
        self.stop();
        *lock(&self.known) = None;
    }

    /// Whether branches are, or were, followed along this parameter.
    pub(crate) fn along(&self, name: &str) -> bool {
        lock(&self.known).as_ref().is_some_and(|known| known.plan.computation.along.name == name)
    }

    /// A point of a branch; `None` if there is no such point, or the branches are others by now.
    pub(crate) fn spot(&self, epoch: u32, branch: usize, point: usize) -> Option<Spot> {
        let known = lock(&self.known);
        let known = known.as_ref().filter(|known| known.epoch == epoch)?;
        let sample = known.found.branches.get(branch)?.samples().nth(point)?.clone();
        Some(Spot { plan: known.plan.clone(), sample })
    }

    /// Computes the orbit of a point, instead of the one before.
    pub(crate) fn orbit(&self, job: OrbitJob) {
        self.orbits.put(job);
    }
}
