//! A folder of fits that is being computed: each is written as soon as it is done, so that the work can be continued.
//!
//! `_fit.json` says what is computed (settings, units, and a digest of every cell's frames); `_cells/N.json.gz` are the finished fits. Of one fit of
//! all cells together, `_cells` has the finished stages. When all are done, the results are written into the same folder, and `_cells` is removed once the
//! pages are drawn, which need the whole fits.

mod manifest;

use crate::folder::{FitFolder, result_files};
use crate::packed::{read_packed, write_packed};
use crate::stages::Stages;
use crate::{CellFit, CellTrack, Error, FitOptions, Result, Sample, fit_in_stages, fit_or_reason};
use manifest::Manifest;
pub(crate) use manifest::{MANIFEST, digest};
use motiform_dynamics::{StopOnly, Watch};
use motiform_files::{Staging, replace_file, sweep};
use motiform_lab::pool;
use motiform_lab::scan::Opening;
use motiform_study::Error as StudyError;
use serde_json::Value;
use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};

/// The finished fits, or stages.
const CELLS: &str = "_cells";

/// Fits that are being computed in a folder. While it lives, no other process computes there.
#[derive(Debug)]
pub struct FitWork {
    path: PathBuf,
    manifest: Manifest,
    options: FitOptions,
    /// The fits that are done, by number.
    done: Vec<Option<CellFit>>,
    _locks: (File, Option<File>),
}

impl FitWork {
    /// Opens the folder of fits of these cells, creating it if it does not exist, and reads the cells in it that are done.
    ///
    /// # Errors
    /// A folder that exists without [`Opening::Resume`] or [`Opening::Replace`], or that is none of ours; [`Error::OtherFits`]: other cells or
    /// settings there; [`StudyError::Busy`]; files that cannot be written.
    pub fn open(
        path: &Path,
        sample: &Sample,
        cells: &[&CellTrack],
        options: &FitOptions,
        opening: Opening,
    ) -> Result<Self> {
        options.library()?;
        sweep(path);
        let manifest = Manifest::new(sample, cells, options);
        let there = path.symlink_metadata().is_ok();
        if there && opening == Opening::Resume {
            return Self::resume(path, &manifest);
        }
        let replaced = if there && path.join(MANIFEST).is_file() { Some(lock(path, path)?) } else { None };
        let staging = Staging::replacing(path, opening == Opening::Replace, FitFolder::is_one)?;
        staging.write(MANIFEST, &manifest.bytes(path)?)?;
        let new = lock(staging.path(), path)?;
        staging.commit()?;
        let options = options.clone();
        let done = (0..manifest.fits()).map(|_| None).collect();
        Ok(Self { path: path.to_owned(), manifest, options, done, _locks: (new, replaced) })
    }

    fn resume(path: &Path, asked: &Manifest) -> Result<Self> {
        let manifest = Manifest::read(path)?;
        let differences = manifest.differences(asked);
        if !differences.is_empty() {
            return Err(Error::OtherFits { path: path.to_owned(), differences: differences.join("; ") });
        }
        let lock = lock(path, path)?;
        let read = |number| {
            read_packed(&cell_path(path, number)).filter(|fit: &CellFit| fit.name == manifest.name(number))
        };
        let done = (0..manifest.fits()).map(read).collect();
        let options = manifest.settings.clone();
        Ok(Self { path: path.to_owned(), manifest, options, done, _locks: (lock, None) })
    }

    /// The summary, if all cells were done when the folder was opened and the results are there; with `pages` only if these have been drawn.
    #[must_use]
    pub fn finished(&self, pages: bool) -> Option<Value> {
        let bytes = fs::read(self.path.join(crate::folder::SUMMARY)).ok()?;
        let complete = !self.path.join(CELLS).exists() || (self.left() == 0 && !pages);
        if complete { serde_json::from_slice(&bytes).ok() } else { None }
    }

    /// Where it is.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Number of fits that are not done.
    #[must_use]
    pub fn left(&self) -> usize {
        self.done.iter().filter(|done| done.is_none()).count()
    }

    /// Makes the fits that are not done, on `threads` threads, and writes each at once. Those in progress stop soon after `watch` requests it.
    /// `None` for those that the watch left out.
    ///
    /// # Errors
    /// Files that cannot be written: what was written before is kept.
    pub fn run(
        &mut self,
        cells: &[&CellTrack],
        threads: usize,
        watch: &dyn Watch,
    ) -> Result<Vec<Option<CellFit>>> {
        let mut all = std::mem::take(&mut self.done);
        let mut open: Vec<usize> = (0..all.len()).filter(|&number| all[number].is_none()).collect();
        let folder = self.path.join(CELLS);
        fs::create_dir_all(&folder)
            .map_err(|reason| StudyError::Unwritable { path: folder.clone(), reason })?;
        if self.options.together {
            if !open.is_empty() {
                all = vec![self.together(cells, folder, watch)?];
            }
            return Ok(all);
        }
        open.sort_by_key(|&number| std::cmp::Reverse(cells[number].frames())); // so that no long one is left to the end
        let answer = |&number: &usize| {
            let fit = fit_or_reason(cells[number], &self.options, &StopOnly(watch))?;
            if let Some(fit) = &fit {
                write_packed(&cell_path(&self.path, number), fit)?;
            }
            Ok(fit)
        };
        let found = pool::as_far_as(&open, threads, watch, answer)?;
        for (number, fit) in open.into_iter().zip(found) {
            all[number] = fit;
        }
        Ok(all)
    }

    /// One fit of all cells, stage by stage; `None` where the watch stopped it.
    fn together(&self, cells: &[&CellTrack], folder: PathBuf, watch: &dyn Watch) -> Result<Option<CellFit>> {
        match fit_in_stages(cells, &self.options, &Stages::kept_in(folder), watch) {
            Ok(fit) => {
                write_packed(&cell_path(&self.path, 0), &fit)?;
                Ok(Some(fit))
            }
            Err(Error::Study(StudyError::Interrupted)) => Ok(None),
            Err(error) => Err(error),
        }
    }

    /// Writes a further file, such as a page.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write_file(&self, name: &str, bytes: &[u8]) -> std::result::Result<(), StudyError> {
        replace_file(&self.path.join(name), bytes)
    }

    /// Writes the results of the fits that are done. If these are all, and their pages are drawn, what is only needed to go on is removed.
    ///
    /// # Errors
    /// Files that cannot be written.
    pub fn write(&self, sample: &Sample, fits: &[CellFit], pages: bool) -> Result<PathBuf> {
        for (name, bytes) in &result_files(sample, fits, &self.options, &self.path)? {
            self.write_file(name, bytes)?;
        }
        if pages && fits.len() == self.manifest.fits() {
            let _ = fs::remove_dir_all(self.path.join(CELLS)); // what is left over harms nothing
        }
        Ok(self.path.clone())
    }
}

fn cell_path(folder: &Path, number: usize) -> PathBuf {
    folder.join(CELLS).join(format!("{number}.json.gz"))
}

/// The lock of a folder, on its manifest; held as long as the file is open.
fn lock(folder: &Path, shown: &Path) -> Result<File> {
    let unwritable = |reason| StudyError::Unwritable { path: shown.to_owned(), reason };
    let file = File::options().read(true).write(true).open(folder.join(MANIFEST)).map_err(unwritable)?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => Err(StudyError::Busy { path: shown.to_owned() }.into()),
        Err(TryLockError::Error(reason)) => Err(unwritable(reason).into()),
    }
}
