//! The folder of a scan that is being computed: opening it, finding missing parts, storing results.

use super::evaluate::Evaluate;
use super::folder::{ScanFolder, differences, lock, stage};
use super::part::{PARTIAL, PartError};
use super::work::{Ended, Store, compute};
use super::{Parts, Row, ScanPlan, Shard};
use motiform_dynamics::Watch;
use motiform_files::sweep;
use motiform_study::Error;
use std::fs::{self, File};
use std::path::Path;

/// What to do with an existing folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Opening {
    /// Reject it.
    New,
    /// Continue the scan in it.
    Resume,
    /// Replace the scan in it.
    Replace,
}

/// A scan that is being computed. While it lives, no other process computes in its folder.
#[derive(Debug)]
pub struct Scan {
    folder: ScanFolder,
    shard: Shard,
    /// Whether each part exists and is undamaged: only this memory, one byte per part, grows with the cells.
    whole: Vec<bool>,
    damaged: Vec<String>,
    swept: Vec<String>,
    /// The folder's lock, and that of the folder it replaced.
    _locks: (File, Option<File>),
}

impl Scan {
    /// Opens the folder of a scan, creating it if it does not exist, and checks the parts in it.
    ///
    /// # Errors
    /// [`Error::ScanExists`], [`Error::NotOurs`], [`Error::NoScan`], [`Error::OtherScan`], [`Error::Busy`],
    /// [`Error::Unwritable`], [`Error::WriteFailed`].
    pub fn open(path: &Path, plan: &ScanPlan, shard: Shard, opening: Opening) -> Result<Self, Error> {
        let mut swept = sweep(path);
        let there = path.symlink_metadata().is_ok();
        if there && opening == Opening::Resume {
            return Ok(Self { swept, ..Self::resume(path, plan, shard)? });
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
        swept.extend_from_slice(staging.swept());
        staging.commit()?;
        let whole = vec![false; plan.parts()];
        Ok(Self {
            folder: ScanFolder::read(path)?,
            shard,
            whole,
            damaged: Vec::new(),
            swept,
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
                Err(PartError::InTheWay(path)) => return Err(Error::InTheWay { path }),
            }
        }
        Ok(Self { folder, shard, whole, damaged, swept: Vec::new(), _locks: (lock, None) })
    }

    /// The folder.
    #[must_use]
    pub fn folder(&self) -> &ScanFolder {
        &self.folder
    }

    /// The damaged parts that were found, each with a description; [`Scan::run`] recomputes them.
    #[must_use]
    pub fn damaged(&self) -> &[String] {
        &self.damaged
    }

    /// Number of cells to compute.
    #[must_use]
    pub fn cells_left(&self) -> usize {
        self.parts_left().map(|part| self.folder.plan().cells_of(part).len()).sum()
    }

    /// The parts to compute, in order.
    pub fn parts_left(&self) -> impl Iterator<Item = usize> {
        let left = |(part, whole): (usize, &bool)| (self.shard.holds(part) && !whole).then_some(part);
        self.whole.iter().enumerate().filter_map(left)
    }

    /// Stores the rows of a part that were computed elsewhere.
    ///
    /// # Errors
    /// [`Error::PartFailed`]; [`Error::OtherRows`] if they are not the rows of this part, in order.
    pub fn keep(&self, part: usize, rows: &[Row]) -> Result<(), Error> {
        let plan = self.folder.plan();
        let samples = plan.computation.samples;
        let places = plan.cells_of(part).flat_map(|cell| (0..samples).map(move |sample| (cell, sample)));
        if !places.eq(rows.iter().map(|row| (row.cell, row.sample))) {
            return Err(Error::OtherRows { part });
        }
        self.folder.parts().write(plan, part, rows)
    }

    /// The parts of this scan that are missing or damaged although all of them were written: another process changed the folder.
    #[must_use]
    pub fn lost(&self) -> usize {
        let parts = self.folder.parts();
        (0..self.whole.len()).filter(|&part| self.shard.holds(part) && parts.check(part).is_err()).count()
    }

    /// The leftovers of scans in this folder that were killed at their start, found and removed, in sentences.
    #[must_use]
    pub fn swept(&self) -> &[String] {
        &self.swept
    }

    /// Computes the missing parts on `threads` threads. Rows in progress stop soon after `watch` requests it.
    ///
    /// # Errors
    /// [`Error::PartFailed`]: the parts written before are kept.
    pub fn run(&self, evaluate: &dyn Evaluate, threads: usize, watch: &dyn Watch) -> Result<Ended, Error> {
        let files = Files { plan: self.folder.plan(), parts: self.folder.parts() };
        compute(files.plan, self.parts_left().collect(), evaluate, threads, watch, &files)
    }
}

/// The parts as files.
struct Files<'f> {
    plan: &'f ScanPlan,
    parts: Parts,
}

impl Store for Files<'_> {
    fn put(&self, part: usize, rows: Vec<Row>) -> Result<(), Error> {
        self.parts.write(self.plan, part, &rows)
    }
}

/// Removes incomplete files of a killed process (we hold the lock, so no other process writes here).
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
