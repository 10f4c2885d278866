//! Single files: their inventory is a hidden file beside them.

use crate::place::{Place, name_of, sweep};
use crate::survey::is_ours;
use crate::target::Target;
use crate::{Error, Inventory, Kind, disk, lock, sha256_file};
use std::fs::{self, File};
use std::path::{Path, PathBuf};

/// A file that is written beside its place and renamed when it is complete. Dropped without [`StagedFile::commit`], it leaves nothing behind.
#[derive(Debug)]
pub struct StagedFile {
    target: Target,
    kind: Kind,
    place: Place,
    held: Option<File>,
    notes: Vec<String>,
    committed: bool,
}

impl StagedFile {
    /// Prepares a file at `target`. With `force` it replaces one that motiform wrote and nobody changed.
    ///
    /// # Errors
    /// [`Error::Exists`] without `force`; [`Error::NotOurs`] and [`Error::Changed`] for what is not replaced; [`Error::Busy`]; [`Error::Unwritable`].
    pub fn new(target: &Path, kind: Kind, force: bool) -> Result<Self, Error> {
        let target = Target::new(target)?;
        let prepared = prepare(&target, kind, force);
        let (place, held, notes) = prepared.inspect_err(|_| target.undo())?;
        Ok(Self { target, kind, place, held, notes, committed: false })
    }

    /// Leftovers of killed runs that were removed.
    #[must_use]
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// Where to write.
    #[must_use]
    pub fn path(&self) -> PathBuf {
        self.place.result().join(name_of(&self.target.path))
    }

    /// The same failure with the final name of the output.
    #[must_use]
    pub fn shown(&self, error: Error) -> Error {
        match error {
            Error::WriteFailed { path, reason } if path == self.path() => {
                Error::WriteFailed { path: self.target.shown.clone(), reason }
            }
            other => other,
        }
    }

    /// Gives the file its name, which is returned.
    ///
    /// # Errors
    /// [`Error::Exists`] if something appeared there in the meantime, [`Error::Changed`], [`Error::WriteFailed`].
    pub fn commit(mut self) -> Result<PathBuf, Error> {
        let (shown, path, new) = (self.target.shown.clone(), self.target.path.clone(), self.path());
        let failed = |error: std::io::Error| Error::write_failed(&shown, error);
        File::open(&new).and_then(|file| file.sync_all()).map_err(failed)?;
        let mut inventory = Inventory { complete: true, ..Inventory::new(self.kind) };
        inventory.list(&name_of(&path), &sha256_file(&new).map_err(failed)?);
        let beside = inventory_of(&path);
        let before = Inventory::read_file(&beside)?;
        if let (Some(_), Some(before)) = (&self.held, before) {
            let known = before.files.get(&name_of(&path)).cloned().unwrap_or_default();
            if path.symlink_metadata().is_ok() && !is_ours(&path, &known).map_err(failed)? {
                return Err(Error::Changed { path: shown });
            }
            let mut both = inventory.clone();
            known.iter().for_each(|digest| both.list(&name_of(&path), digest));
            self.list(&both, &beside).map_err(failed)?;
            disk::rename(&new, &path).map_err(failed)?;
            self.list(&inventory, &beside).map_err(failed)?;
        } else {
            let appear = || {
                self.list(&inventory, &beside)?;
                disk::rename_new(&new, &path)
            };
            appear().map_err(|error| {
                if path.symlink_metadata().is_err() {
                    let _ = fs::remove_file(&beside); // it would list what is not there
                }
                match error.kind() {
                    std::io::ErrorKind::AlreadyExists => Error::Exists { path: shown.clone() },
                    _ => failed(error),
                }
            })?;
        }
        self.committed = true;
        self.place.remove();
        Ok(shown)
    }

    /// Writes the inventory beside the file, at once.
    fn list(&self, inventory: &Inventory, beside: &Path) -> std::io::Result<()> {
        let new = self.place.result().join("inventory");
        disk::write(&new, inventory.text().as_bytes())?;
        disk::rename(&new, beside)
    }
}

impl Drop for StagedFile {
    fn drop(&mut self) {
        if !self.committed {
            self.held = None;
            self.place.remove();
            self.target.undo();
        }
    }
}

/// The inventory of a single file: `run.csv` -> `.run.csv.inventory`.
fn inventory_of(path: &Path) -> PathBuf {
    path.with_file_name(format!(".{}.inventory", name_of(path)))
}

fn prepare(target: &Target, kind: Kind, force: bool) -> Result<(Place, Option<File>, Vec<String>), Error> {
    let notes = sweep(&target.path);
    let shown = || target.shown.clone();
    let beside = inventory_of(&target.path);
    let Ok(inventory) = Inventory::read_file(&beside) else { return Err(Error::NotOurs { path: beside }) };
    let mut held = None;
    if target.exists() {
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
        held = Some(lock::lock_file(&beside, &target.shown)?);
    }
    let place = Place::make(&target.path, kind).map_err(Error::unwritable(&target.shown))?;
    Ok((place, held, notes))
}
