//! The order of rows, and the parts that are complete.
//!
//! Rows of a part are assigned in order, one at a time: a slow row occupies one thread, while the others continue with the following rows,
//! if necessary in the next parts. A part is in progress only while a thread holds one of its rows, so at
//! most one part per thread (and the one being assigned) is in memory.

use super::{Row, ScanPlan};
use std::collections::BTreeMap;
use std::ops::Range;

/// The rows still to be assigned, and the parts in progress.
pub(super) struct Queue<'q> {
    plan: &'q ScanPlan,
    parts: Box<dyn Iterator<Item = usize> + Send + 'q>,
    /// Rows of the last part that was started, as `cell * samples + sample`.
    open: Range<usize>,
    /// By number of the part: its rows, and how many of them are computed.
    pending: BTreeMap<usize, (Vec<Option<Row>>, usize)>,
}

impl<'q> Queue<'q> {
    pub(super) fn new(plan: &'q ScanPlan, parts: impl Iterator<Item = usize> + Send + 'q) -> Self {
        Self { plan, parts: Box::new(parts), open: 0..0, pending: BTreeMap::new() }
    }

    /// Cell and initial state of the next row, if any is left.
    pub(super) fn next(&mut self) -> Option<(usize, usize)> {
        let samples = self.plan.computation.samples;
        if self.open.is_empty() {
            let part = self.parts.next()?;
            let cells = self.plan.cells_of(part);
            self.open = cells.start * samples..cells.end * samples;
            self.pending.insert(part, (vec![None; self.open.len()], 0));
        }
        let row = self.open.next()?;
        Some((row / samples, row % samples))
    }

    /// Adds a row; returns the part and all its rows, in order, if it was the last one.
    pub(super) fn done(&mut self, cell: usize, sample: usize, row: Row) -> Option<(usize, Vec<Row>)> {
        let part = cell / self.plan.cells_per_part();
        let first = self.plan.cells_of(part).start;
        let (rows, count) = self.pending.get_mut(&part)?;
        rows[(cell - first) * self.plan.computation.samples + sample] = Some(row);
        *count += 1;
        if *count < rows.len() {
            return None;
        }
        let (rows, _) = self.pending.remove(&part)?;
        Some((part, rows.into_iter().flatten().collect()))
    }
}
