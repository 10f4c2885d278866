//! Computation of a window on threads: coarse cells first, from the centre outwards, on all cores.

use super::map_state::MapState;
use super::telling::Telling;
use super::view::{View, told};
use super::{Done, Job};
use crate::answers::{Answers, Gone};
use crate::frames::Cell;
use crate::task::lock;
use crate::task::thread::Current;
use motiform_analysis::regime::Verdict;
use motiform_dynamics::Watch;
use motiform_lab::pool::{all_cores, on_threads};
use motiform_lab::scan::{Classify, Evaluate, Row};
use motiform_study::Error;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

/// Computes the missing cells of the window of a job, unless it becomes stale.
pub(super) fn compute(
    job: &Job,
    map_state: &Mutex<MapState>,
    current: &Current<'_>,
    answers: &Answers,
) -> Done {
    let Some(view) = super::turn(job, map_state, answers)? else { return Ok(()) };
    let work = Shared {
        view: &view,
        map_state,
        current,
        answers,
        gone: AtomicBool::new(false),
        next: Mutex::new(view.wanted.iter()),
        telling: Mutex::new(Telling::new(view.known.len())),
    };
    on_threads(all_cores().min(view.wanted.len()), || work.run());
    work.finish()
}

/// The data that the threads share.
struct Shared<'w> {
    view: &'w View,
    map_state: &'w Mutex<MapState>,
    current: &'w Current<'w>,
    answers: &'w Answers,
    gone: AtomicBool,
    next: Mutex<std::slice::Iter<'w, Cell>>,
    telling: Mutex<Telling>,
}

impl Shared<'_> {
    /// One thread: cells until none is left.
    fn run(&self) {
        // The cells under way, by their number in the plan.
        let taken = std::cell::RefCell::new(std::collections::BTreeMap::new());
        let mut next = || {
            let cell = *lock(&self.next).next().filter(|_| !self.stopped())?;
            let number = self.view.number(&cell);
            taken.borrow_mut().insert(number, cell);
            Some((number, 0))
        };
        let mut done = |(number, _): (usize, usize), verdict: Result<Option<Verdict>, Error>| {
            let Some(cell) = taken.borrow_mut().remove(&number) else { return };
            if self.put(cell, number, verdict).is_err() {
                self.gone.store(true, Ordering::Relaxed);
            }
        };
        Classify.evaluate_all(&self.view.plan, &mut next, &mut done, self);
    }

    fn put(&self, cell: Cell, number: usize, verdict: Result<Option<Verdict>, Error>) -> Done {
        let Some(row) = Row::of_evaluation(number, 0, verdict) else { return Ok(()) };
        let cell = told(cell, &row);
        lock(self.map_state).store.put(&self.view.plan.axis_values(number), row);
        lock(&self.telling).add(cell, self.view, self.answers)
    }

    /// Sends the remaining cells, and the message of completion if the map is complete.
    fn finish(self) -> Done {
        let stopped = self.stopped();
        if self.gone.into_inner() {
            return Err(Gone);
        }
        if stopped {
            return Ok(()); // the request that made it stale reports the end
        }
        let telling = self.telling.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
        telling.finish(self.view.epoch, self.answers)
    }
}

impl Watch for Shared<'_> {
    fn stopped(&self) -> bool {
        self.gone.load(Ordering::Relaxed) || self.current.stopped()
    }
}
