//! Results that are complete, interrupted, or given up.

use super::Folder;
use crate::replace::{replaced, retire, retires};
use crate::survey::Survey;
use crate::{Error, INVENTORY, Inventory, disk, lock};
use std::fs::{self, File};

impl Folder {
    /// Checks that no listed file is changed, figures excepted, so that work of hours is not done in vain.
    /// Changed files of unfinished work (in a folder whose name begins with `_`) are kept under another name,
    /// with a note: they are computed again.
    ///
    /// # Errors
    /// [`Error::Changed`], [`Error::WriteFailed`].
    pub fn check(&self) -> Result<(), Error> {
        let survey = Survey::of(&self.path, &self.state().inventory).map_err(Error::unwritable(&self.shown));
        for name in survey?.changed {
            if !(name.starts_with('_') && name.contains('/')) {
                return Err(Error::Changed { path: self.shown.join(name) });
            }
            self.keep_aside(&name)?;
        }
        Ok(())
    }

    /// Takes a result away whose computation failed before there was anything of it, and puts back what it
    /// replaced. What was written by then stays, for a run that goes on with it: a full disk must not cost
    /// hours.
    pub fn abandon(self) {
        let Some(target) = self.new.as_ref().filter(|_| self.state().files == 0) else {
            let _ = self.settle(); // if this fails, too, the lines of the inventory say the same
            return;
        };
        self.names().iter().for_each(|name| self.discard(name));
        let inventory = self.path.join(INVENTORY);
        if fs::read_dir(&self.path).is_ok_and(|rest| rest.count() == 1) {
            let _ = fs::remove_file(inventory).and_then(|()| fs::remove_dir(&self.path));
        }
        if let Some(old) = replaced(&self.path).iter().filter(|old| retires(old, &self.path)).max() {
            let _ = disk::rename_new(old, &self.path); // it fails where something is left
        }
        target.undo();
    }

    /// Says that the result is complete: its inventory gets its final bytes, and what it replaced is taken away.
    ///
    /// # Errors
    /// [`Error::WriteFailed`].
    pub fn complete(&self) -> Result<(), Error> {
        self.settle_as(true)
    }

    /// Gives the inventory the bytes that depend only on the files that are there; the result is complete if it was.
    ///
    /// # Errors
    /// [`Error::WriteFailed`].
    pub fn settle(&self) -> Result<(), Error> {
        let complete = self.is_complete();
        self.settle_as(complete)
    }

    fn settle_as(&self, complete: bool) -> Result<(), Error> {
        let failed = |error: std::io::Error| Error::write_failed(&self.shown, error);
        let mut state = self.state();
        if state.log.is_none() {
            return Ok(());
        }
        let listed = std::mem::take(&mut state.inventory.files);
        let mut inventory = Inventory {
            version: state.inventory.version.clone(),
            kind: state.inventory.kind.clone(),
            complete,
            ..Inventory::default()
        };
        inventory.files =
            listed.into_iter().filter_map(|(name, digests)| self.one_digest(name, digests)).collect();
        state.announce(&self.start).map_err(failed)?;
        let new = self.path.join(format!("{}0.partial", self.start));
        disk::write(&new, inventory.text().as_bytes()).map_err(failed)?;
        let lock = lock::lock_file(&new, &self.shown)?;
        disk::rename(&new, &self.path.join(INVENTORY)).map_err(failed)?;
        state.log = Some(File::options().append(true).open(self.path.join(INVENTORY)).map_err(failed)?);
        state.announced = false;
        state.locks.push(lock);
        state.inventory = inventory;
        if complete {
            for old in replaced(&self.path) {
                retire(&old, &self.path).map_err(failed)?;
            }
        }
        Ok(())
    }

    /// A file that is there, with the one digest that it has.
    fn one_digest(&self, name: String, mut digests: Vec<String>) -> Option<(String, Vec<String>)> {
        let path = self.path.join(&name);
        path.symlink_metadata().ok()?;
        if digests.len() > 1 {
            let there = crate::sha256_file(&path).unwrap_or_default();
            let last = digests.pop()?;
            digests.retain(|digest| *digest == there && there != last);
            if digests.is_empty() {
                digests.push(last);
            }
        }
        Some((name, digests))
    }
}
