//! Atomic output: everything is written next to its destination and renamed when complete.

use super::disk;
use super::leftovers::{Place, remove, replaced, sweep};
use motiform_study::Error;
use motiform_study::input;
use std::fs;
use std::path::{Path, PathBuf};

/// The name of the manifest in every dataset folder.
pub(super) const MANIFEST: &str = "manifest.json";

/// A place where output is written before it is renamed. Dropped without [`Staging::commit`], it leaves nothing behind.
#[derive(Debug)]
pub struct Staging {
    target: PathBuf,
    place: Place,
    folder: bool,
    force: bool,
    committed: bool,
    swept: Vec<String>,
}

impl Staging {
    /// Prepares a folder (`folder`) or a file at `target`, before any work is done.
    ///
    /// # Errors
    /// [`Error::Exists`] without `force`; [`Error::NotOurs`] for a folder that is not a dataset; [`Error::Unwritable`].
    pub fn new(target: &Path, folder: bool, force: bool) -> Result<Self, Error> {
        Self::prepare(target, folder, force, if folder { is_dataset } else { Path::is_file })
    }

    /// Prepares a folder at `target`; with `force`, it may replace one that is `ours`.
    ///
    /// # Errors
    /// As [`Staging::new`].
    pub fn replacing(target: &Path, force: bool, ours: fn(&Path) -> bool) -> Result<Self, Error> {
        Self::prepare(target, true, force, ours)
    }

    fn prepare(target: &Path, folder: bool, force: bool, ours: fn(&Path) -> bool) -> Result<Self, Error> {
        let swept = sweep(target);
        if target.symlink_metadata().is_ok() {
            if !force {
                return Err(Error::Exists { path: target.to_owned() });
            }
            if !ours(target) {
                return Err(Error::NotOurs { path: target.to_owned() });
            }
        }
        let unwritable = |reason| Error::Unwritable { path: target.to_owned(), reason };
        if target.file_name().is_none() {
            let reason = std::io::Error::new(std::io::ErrorKind::InvalidInput, "the path has no last part");
            return Err(unwritable(reason));
        }
        let place = Place::make(target, folder).map_err(unwritable)?;
        Ok(Self { target: target.to_owned(), place, folder, force, committed: false, swept })
    }

    /// The leftovers of killed runs with this target that were found and removed, in sentences.
    #[must_use]
    pub fn swept(&self) -> &[String] {
        &self.swept
    }

    /// Where to write: the folder, or the file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.place.path
    }

    /// Where it will be.
    #[must_use]
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// The same failure with the final name of the output.
    #[must_use]
    pub fn shown(&self, error: Error) -> Error {
        match error {
            Error::WriteFailed { path, reason } if path == self.path() => {
                Error::WriteFailed { path: self.target.clone(), reason }
            }
            Error::WriteFailed { path, reason } => match path.strip_prefix(self.path()) {
                Ok(name) => Error::WriteFailed { path: self.target.join(name), reason },
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
            .map_err(|error| Error::write_failed(&self.target.join(name), error))
    }

    /// Renames the output to its final name, replacing existing output if that was allowed.
    ///
    /// # Errors
    /// [`Error::Exists`] if something appeared there in the meantime, [`Error::WriteFailed`].
    pub fn commit(mut self) -> Result<PathBuf, Error> {
        let failed = |error| Error::write_failed(&self.target, error);
        let there = self.target.symlink_metadata().is_ok();
        if there && !self.force {
            return Err(Error::Exists { path: self.target.clone() });
        }
        self.sync().map_err(failed)?;
        if there && self.folder {
            self.replace().map_err(failed)?;
        } else {
            disk::rename(self.path(), &self.target).map_err(failed)?;
        }
        self.committed = true;
        Ok(self.target.clone())
    }

    fn sync(&self) -> std::io::Result<()> {
        if self.folder { disk::sync_all(self.path()) } else { fs::File::open(self.path())?.sync_all() }
    }

    /// Replaces the existing folder; if the system can exchange two folders, one exists at every moment.
    fn replace(&self) -> std::io::Result<()> {
        if disk::exchange(self.path(), &self.target) {
            remove(self.path()); // the old one, which has the unfinished one's name now
            return disk::sync_folder(self.target.parent().unwrap_or(Path::new(".")));
        }
        let old = replaced(&self.target);
        fs::rename(&self.target, &old)?;
        disk::rename(self.path(), &self.target).inspect_err(|_| {
            let _ = fs::rename(&old, &self.target); // what was there is better than nothing
        })?;
        remove(&old);
        Ok(())
    }
}

/// Whether motiform wrote a folder. Many programs use the name `manifest.json`: the file must state that motiform wrote it.
fn is_dataset(folder: &Path) -> bool {
    let manifest = input::manifest(&folder.join(MANIFEST)).unwrap_or_default();
    let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap_or_default();
    manifest["motiform"].is_string() && manifest["plan_hash"].is_string()
}

/// Writes a file atomically, replacing an existing one.
///
/// # Errors
/// [`Error::Unwritable`], [`Error::WriteFailed`].
pub fn replace_file(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let force = path.symlink_metadata().is_ok();
    let staging = Staging::new(path, false, force)?;
    fs::write(staging.path(), bytes).map_err(|error| Error::write_failed(path, error))?;
    staging.commit().map(drop)
}

impl Drop for Staging {
    fn drop(&mut self) {
        if !self.committed {
            remove(self.path());
        }
    }
}
