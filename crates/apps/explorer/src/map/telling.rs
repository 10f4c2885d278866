//! Computed cells on their way to the page: some at a time, with the progress.

use super::Done;
use super::view::View;
use crate::answers::Answers;
use crate::frames::{self, Cell};
use crate::protocol::{Mapped, Progress};
use motiform_lab::clock::Moment;
use std::time::Duration;

/// Between two messages with cells, and two with the progress.
const EVERY: (Duration, Duration) = (Duration::from_millis(40), Duration::from_millis(120));

/// Cells to be sent to the page.
pub(super) struct Telling {
    cells: Vec<Cell>,
    done: usize,
    computed: usize,
    sent: Moment,
    told: Moment,
    begun: Moment,
}

impl Telling {
    /// Of so many cells that are known.
    pub(super) fn new(known: usize) -> Self {
        let now = Moment::now();
        Self { cells: Vec::new(), done: known, computed: 0, sent: now, told: now, begun: now }
    }

    /// Adds a cell that was computed, and sends what is waiting if it is time.
    pub(super) fn add(&mut self, cell: Cell, view: &View, answers: &Answers) -> Done {
        self.cells.push(cell);
        self.done += 1;
        self.computed += 1;
        if self.sent.elapsed() < EVERY.0 {
            return Ok(());
        }
        self.sent = Moment::now();
        answers.binary(frames::cells(view.epoch, &std::mem::take(&mut self.cells)))?;
        if self.told.elapsed() < EVERY.1 {
            return Ok(());
        }
        self.told = Moment::now();
        answers.say(self.progress(view))
    }

    fn progress(&self, view: &View) -> Progress {
        let total = view.known.len() + view.wanted.len();
        let rate = self.computed as f64 / self.begun.elapsed().as_secs_f64().max(1e-3);
        Progress { epoch: view.epoch, done: self.done, total, rate }
    }

    /// Sends the remaining cells, and that the map is complete.
    pub(super) fn finish(self, epoch: u32, answers: &Answers) -> Done {
        answers.binary(frames::cells(epoch, &self.cells))?;
        let seconds = self.begun.elapsed().as_secs_f64();
        answers.say(Mapped { epoch, cells: self.done, computed: self.computed, seconds })
    }
}
