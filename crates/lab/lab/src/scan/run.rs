//! The folder of a scan that is being computed: opening it, finding missing parts, storing results.

use super::evaluate::Evaluate;
use super::folder::ScanFolder;
use super::part::PartError;
use super::work::{Ended, Store, compute};
use super::{Row, ScanPlan, Shard};
use motiform_dynamics::Watch;
use motiform_store::{Error as StoreError, Folder, Opening};
use motiform_study::Error;
use std::path::Path;

/// A scan that is being computed. While it lives, no other process computes in its folder.
#[derive(Debug)]
pub struct Scan {
    folder: ScanFolder,
    shard: Shard,
    /// `true` for each part that exists and is undamaged: only this memory, one byte per part, grows with the
    /// cells.
    whole: Vec<bool>,
    damaged: Vec<String>,
    /// Its files, locked.
    files: Folder,
}

impl Scan {
    /// Opens the folder of a scan, creating it if it does not exist, and checks the parts in it.
    ///
    /// # Errors
    /// [`Error::Store`] where it exists, is not ours, is used by others or cannot be written;
    /// [`Error::NoResult`], [`Error::OtherPlan`].
    pub fn open(path: &Path, plan: &ScanPlan, shard: Shard, opening: Opening) -> Result<Self, Error> {
        let (files, earlier) = plan.open(path, opening, None)?;
        let folder = ScanFolder::read(path)?;
        let (mut whole, mut damaged) = (vec![false; plan.parts()], Vec::new());
        if earlier {
            (whole, damaged) = survey(&folder, shard)?;
        }
        Ok(Self { folder, shard, whole, damaged, files })
    }

    /// The folder.
    pub fn folder(&self) -> &ScanFolder {
        &self.folder
    }

    /// The damaged parts that were found, each with a description; [`Scan::run`] recomputes them.
    pub fn damaged(&self) -> &[String] {
        &self.damaged
    }

    /// Number of cells to compute.
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
        self.put(part, rows)
    }

    /// Writes a part. A damaged one that has its name is kept under another.
    fn put(&self, part: usize, rows: &[Row]) -> Result<(), Error> {
        let parts = self.folder.parts();
        let bytes = parts.encode(self.folder.plan(), part, rows)?;
        let name = parts.name(part);
        let put = match self.files.put(&name, &bytes) {
            Err(StoreError::Changed { .. }) => {
                self.files.keep_aside(&name).and_then(|_| self.files.put(&name, &bytes))
            }
            put => put,
        };
        put.map_err(|error| match error {
            StoreError::WriteFailed { path, reason } => Error::PartFailed { path, reason },
            other => other.into(),
        })
    }

    /// Writes figures of the scan. Those that others drew or edited stay.
    ///
    /// # Errors
    /// Files that cannot be written.
    pub fn draw<'p>(&self, pictures: impl IntoIterator<Item = (&'p str, &'p [u8])>) -> Result<(), Error> {
        for (name, bytes) in pictures {
            self.files.put(name, bytes)?;
        }
        Ok(self.files.settle()?)
    }

    /// Brings the inventory up to date, once all parts of this shard are there: the scan is complete then.
    /// [`Scan::run`] does it.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn settle(&self) -> Result<(), Error> {
        let parts = self.folder.parts();
        let names = self.files.names();
        let listed =
            |part: usize| names.binary_search(&parts.name(part)).is_ok() && parts.path(part).is_file();
        let complete = (0..self.whole.len()).all(|part| !self.shard.holds(part) || listed(part));
        Ok(if complete { self.files.complete() } else { self.files.settle() }?)
    }

    /// The parts of this scan that are missing or damaged although all of them were written: another process
    /// changed the folder.
    pub fn lost(&self) -> usize {
        let parts = self.folder.parts();
        (0..self.whole.len()).filter(|&part| self.shard.holds(part) && parts.check(part).is_err()).count()
    }

    /// Remarks for the user, in sentences, each once: leftovers of killed runs that were removed, files that
    /// stay.
    pub fn notes(&self) -> Vec<String> {
        self.files.notes()
    }

    /// Computes the missing parts on `threads` threads. Rows in progress stop soon after `watch` requests it.
    ///
    /// # Errors
    /// [`Error::PartFailed`]: the parts written before are kept.
    pub fn run(&self, evaluate: &dyn Evaluate, threads: usize, watch: &dyn Watch) -> Result<Ended, Error> {
        let ended = compute(self.folder.plan(), self.parts_left().collect(), evaluate, threads, watch, self)?;
        self.settle()?;
        Ok(ended)
    }
}

impl Store for Scan {
    fn put(&self, part: usize, rows: Vec<Row>) -> Result<(), Error> {
        self.put(part, &rows)
    }
}

/// The parts of a shard that are there and undamaged, and descriptions of the damaged ones.
fn survey(folder: &ScanFolder, shard: Shard) -> Result<(Vec<bool>, Vec<String>), Error> {
    let parts = folder.parts();
    let (mut whole, mut damaged) = (vec![false; folder.plan().parts()], Vec::new());
    for (part, whole) in whole.iter_mut().enumerate().filter(|(part, _)| shard.holds(*part)) {
        match parts.check(part) {
            Ok(_) => *whole = true,
            Err(PartError::Missing) => {}
            Err(PartError::Damaged(how)) => damaged.push(how),
            Err(PartError::InTheWay(path)) => return Err(Error::InTheWay { path }),
        }
    }
    Ok((whole, damaged))
}
