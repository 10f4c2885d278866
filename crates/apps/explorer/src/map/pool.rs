//! Computation of a window by helpers: each gets some cells at a time, and reports each of them.

use super::map_state::MapState;
use super::telling::Telling;
use super::view::{View, told};
use super::{Done, Job};
use crate::answers::{Answers, Gone};
use crate::frames::Cell;
use crate::task::{Errand, Post, Task, Tell, lock};
use motiform_analysis::regime::{Attractor, Course, Regime, Verdict};
use motiform_dynamics::Watch;
use motiform_lab::scan::{Classify, Evaluate, NUMBERS, Row};
use motiform_study::{Error, ScanPlan};
use serde::{Deserialize, Serialize};
use std::cell::{Cell as Slot, RefCell};
use std::collections::BTreeMap;
use std::sync::Mutex;

/// Fewest and most cells of a batch. The first ones are small, so that a coarse picture is there soon.
const BATCH: (usize, usize) = (8, 64);

/// Classifies the motions of cells.
pub(crate) struct Cells;

/// Some cells of a plan, by their numbers.
#[derive(Serialize, Deserialize)]
pub(crate) struct Batch {
    plan: ScanPlan,
    cells: Vec<usize>,
}

/// A row as a text carries it: numbers as bits, since some are not finite.
#[derive(Serialize, Deserialize)]
pub(crate) struct Found {
    cell: usize,
    regime: Regime,
    attractor: Attractor,
    course: Option<Course>,
    numbers: Vec<u64>,
    why: String,
}

impl From<Row> for Found {
    fn from(row: Row) -> Self {
        let numbers = row.numbers.iter().map(|number| number.to_bits()).collect();
        let Row { cell, regime, attractor, course, why, .. } = row;
        Self { cell, regime, attractor, course, numbers, why }
    }
}

impl Found {
    fn row(self) -> Row {
        let Self { cell, regime, attractor, course, why, .. } = self;
        let mut numbers = [f64::NAN; NUMBERS.len()];
        for (number, bits) in numbers.iter_mut().zip(self.numbers) {
            *number = f64::from_bits(bits);
        }
        Row { cell, sample: 0, regime, attractor, course, numbers, why }
    }
}

impl Task for Cells {
    type Job = Batch;
    type Report = Found;

    const NAME: &'static str = "map";
    /// Frames and classification have precedence.
    const NICE: i32 = 10;

    fn run(job: Batch, watch: &dyn Watch, tell: Tell<'_, Found>) -> Result<(), Gone> {
        let mut cells = job.cells.iter();
        let mut next = || cells.next().map(|&cell| (cell, 0));
        let mut gone = Ok(());
        let mut done = |(cell, _): (usize, usize), verdict: Result<Option<Verdict>, Error>| {
            if let (Ok(()), Some(row)) = (gone, Row::of_evaluation(cell, 0, verdict)) {
                gone = tell(row.into());
            }
        };
        Classify.evaluate_all(&job.plan, &mut next, &mut done, watch);
        gone
    }
}

/// The helpers of the map, and the window that they compute.
pub(super) struct Pool {
    post: Post,
    helpers: usize,
    order: Slot<u64>,
    /// The window, as long as something of it is missing.
    window: RefCell<Option<Window>>,
}

struct Window {
    view: View,
    /// Number of the cells that were handed out.
    taken: usize,
    /// Cells under way, by their number in the plan.
    under_way: BTreeMap<usize, Cell>,
    /// `true` for each helper that has work.
    busy: Vec<bool>,
    telling: Telling,
}

impl Pool {
    pub(super) fn new(post: Post, helpers: usize) -> Self {
        Self { post, helpers: helpers.max(1), order: Slot::new(0), window: RefCell::new(None) }
    }

    /// Computes a window, replacing the one in progress.
    pub(super) fn show(&self, job: &Job, map_state: &Mutex<MapState>, answers: &Answers) -> Done {
        self.stop();
        let Some(view) = super::turn(job, map_state, answers)? else { return Ok(()) };
        let telling = Telling::new(view.known.len());
        let busy = vec![false; self.helpers];
        let window = Window { view, taken: 0, under_way: BTreeMap::new(), busy, telling };
        self.window.replace(Some(window));
        (0..self.helpers).for_each(|helper| self.employ(helper));
        self.finish(answers)
    }

    /// Stops computing.
    pub(super) fn stop(&self) {
        self.order.set(self.order.get() + 1);
        let Some(window) = self.window.take() else { return };
        for (helper, _) in window.busy.iter().enumerate().filter(|entry| *entry.1) {
            self.post.clear(&name(helper), self.order.get());
        }
    }

    /// Gives a helper its next cells, if there are any.
    fn employ(&self, helper: usize) {
        let mut window = self.window.borrow_mut();
        let Some(window) = window.as_mut() else { return };
        let left = window.view.wanted.get(window.taken..).unwrap_or_default();
        let count = (window.taken / (4 * self.helpers)).clamp(BATCH.0, BATCH.1).min(left.len());
        window.busy[helper] = count > 0;
        if count == 0 {
            return;
        }
        let some = left[..count].iter().map(|cell| (window.view.number(cell), *cell));
        let cells = some.clone().map(|entry| entry.0).collect();
        window.under_way.extend(some);
        window.taken += count;
        let batch = Batch { plan: window.view.plan.clone(), cells };
        self.post.job(&name(helper), self.order.get(), &batch);
    }

    /// Takes a cell that a helper computed, or that it is free.
    pub(super) fn report(&self, errand: &Errand<'_>, map_state: &Mutex<MapState>, answers: &Answers) -> Done {
        let helper = errand.to.strip_prefix(Cells::NAME).and_then(|number| number.parse().ok());
        let Some(helper) = helper.filter(|&helper| helper < self.helpers) else { return Ok(()) };
        if errand.order != self.order.get() {
            return Ok(());
        }
        if errand.json.is_empty() {
            self.employ(helper);
            return self.finish(answers);
        }
        match (errand.read::<Found>(), self.window.borrow_mut().as_mut()) {
            (Some(found), Some(window)) => window.put(found.row(), map_state, answers),
            _ => Ok(()),
        }
    }

    /// Says that the map is complete, if it is.
    fn finish(&self, answers: &Answers) -> Done {
        let complete = self.window.borrow().as_ref().is_some_and(|window| !window.busy.contains(&true));
        match self.window.borrow_mut().take_if(|_| complete) {
            Some(window) => window.telling.finish(window.view.epoch, answers),
            None => Ok(()),
        }
    }
}

impl Window {
    fn put(&mut self, row: Row, map_state: &Mutex<MapState>, answers: &Answers) -> Done {
        let Some(cell) = self.under_way.remove(&row.cell) else { return Ok(()) };
        let cell = told(cell, &row);
        lock(map_state).store.put(&self.view.plan.axis_values(row.cell), row);
        self.telling.add(cell, &self.view, answers)
    }
}

fn name(helper: usize) -> String {
    format!("{}{helper}", Cells::NAME)
}
