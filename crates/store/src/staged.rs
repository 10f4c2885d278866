//! Results that are there whole or not at all.

use crate::place::{Place, name_of, sweep};
use crate::replace::{replace, replaced, retire};
use crate::survey::{Survey, kept};
use crate::target::Target;
use crate::{Error, INVENTORY, Inventory, Kind, disk, lock, mend, sha256_file};
use std::fs::{self, File};
use std::path::{Path, PathBuf};

/// A folder that is written beside its place and renamed when it is complete. Dropped without [`Staged::commit`], it leaves nothing behind.
#[derive(Debug)]
pub struct Staged {
    target: Target,
    kind: Kind,
    place: Place,
    /// The lock of the result that is replaced.
    held: Option<File>,
    /// Whether it replaces a folder with nothing in it.
    onto_empty: bool,
    notes: Vec<String>,
    committed: bool,
}

impl Staged {
    /// Prepares a folder at `target`, before any work is done. With `force` it replaces a result of the same kind; what is not ours there stays.
    ///
    /// # Errors
    /// [`Error::Exists`] and [`Error::Resumable`] without `force`; [`Error::NotOurs`], [`Error::OtherKind`] and [`Error::Changed`] for what is
    /// not replaced; [`Error::NamedAsFile`]; [`Error::Busy`]; [`Error::Unwritable`].
    pub fn new(target: &Path, kind: Kind, force: bool) -> Result<Self, Error> {
        let target = Target::folder(target)?;
        let prepared = prepare(&target, kind, force);
        let (place, held, notes) = prepared.inspect_err(|_| target.undo())?;
        let onto_empty = held.is_none() && target.exists();
        Ok(Self { target, kind, place, held, onto_empty, notes, committed: false })
    }

    /// What was found in the place: leftovers of killed runs, and files that stay.
    #[must_use]
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// Where to write.
    #[must_use]
    pub fn path(&self) -> PathBuf {
        self.place.result()
    }

    /// Where it will be, as given.
    #[must_use]
    pub fn target(&self) -> &Path {
        &self.target.shown
    }

    /// The same failure with the final name of the output.
    #[must_use]
    pub fn shown(&self, error: Error) -> Error {
        match error {
            Error::WriteFailed { path, reason } => match path.strip_prefix(self.path()) {
                Ok(name) => Error::WriteFailed { path: self.target.shown.join(name), reason },
                Err(_) => Error::WriteFailed { path, reason },
            },
            other => other,
        }
    }

    /// Writes a file inside the folder.
    ///
    /// # Errors
    /// [`Error::WriteFailed`] with the final name of the file.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Error> {
        disk::write(&self.path().join(name), bytes)
            .map_err(|error| Error::write_failed(&self.target.shown.join(name), error))
    }

    /// Writes the inventory and gives the folder its name. Returns the name, and what stayed in its place, in sentences.
    ///
    /// # Errors
    /// [`Error::Exists`] if something appeared there in the meantime, [`Error::Changed`], [`Error::Taken`], [`Error::WriteFailed`].
    pub fn commit(self) -> Result<(PathBuf, Vec<String>), Error> {
        let (target, _, notes) = self.finish(true)?;
        Ok((target.shown, notes))
    }

    /// Gives the folder its name; its place, its lock, and what stayed there, in sentences.
    pub(crate) fn finish(mut self, complete: bool) -> Result<(Target, File, Vec<String>), Error> {
        let failed = |error: std::io::Error| Error::write_failed(&self.target.shown, error);
        let new = self.path();
        let mut inventory = Inventory { complete, ..Inventory::new(self.kind) };
        list(&new, &mut inventory).map_err(failed)?;
        disk::write(&new.join(INVENTORY), inventory.text().as_bytes()).map_err(failed)?;
        disk::sync_folder(&new).map_err(failed)?;
        let own = lock::lock(&new, &self.target.shown)?;
        let mut notes = Vec::new();
        if self.held.is_some() {
            notes = replace(&self.place, &self.target.path, &self.target.shown)?;
        } else {
            if self.onto_empty {
                let _ = fs::remove_dir(&self.target.path); // it fails where something is inside by now
            }
            disk::rename_new(&new, &self.target.path).map_err(|error| match error.kind() {
                std::io::ErrorKind::AlreadyExists => Error::Exists { path: self.target.shown.clone() },
                _ => failed(error),
            })?;
        }
        self.committed = true;
        self.place.remove();
        if complete {
            replaced(&self.target.path).iter().for_each(|old| drop(retire(old, &self.target.path)));
        }
        Ok((self.target.clone(), own, notes))
    }
}

impl Drop for Staged {
    fn drop(&mut self) {
        if !self.committed {
            self.held = None;
            // What was replaced by then, and is not ours, may be in the place: the next run goes on or takes it out.
            if Inventory::read(&self.place.old()).is_ok_and(|old| old.is_none()) {
                self.place.remove();
                self.target.undo();
            }
        }
    }
}

type Prepared = (Place, Option<File>, Vec<String>);

fn prepare(target: &Target, kind: Kind, force: bool) -> Result<Prepared, Error> {
    mend(&target.path)?;
    let mut notes = sweep(&target.path);
    let empty = kind == Kind::Report && is_empty(&target.path);
    let held = if target.exists() && !empty { Some(admit(target, kind, force, &mut notes)?) } else { None };
    let place = Place::make(&target.path, kind).map_err(Error::unwritable(&target.shown))?;
    Ok((place, held, notes))
}

/// Whether there is a folder with nothing in it.
pub(crate) fn is_empty(path: &Path) -> bool {
    path.symlink_metadata().is_ok_and(|there| there.is_dir())
        && fs::read_dir(path).is_ok_and(|mut entries| entries.next().is_none())
}

/// The lock of a result that may be replaced.
fn admit(target: &Target, kind: Kind, force: bool, notes: &mut Vec<String>) -> Result<File, Error> {
    let (shown, path) = (&target.shown, &target.path);
    let inventory = owned(target, kind)?;
    if !force {
        let shown = shown.clone();
        return Err(if kind.resumes() {
            Error::Resumable { path: shown, kind }
        } else {
            Error::Exists { path: shown }
        });
    }
    let lock = lock::lock(path, shown)?;
    let survey = Survey::of(path, &inventory).map_err(Error::unwritable(shown))?;
    if let Some(name) = survey.changed.first() {
        return Err(Error::Changed { path: shown.join(name) });
    }
    notes.extend(kept(shown, &survey.foreign));
    Ok(lock)
}

/// The inventory of a folder that exists, of the kind asked for.
///
/// # Errors
/// [`Error::NotOurs`], [`Error::OtherKind`], [`Error::Inventory`].
pub(crate) fn owned(target: &Target, kind: Kind) -> Result<Inventory, Error> {
    let path = target.shown.clone();
    let Some(inventory) = Inventory::read(&target.path)? else { return Err(Error::NotOurs { path }) };
    if inventory.kind != kind.name() {
        return Err(Error::OtherKind { path, found: inventory.words(), asked: kind });
    }
    Ok(inventory)
}

/// Lists the files of a folder with their digests, and waits until they are on disk: both at the same time.
fn list(folder: &Path, inventory: &mut Inventory) -> std::io::Result<()> {
    let mut names = Vec::new();
    collect(folder, "", &mut names)?;
    let synced = || names.iter().try_for_each(|name| File::open(folder.join(name))?.sync_all());
    std::thread::scope(|scope| {
        let syncing = scope.spawn(synced);
        for name in &names {
            inventory.list(name, &sha256_file(&folder.join(name))?);
        }
        syncing.join().unwrap_or_else(|_| Err(std::io::Error::other("a file could not be synchronised")))
    })
}

/// The names of all files below a folder.
fn collect(folder: &Path, prefix: &str, names: &mut Vec<String>) -> std::io::Result<()> {
    for entry in fs::read_dir(folder.join(prefix))?.collect::<std::io::Result<Vec<_>>>()? {
        let name = format!("{prefix}{}", name_of(&entry.path()));
        if entry.file_type()?.is_dir() {
            collect(folder, &format!("{name}/"), names)?;
        } else {
            names.push(name);
        }
    }
    Ok(())
}
