//! Single files: their inventory is a hidden file beside them.

use crate::draft::Draft;
use crate::place::name_of;
use crate::survey::is_ours;
use crate::target::Target;
use crate::{Error, Inventory, Kind, disk, lock, sha256_file};
use std::fs::{self, File};
use std::path::{Path, PathBuf};

/// A file that is written beside its place and renamed when it is complete. Dropped without
/// [`StagedFile::commit`], it leaves nothing behind.
#[derive(Debug)]
pub struct StagedFile(Draft);

impl StagedFile {
    /// Prepares a file at `target`. With `force` it replaces one that motiform wrote and nobody changed.
    ///
    /// # Errors
    /// [`Error::Exists`] without `force`; [`Error::NotOurs`] and [`Error::Changed`] for what is not replaced;
    /// [`Error::Busy`]; [`Error::Unwritable`].
    pub fn new(target: &Path, kind: Kind, force: bool) -> Result<Self, Error> {
        Draft::new(Target::new(target)?, kind, |target, _| admit(target, force)).map(Self)
    }

    /// Leftovers of killed runs that were removed.
    pub fn notes(&self) -> &[String] {
        &self.0.notes
    }

    /// The path to write to.
    pub fn path(&self) -> PathBuf {
        self.0.place.result().join(name_of(&self.0.target.path))
    }

    /// The same failure with the final name of the output.
    pub fn shown(&self, error: Error) -> Error {
        self.0.shown(error, |_| self.0.target.shown.clone())
    }

    /// Gives the file its name, which is returned.
    ///
    /// # Errors
    /// [`Error::Exists`] if something appeared there in the meantime, [`Error::Changed`], [`Error::WriteFailed`].
    pub fn commit(mut self) -> Result<PathBuf, Error> {
        let new = self.path();
        let failed = |error| self.0.failed(error);
        File::open(&new).and_then(|file| file.sync_all()).map_err(failed)?;
        let mut inventory = Inventory { complete: true, ..Inventory::new(self.0.kind) };
        inventory.list(&name_of(&self.0.target.path), &sha256_file(&new).map_err(failed)?);
        let before = Inventory::read_file(&inventory_of(&self.0.target.path))?;
        match before.filter(|_| self.0.held.is_some()) {
            Some(before) => self.replace(&new, &inventory, &before)?,
            None => self.appear(&new, &inventory)?,
        }
        self.0.done();
        Ok(self.0.target.shown.clone())
    }

    /// Puts the new file over the old one: its inventory lists both until the old one is gone.
    fn replace(&self, new: &Path, inventory: &Inventory, before: &Inventory) -> Result<(), Error> {
        let path = &self.0.target.path;
        let failed = |error| self.0.failed(error);
        let known = before.files.get(&name_of(path)).cloned().unwrap_or_default();
        if path.symlink_metadata().is_ok() && !is_ours(path, &known).map_err(failed)? {
            return Err(Error::Changed { path: self.0.target.shown.clone() });
        }
        let mut both = inventory.clone();
        known.iter().for_each(|digest| both.list(&name_of(path), digest));
        self.list(&both).map_err(failed)?;
        disk::rename(new, path).map_err(failed)?;
        self.list(inventory).map_err(failed)
    }

    fn appear(&self, new: &Path, inventory: &Inventory) -> Result<(), Error> {
        let listed = self.list(inventory).map_err(|error| self.0.failed(error));
        listed.and_then(|()| self.0.appear(new)).inspect_err(|_| {
            if !self.0.target.exists() {
                let _ = fs::remove_file(inventory_of(&self.0.target.path)); // it would list what is not there
            }
        })
    }

    /// Writes the inventory beside the file, at once.
    fn list(&self, inventory: &Inventory) -> std::io::Result<()> {
        let new = self.0.place.result().join("inventory");
        disk::write(&new, inventory.text().as_bytes())?;
        disk::rename(&new, &inventory_of(&self.0.target.path))
    }
}

/// The inventory of a single file: `run.csv` -> `.run.csv.inventory`.
fn inventory_of(path: &Path) -> PathBuf {
    path.with_file_name(format!(".{}.inventory", name_of(path)))
}

/// The lock of a file that may be replaced, if there is one.
fn admit(target: &Target, force: bool) -> Result<Option<File>, Error> {
    let shown = || target.shown.clone();
    let beside = inventory_of(&target.path);
    let Ok(inventory) = Inventory::read_file(&beside) else { return Err(Error::NotOurs { path: beside }) };
    if !target.exists() {
        return Ok(None);
    }
    if !force {
        return Err(Error::Exists { path: shown() });
    }
    let known = inventory.and_then(|found| found.files.get(&name_of(&target.path)).cloned());
    let Some(known) = known.filter(|_| target.path.is_file()) else {
        return Err(Error::NotOurs { path: shown() });
    };
    if !is_ours(&target.path, &known).map_err(Error::unwritable(&target.shown))? {
        return Err(Error::Changed { path: shown() });
    }
    lock::lock_file(&beside, &target.shown).map(Some)
}
