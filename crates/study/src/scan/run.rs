//! Computing a scan: open the folder, find what is missing, compute it over all threads.

use super::evaluate::Evaluate;
use super::folder::{ScanFolder, differences, lock, stage};
use super::part::{PARTIAL, PartError};
use super::queue::{Job, Queue, held};
use super::{Parts, Row, ScanPlan, Shard};
use crate::Error;
use crate::simulate::Monitor;
use motiform_analysis::regime::{Attractor, Regime, Verdict};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// What to do with a folder that is there already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Opening {
    /// Refuse it.
    New,
    /// Go on with the scan in it.
    Resume,
    /// Replace the scan in it.
    Replace,
}

/// A scan that is being computed. While it lives, no other process computes in its folder.
#[derive(Debug)]
pub struct Scan {
    folder: ScanFolder,
    shard: Shard,
    /// Whether each part is there and whole: one byte per part is all the memory that grows with the cells.
    whole: Vec<bool>,
    damaged: Vec<String>,
    /// The folder's lock, and that of the folder it replaced.
    _locks: (File, Option<File>),
}

/// How a computation ended that did not fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ended {
    /// Whether everything of the shard is computed; if not, the monitor stopped it.
    pub complete: bool,
    /// Cells computed and written.
    pub cells: usize,
    /// Most rows that were in memory at once.
    pub most_rows: usize,
}

impl Scan {
    /// Opens the folder of a scan, making it where it does not exist, and checks the parts in it.
    ///
    /// # Errors
    /// [`Error::ScanExists`], [`Error::NotOurs`], [`Error::NoScan`], [`Error::OtherScan`], [`Error::Busy`],
    /// [`Error::Unwritable`], [`Error::WriteFailed`].
    pub fn open(path: &Path, plan: &ScanPlan, shard: Shard, opening: Opening) -> Result<Self, Error> {
        let there = path.symlink_metadata().is_ok();
        if there && opening == Opening::Resume {
            return Self::resume(path, plan, shard);
        }
        if there && !ScanFolder::is_one(path) {
            return Err(Error::NotOurs { path: path.to_owned() });
        }
        if there && opening == Opening::New {
            return Err(Error::ScanExists { path: path.to_owned() });
        }
        let replaced = if there { Some(lock(path, path)?) } else { None };
        let staging = stage(path, plan, there)?;
        let new = lock(staging.path(), path)?;
        staging.commit()?;
        let whole = vec![false; plan.parts()];
        Ok(Self {
            folder: ScanFolder::read(path)?,
            shard,
            whole,
            damaged: Vec::new(),
            _locks: (new, replaced),
        })
    }

    fn resume(path: &Path, plan: &ScanPlan, shard: Shard) -> Result<Self, Error> {
        let folder = ScanFolder::read(path)?;
        if folder.plan().hash() != plan.hash() {
            let differences = differences(folder.plan(), plan);
            return Err(Error::OtherScan { path: path.to_owned(), differences });
        }
        let lock = lock(path, path)?;
        remove_partial(path)?;
        let parts = folder.parts();
        let (mut whole, mut damaged) = (vec![false; plan.parts()], Vec::new());
        for (part, whole) in whole.iter_mut().enumerate().filter(|(part, _)| shard.holds(*part)) {
            match parts.check(part) {
                Ok(_) => *whole = true,
                Err(PartError::Missing) => {}
                Err(PartError::Damaged(how)) => damaged.push(how),
            }
        }
        Ok(Self { folder, shard, whole, damaged, _locks: (lock, None) })
    }

    /// The folder.
    #[must_use]
    pub fn folder(&self) -> &ScanFolder {
        &self.folder
    }

    /// The damaged parts that were found, each with what is wrong; [`Scan::run`] computes them again.
    #[must_use]
    pub fn damaged(&self) -> &[String] {
        &self.damaged
    }

    /// Number of cells to compute.
    #[must_use]
    pub fn cells_left(&self) -> usize {
        self.parts_left().map(|part| self.folder.plan().cells_of(part).len()).sum()
    }

    fn parts_left(&self) -> impl Iterator<Item = usize> + Send {
        let left = |(part, whole): (usize, &bool)| (self.shard.holds(part) && !whole).then_some(part);
        self.whole.iter().enumerate().filter_map(left)
    }

    /// Computes what is missing, over `threads` threads. Rows under way are stopped soon when `monitor` says so.
    ///
    /// # Errors
    /// [`Error::PartFailed`]: the parts written before are kept.
    pub fn run(
        &self,
        evaluate: &dyn Evaluate,
        threads: usize,
        monitor: &dyn Monitor,
    ) -> Result<Ended, Error> {
        let plan = self.folder.plan();
        let cells = self.cells_left();
        let total = cells * plan.computation.samples;
        let work = Work {
            plan,
            parts: self.folder.parts(),
            evaluate,
            monitor,
            total,
            queue: Mutex::new(Queue::new(plan, self.parts_left())),
            failure: Mutex::new(None),
            failed: AtomicBool::new(false),
            rows: AtomicUsize::new(0),
            cells: AtomicUsize::new(0),
            held: AtomicUsize::new(0),
            most: AtomicUsize::new(0),
        };
        // Plain threads: the queue is the whole scheduler, and a pool would only hide it.
        std::thread::scope(|scope| {
            for _ in 1..threads.min(total) {
                scope.spawn(|| work.compute());
            }
            work.compute();
        });
        if let Some(error) = held(&work.failure).take() {
            return Err(error);
        }
        let done = work.cells.into_inner();
        Ok(Ended { complete: done == cells, cells: done, most_rows: work.most.into_inner() })
    }
}

/// Removes what a killed process left half-written (we hold the lock: nobody writes here now).
fn remove_partial(folder: &Path) -> Result<(), Error> {
    let unwritable = |reason| Error::Unwritable { path: folder.to_owned(), reason };
    for entry in fs::read_dir(folder).map_err(unwritable)? {
        let entry = entry.map_err(unwritable)?;
        let name = entry.file_name();
        let name = name.to_string_lossy();
        if name.starts_with(".part-") && name.ends_with(PARTIAL) {
            fs::remove_file(entry.path()).map_err(unwritable)?;
        }
    }
    Ok(())
}

/// What the threads share.
struct Work<'w> {
    plan: &'w ScanPlan,
    parts: Parts,
    evaluate: &'w dyn Evaluate,
    monitor: &'w dyn Monitor,
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

impl Work<'_> {
    /// One thread: rows until none is left, or a stop.
    fn compute(&self) {
        // The rows under way, by their number on this thread.
        let jobs = RefCell::new(BTreeMap::new());
        let mut handed_out = 0;
        let mut next = || {
            if self.stopped() {
                return None;
            }
            let job = held(&self.queue).next()?;
            let row = (job.cell, job.sample);
            jobs.borrow_mut().insert(handed_out, job);
            handed_out += 1;
            Some(row)
        };
        let mut done = |number: usize, verdict| {
            if let Some(job) = jobs.borrow_mut().remove(&number) {
                self.done(&job, verdict);
            }
        };
        self.evaluate.evaluate_all(self.plan, &mut next, &mut done, self);
    }

    /// Takes in the verdict on a row; nothing, if it was stopped. What the numerics refuse is a row that says so.
    fn done(&self, job: &Job, verdict: Result<Option<Verdict>, Error>) {
        let verdict = match verdict {
            Ok(Some(verdict)) => verdict,
            Ok(None) => return,
            Err(error) => {
                Verdict::new(Regime::Undetermined, Attractor::Unknown, format!("refused: {error}"), 0.0)
            }
        };
        let count = self.held.fetch_add(1, Ordering::Relaxed) + 1;
        self.most.fetch_max(count, Ordering::Relaxed);
        if let Some(rows) = job.done(Row::new(job.cell, job.sample, verdict)) {
            self.write(job.pending.part, &rows);
        }
        let rows = self.rows.fetch_add(1, Ordering::Relaxed) + 1;
        self.monitor.progress(rows as f64 / self.total as f64);
    }

    fn write(&self, part: usize, rows: &[Row]) {
        match self.parts.write(self.plan, part, rows) {
            Ok(()) => {
                self.cells.fetch_add(self.plan.cells_of(part).len(), Ordering::Relaxed);
            }
            Err(error) => {
                held(&self.failure).get_or_insert(error);
                self.failed.store(true, Ordering::Relaxed);
            }
        }
        self.held.fetch_sub(rows.len(), Ordering::Relaxed);
    }
}

/// What an evaluation listens to: the caller's stop, or a failure in another thread.
impl Monitor for Work<'_> {
    fn stopped(&self) -> bool {
        self.failed.load(Ordering::Relaxed) || self.monitor.stopped()
    }
}
