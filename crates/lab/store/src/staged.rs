//! Results that are there whole or not at all.

use crate::draft::Draft;
use crate::place::name_of;
use crate::replace::{replace, replaced, retire};
use crate::survey::{Survey, kept};
use crate::target::Target;
use crate::{Error, INVENTORY, Inventory, Kind, disk, lock, mend, sha256_file};
use std::fs::{self, File};
use std::path::{Path, PathBuf};

/// A folder that is written beside its place and renamed when it is complete. Dropped without [`Staged::commit`], it leaves nothing behind.
#[derive(Debug)]
pub struct Staged {
    draft: Draft,
    /// `true` if it replaces an empty folder.
    onto_empty: bool,
}

impl Staged {
    /// Prepares a folder at `target`, before any work is done. With `force` it replaces a result of the same
    /// kind; what is not ours there stays.
    ///
    /// # Errors
    /// [`Error::Exists`] and [`Error::Resumable`] without `force`; [`Error::NotOurs`], [`Error::OtherKind`]
    /// and [`Error::Changed`] for what is not replaced; [`Error::NamedAsFile`]; [`Error::Busy`];
    /// [`Error::Unwritable`].
    pub fn new(target: &Path, kind: Kind, force: bool) -> Result<Self, Error> {
        let target = Target::folder(target)?;
        mend(&target.path)?;
        let onto_empty = kind == Kind::Report && is_empty(&target.path);
        let draft = Draft::new(target, kind, |target, notes| {
            let is_free = onto_empty || !target.exists();
            (!is_free).then(|| admit(target, kind, force, notes)).transpose()
        })?;
        Ok(Self { draft, onto_empty })
    }

    /// The remarks on the place: leftovers of killed runs, and files that stay.
    pub fn notes(&self) -> &[String] {
        &self.draft.notes
    }

    /// The path to write to.
    pub fn path(&self) -> PathBuf {
        self.draft.place.result()
    }

    /// The path of the finished output, as given.
    pub fn target(&self) -> &Path {
        &self.draft.target.shown
    }

    /// The same failure with the final name of the output.
    pub fn shown(&self, error: Error) -> Error {
        self.draft.shown(error, |name| self.target().join(name))
    }

    /// Writes a file inside the folder.
    ///
    /// # Errors
    /// [`Error::WriteFailed`] with the final name of the file.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Error> {
        disk::write(&self.path().join(name), bytes)
            .map_err(|error| Error::write_failed(&self.target().join(name), error))
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
    pub(crate) fn finish(self, complete: bool) -> Result<(Target, File, Vec<String>), Error> {
        let Self { mut draft, onto_empty } = self;
        let failed = |error| draft.failed(error);
        let new = draft.place.result();
        let mut inventory = Inventory { complete, ..Inventory::new(draft.kind) };
        list(&new, &mut inventory).map_err(failed)?;
        disk::write(&new.join(INVENTORY), inventory.text().as_bytes()).map_err(failed)?;
        disk::sync_folder(&new).map_err(failed)?;
        let own = lock::lock(&new, &draft.target.shown)?;
        let mut notes = Vec::new();
        if draft.held.is_some() {
            notes = replace(&draft.place, &draft.target.path, &draft.target.shown)?;
        } else {
            if onto_empty {
                let _ = fs::remove_dir(&draft.target.path); // it fails where something is inside by now
            }
            draft.appear(&new)?;
        }
        draft.done();
        let target = draft.target.clone();
        if complete {
            replaced(&target.path).iter().for_each(|old| drop(retire(old, &target.path)));
        }
        Ok((target, own, notes))
    }
}

/// Returns `true` if there is an empty folder at the path.
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
