//! Branches of the motion on the screen: followed along a parameter on a worker, and the orbit of any of their points.

mod orbit;
mod told;
mod work;

use crate::answers::{Answers, Gone};
use crate::protocol::{Follow, FollowEnd};
use crate::task::{Crew, Worker, lock};
use motiform_diagrams::{Branches, Sample};
use motiform_dynamics::Watch;
use motiform_study::{BranchPlan, Study};
pub(crate) use orbit::{OrbitJob, Path};
use serde::{Deserialize, Serialize};
use std::sync::{Arc, Mutex};
pub(crate) use work::Following;
use work::{Found, Job};

/// The branches so far.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct Known {
    epoch: u32,
    plan: BranchPlan,
    found: Branches,
}

/// A point of a branch, with the plan that it belongs to.
#[derive(Serialize, Deserialize)]
pub(crate) struct Spot {
    pub(crate) plan: BranchPlan,
    pub(crate) sample: Sample,
}

/// The branches of a session.
pub(crate) struct BranchService {
    pub(crate) worker: Worker<Following>,
    /// The orbit of a point, instead of the one before.
    pub(crate) orbits: Worker<Path>,
    heard: Arc<Heard>,
}

/// The branches known so far, and the page that receives them.
struct Heard {
    known: Mutex<Option<Known>>,
    answers: Answers,
}

impl BranchService {
    pub(crate) fn new(answers: &Answers, crew: &Crew) -> std::io::Result<Self> {
        let heard = Arc::new(Heard { known: Mutex::new(None), answers: answers.clone() });
        let shared = Arc::clone(&heard);
        let worker = Worker::new(crew, move |found, watch: &dyn Watch| shared.take(found, watch))?;
        Ok(Self { worker, orbits: Worker::telling(crew, answers)?, heard })
    }

    /// Follows the branches of the motion that a study settles on, instead of those before.
    pub(crate) fn follow(&self, follow: &Follow, study: &Study) -> Result<(), Gone> {
        self.forget();
        match work::plan(follow, study) {
            Ok(plan) => {
                self.worker.put(Job { epoch: follow.epoch, branches: follow.branches, plan });
                Ok(())
            }
            Err(error) => {
                let why = Some(error.to_string());
                let end = FollowEnd { epoch: follow.epoch, branches: 0, left: 0, seconds: 0.0, why };
                self.heard.answers.say(end)
            }
        }
    }

    /// Stops, and keeps what was found.
    pub(crate) fn stop(&self) {
        self.worker.clear();
    }

    /// Stops: the branches are those of another body.
    pub(crate) fn forget(&self) {
        self.stop();
        *lock(&self.heard.known) = None;
    }

    /// Returns `true` if branches are, or were, followed along this parameter.
    pub(crate) fn along(&self, name: &str) -> bool {
        lock(&self.heard.known).as_ref().is_some_and(|known| known.plan.computation.along.name == name)
    }

    /// A point of a branch; `None` if there is no such point, or the branches are others by now.
    pub(crate) fn spot(&self, epoch: u32, branch: usize, point: usize) -> Option<Spot> {
        let known = lock(&self.heard.known);
        let known = known.as_ref().filter(|known| known.epoch == epoch)?;
        let sample = known.found.branches.get(branch)?.samples().nth(point)?.clone();
        Some(Spot { plan: known.plan.clone(), sample })
    }
}

impl Heard {
    /// Keeps what was found, and sends what is new of it.
    fn take(&self, found: Found, watch: &dyn Watch) -> Result<(), Gone> {
        let (now, old) = match found {
            Found::Said { text } => return self.answers.text(text),
            Found::Branches { known, old } => (known, old),
        };
        let mut known = lock(&self.known);
        if watch.stopped() {
            return Ok(());
        }
        let now = known.insert(now);
        let new: Vec<_> =
            (old..now.found.branches.len()).filter_map(|number| told::branch(now, number)).collect();
        let specials = told::specials(now);
        drop(known);
        for branch in new {
            self.answers.say(branch)?;
        }
        self.answers.say(specials)
    }
}
