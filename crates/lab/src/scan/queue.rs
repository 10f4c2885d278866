//! Who computes which row next.
//!
//! Rows are handed out in order, one at a time: a slow row holds up one thread, while the others go on with the rows
//! behind it, in the next parts where need be. A part is under way only while some thread holds one of its rows, so at
//! most one part per thread (and the one being handed out) is in memory.

use super::{Row, ScanPlan};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The rows still to be handed out.
pub(super) struct Queue<'q> {
    plan: &'q ScanPlan,
    parts: Box<dyn Iterator<Item = usize> + Send + 'q>,
    open: Option<(Arc<Pending>, usize)>,
}

/// A part of which some rows are missing.
pub(super) struct Pending {
    pub(super) part: usize,
    first_cell: usize,
    samples: usize,
    rows: usize,
    done: Mutex<(Vec<Option<Row>>, usize)>,
}

/// One row to compute.
pub(super) struct Job {
    pub(super) pending: Arc<Pending>,
    pub(super) cell: usize,
    pub(super) sample: usize,
    place: usize,
}

impl<'q> Queue<'q> {
    pub(super) fn new(plan: &'q ScanPlan, parts: impl Iterator<Item = usize> + Send + 'q) -> Self {
        Self { plan, parts: Box::new(parts), open: None }
    }

    /// The next row, if any is left.
    pub(super) fn next(&mut self) -> Option<Job> {
        if self.open.as_ref().is_none_or(|(pending, place)| *place == pending.rows) {
            self.open = Some((Arc::new(Pending::new(self.plan, self.parts.next()?)), 0));
        }
        let (pending, next) = self.open.as_mut()?;
        let place = *next;
        *next += 1;
        let (cell, sample) = (pending.first_cell + place / pending.samples, place % pending.samples);
        Some(Job { pending: Arc::clone(pending), cell, sample, place })
    }
}

impl Pending {
    fn new(plan: &ScanPlan, part: usize) -> Self {
        let (cells, samples) = (plan.cells_of(part), plan.computation.samples);
        let rows = cells.len() * samples;
        Self { part, first_cell: cells.start, samples, rows, done: Mutex::new((vec![None; rows], 0)) }
    }
}

impl Job {
    /// Takes in the row; returns all rows of the part, in order, if it was the last one.
    pub(super) fn done(&self, row: Row) -> Option<Vec<Row>> {
        let mut done = held(&self.pending.done);
        done.0[self.place] = Some(row);
        done.1 += 1;
        (done.1 == self.pending.rows).then(|| std::mem::take(&mut done.0).into_iter().flatten().collect())
    }
}

/// The lock, also where another thread panicked with it: what it guards is whole at every point.
pub(super) fn held<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
