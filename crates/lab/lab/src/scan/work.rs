//! Computation of the parts of a scan on threads, for any destination of the rows.

use super::evaluate::Evaluate;
use super::queue::Queue;
use super::{Row, ScanPlan};
use crate::pool::{held, on_threads, spread};
use motiform_analysis::regime::Verdict;
use motiform_dynamics::{StopOnly, Watch};
use motiform_study::Error;
use std::cell::RefCell;
use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// The destination of finished parts: files, or memory.
pub trait Store: Sync {
    /// Stores all rows of a part, in order.
    ///
    /// # Errors
    /// The reason why they cannot be stored; the computation then ends.
    fn put(&self, part: usize, rows: Vec<Row>) -> Result<(), Error>;
}

/// The end of a successful computation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ended {
    /// `true` if everything of the shard is computed; if not, the watch stopped it.
    pub complete: bool,
    /// Cells computed and written.
    pub cells: usize,
    /// Most rows that were in memory at once.
    pub most_rows: usize,
}

/// Computes `parts` of a plan on `threads` threads, passing each to `store` when its last row is computed. Rows in progress
/// stop soon after `watch` requests it.
///
/// # Errors
/// Errors of the store: the parts stored before are kept.
pub fn compute(
    plan: &ScanPlan,
    parts: Vec<usize>,
    evaluate: &dyn Evaluate,
    threads: usize,
    watch: &dyn Watch,
    store: &dyn Store,
) -> Result<Ended, Error> {
    let cells: usize = parts.iter().map(|&part| plan.cells_of(part).len()).sum();
    let total = cells * plan.computation.samples;
    let work = Shared {
        plan,
        store,
        evaluate,
        watch,
        total,
        queue: Mutex::new(Queue::new(plan, scattered(parts).into_iter())),
        failure: Mutex::new(None),
        failed: AtomicBool::new(false),
        rows: AtomicUsize::new(0),
        cells: AtomicUsize::new(0),
        held: AtomicUsize::new(0),
        most: AtomicUsize::new(0),
    };
    on_threads(threads.min(total), || work.compute());
    if let Some(error) = held(&work.failure).take() {
        return Err(error);
    }
    let done = work.cells.into_inner();
    Ok(Ended { complete: done == cells, cells: done, most_rows: work.most.into_inner() })
}

/// The parts in the order of the van der Corput sequence: halves, quarters, eighths. Neighbouring cells cost alike, and some regions
/// cost a hundred times as much as others: in this order every share of the parts is nearly the same share of the work, so that the time
/// left can be estimated, and a region of expensive cells is not left for the end.
fn scattered(mut parts: Vec<usize>) -> Vec<usize> {
    parts.sort_unstable();
    let mut numbered: Vec<(usize, usize)> = parts.into_iter().enumerate().collect();
    numbered.sort_by_key(|(index, _)| index.reverse_bits());
    numbered.into_iter().map(|(_, part)| part).collect()
}

/// The rows of the first of some cells, in order, on this thread: of one cell, and of further cells while `go_on` returns true. `None`
/// if the watch stopped it. The same rows as those of the whole scan.
pub fn rows_of(
    plan: &ScanPlan,
    cells: Range<usize>,
    go_on: &dyn Fn() -> bool,
    evaluate: &dyn Evaluate,
    watch: &dyn Watch,
) -> Option<Vec<Row>> {
    let samples = plan.computation.samples;
    let (first, count) = (cells.start, cells.len() * samples);
    let mut rows: Vec<Option<Row>> = Vec::new();
    let given = RefCell::new(0);
    let mut next = || {
        let mut given = given.borrow_mut();
        let number = *given;
        // Cells are whole: a stop comes before the first row of one.
        let on =
            number < count && (number == 0 || !number.is_multiple_of(samples) || go_on()) && !watch.stopped();
        *given += usize::from(on);
        on.then(|| (first + number / samples, number % samples))
    };
    let mut done = |(cell, sample): (usize, usize), verdict| {
        let number = (cell - first) * samples + sample;
        rows.resize_with(rows.len().max(number + 1), || None);
        rows[number] = Row::of_evaluation(cell, sample, verdict);
    };
    evaluate.evaluate_all(plan, &mut next, &mut done, watch);
    let whole = !watch.stopped() && rows.len() == given.into_inner();
    rows.into_iter().collect::<Option<Vec<_>>>().filter(|_| whole)
}

/// The rows of some cells (rising numbers), cell by cell, on `threads` threads; `None` if the watch stopped
/// it. The same rows as those of the whole scan.
///
/// # Errors
/// None of its own: what the numerics reject is in the rows.
pub fn rows_at(
    plan: &ScanPlan,
    cells: &[usize],
    threads: usize,
    evaluate: &dyn Evaluate,
    watch: &dyn Watch,
) -> Result<Option<Vec<Row>>, Error> {
    let samples = plan.computation.samples;
    spread(cells.len() * samples, threads, watch, |jobs| {
        let mut next = || jobs.next().map(|job| (cells[job / samples], job % samples));
        let mut done = |(cell, sample): (usize, usize), verdict| {
            if let Ok(place) = cells.binary_search(&cell) {
                jobs.done(place * samples + sample, Ok(Row::of_evaluation(cell, sample, verdict)));
            }
        };
        evaluate.evaluate_all(plan, &mut next, &mut done, &StopOnly(watch));
    })
}

/// The data that the threads share.
struct Shared<'w> {
    plan: &'w ScanPlan,
    store: &'w dyn Store,
    evaluate: &'w dyn Evaluate,
    watch: &'w dyn Watch,
    /// Rows to compute.
    total: usize,
    queue: Mutex<Queue<'w>>,
    failure: Mutex<Option<Error>>,
    failed: AtomicBool,
    /// Rows computed, cells written, rows in memory, and the most of these.
    rows: AtomicUsize,
    cells: AtomicUsize,
    held: AtomicUsize,
    most: AtomicUsize,
}

impl Shared<'_> {
    /// One thread: rows until none is left, or a stop.
    fn compute(&self) {
        let mut next = || if self.stopped() { None } else { held(&self.queue).next() };
        let mut done = |(cell, sample): (usize, usize), verdict| self.done(cell, sample, verdict);
        self.evaluate.evaluate_all(self.plan, &mut next, &mut done, self);
    }

    /// Adds the verdict on a row.
    fn done(&self, cell: usize, sample: usize, verdict: Result<Option<Verdict>, Error>) {
        let Some(row) = Row::of_evaluation(cell, sample, verdict) else { return };
        let count = self.held.fetch_add(1, Ordering::Relaxed) + 1;
        self.most.fetch_max(count, Ordering::Relaxed);
        let whole = held(&self.queue).done(cell, sample, row);
        if let Some((part, rows)) = whole {
            self.put(part, rows);
        }
        let rows = self.rows.fetch_add(1, Ordering::Relaxed) + 1;
        self.watch.progress(rows as f64 / self.total as f64);
    }

    fn put(&self, part: usize, rows: Vec<Row>) {
        let count = rows.len();
        match self.store.put(part, rows) {
            Ok(()) => {
                self.cells.fetch_add(self.plan.cells_of(part).len(), Ordering::Relaxed);
            }
            Err(error) => {
                held(&self.failure).get_or_insert(error);
                self.failed.store(true, Ordering::Relaxed);
            }
        }
        self.held.fetch_sub(count, Ordering::Relaxed);
    }
}

/// Stops an evaluation: by the caller's watch, or after a failure in another thread.
impl Watch for Shared<'_> {
    fn stopped(&self) -> bool {
        self.failed.load(Ordering::Relaxed) || self.watch.stopped()
    }
}

#[cfg(test)]
mod tests {
    use super::scattered;

    #[test]
    fn parts_are_spread_over_the_plane() {
        assert_eq!(scattered((0..8).collect()), [0, 4, 2, 6, 1, 5, 3, 7]);
        assert_eq!(scattered(vec![9, 5, 7]), [5, 9, 7]);
        // Every share of the parts reaches over the whole: no gap is longer than twice the mean one.
        let parts = scattered((0..1000).collect());
        for count in [10, 100, 300] {
            let mut first = parts[..count].to_vec();
            first.sort_unstable();
            assert!(first.windows(2).all(|pair| (pair[1] - pair[0]) * count <= 2 * 1024), "{count}");
        }
    }
}
