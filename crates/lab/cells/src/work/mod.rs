//! A folder of fits that is being computed: each is written as soon as it is done, so that the work can be continued.
//!
//! `_fit.json` says what is computed (settings, units, and a digest of every cell's frames); `_cells/N.json.gz` are the finished fits.
//! Of one fit of all cells together, `_cells` has the finished stages. When all are done, the results are written into the same folder,
//! and `_cells` is removed once the pages are drawn, which need the whole fits.

mod manifest;

use crate::folder::result_files;
use crate::packed::{read_packed, write_packed};
use crate::stages::Stages;
use crate::{CellFit, CellTrack, Error, FitOptions, Result, Sample, fit_in_stages, fit_or_reason};
use manifest::MANIFEST;
use manifest::Manifest;
pub(crate) use manifest::digest;
use motiform_dynamics::{StopOnly, Watch};
use motiform_lab::pool;
use motiform_store::mend;
use motiform_store::{Folder, Kind, Opening};
use motiform_study::Error as StudyError;
use serde_json::Value;
use std::path::Path;

/// The finished fits, or stages.
const CELLS: &str = "_cells/";

/// Fits that are being computed in a folder. While it lives, no other process computes there.
#[derive(Debug)]
pub struct FitWork {
    files: Folder,
    manifest: Manifest,
    options: FitOptions,
    /// The fits that are done, by number.
    done: Vec<Option<CellFit>>,
}

impl FitWork {
    /// Opens the folder of fits of these cells, creating it if it does not exist, and reads the cells in it that are done.
    ///
    /// # Errors
    /// A folder that exists without [`Opening::Resume`] or [`Opening::Replace`], or that is none of ours; [`Error::OtherFits`]: other cells
    /// or settings there; a folder in which another process computes; files that cannot be written.
    pub fn open(
        path: &Path,
        sample: &Sample,
        cells: &[&CellTrack],
        options: &FitOptions,
        opening: Opening,
    ) -> Result<Self> {
        options.library()?;
        let manifest = Manifest::new(sample, cells, options);
        if opening == Opening::Resume && path.exists() {
            return Self::resume(path, &manifest);
        }
        let files = Folder::open(path, Kind::Fits, opening, &[(MANIFEST, &manifest.bytes(path)?)])?;
        let done = (0..manifest.fits()).map(|_| None).collect();
        Ok(Self { files, manifest, options: options.clone(), done })
    }

    fn resume(path: &Path, asked: &Manifest) -> Result<Self> {
        mend(path)?;
        let manifest = Manifest::read(path)?;
        let differences = manifest.differences(asked);
        if !differences.is_empty() {
            return Err(Error::OtherFits { path: path.to_owned(), differences: differences.join("; ") });
        }
        let files = Folder::resume(path, Kind::Fits)?;
        files.check()?;
        let read = |number| {
            read_packed(&files, &cell(number)).filter(|fit: &CellFit| fit.name == manifest.name(number))
        };
        let done = (0..manifest.fits()).map(read).collect();
        let options = manifest.settings.clone();
        Ok(Self { files, manifest, options, done })
    }

    /// Notes for the user, in sentences, each once: leftovers of killed runs that were removed, files that stay.
    pub fn notes(&self) -> Vec<String> {
        self.files.notes()
    }

    /// The summary of a complete result; with `pages` only if these have been drawn.
    pub fn finished(&self, pages: bool) -> Option<Value> {
        let kept = || self.files.names().iter().any(|name| name.starts_with(CELLS));
        if !self.files.is_complete() || (pages && kept()) {
            return None;
        }
        serde_json::from_slice(&self.files.read(crate::folder::SUMMARY)?).ok()
    }

    /// Leaves the folder as it is, where nothing is left to do.
    ///
    /// # Errors
    /// The inventory cannot be written.
    pub fn leave(&self) -> Result<()> {
        Ok(self.files.settle()?)
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        self.files.shown()
    }

    /// Number of fits that are not done.
    pub fn left(&self) -> usize {
        self.done.iter().filter(|done| done.is_none()).count()
    }

    /// Makes the fits that are not done, on `threads` threads, and writes each at once. Those in progress stop soon after `watch` requests
    /// it. `None` for those that the watch left out.
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
        if self.options.together {
            if !open.is_empty() {
                all = vec![self.together(cells, watch)?];
            }
            return Ok(all);
        }
        open.sort_by_key(|&number| std::cmp::Reverse(cells[number].frames())); // so that no long one is left to the end
        let answer = |&number: &usize| {
            let fit = fit_or_reason(cells[number], &self.options, &StopOnly(watch))?;
            if let Some(fit) = &fit {
                write_packed(&self.files, &cell(number), fit)?;
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
    fn together(&self, cells: &[&CellTrack], watch: &dyn Watch) -> Result<Option<CellFit>> {
        match fit_in_stages(cells, &self.options, &Stages::kept_in(&self.files, CELLS), watch) {
            Ok(fit) => {
                write_packed(&self.files, &cell(0), &fit)?;
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
        Ok(self.files.put(name, bytes)?)
    }

    /// Writes the results of the fits that are done. If these are all, and their pages are drawn, what is only needed to go on is removed.
    ///
    /// # Errors
    /// Files that cannot be written.
    pub fn write(&self, sample: &Sample, fits: &[CellFit], pages: bool) -> Result<()> {
        for (name, bytes) in &result_files(sample, fits, &self.options, self.files.shown())? {
            self.write_file(name, bytes)?;
        }
        if fits.len() < self.manifest.fits() {
            return Ok(self.files.settle()?);
        }
        self.files.complete()?;
        if pages {
            self.files.discard(CELLS);
        }
        Ok(self.files.settle()?)
    }
}

/// The file of a finished fit.
fn cell(number: usize) -> String {
    format!("{CELLS}{number}.json.gz")
}
