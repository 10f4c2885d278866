//! Output that appears whole or not at all: everything is written beside its place and renamed when complete.

use crate::Error;
use std::fs;
use std::path::{Path, PathBuf};

/// The name every dataset folder's manifest has.
pub(super) const MANIFEST: &str = "manifest.json";

/// A place where output is written before it gets its name. Dropped without [`Staging::commit`], it leaves nothing.
#[derive(Debug)]
pub struct Staging {
    target: PathBuf,
    partial: PathBuf,
    folder: bool,
    force: bool,
    committed: bool,
}

impl Staging {
    /// Prepares a folder (`folder`) or a file at `target`, before any work is done.
    ///
    /// # Errors
    /// [`Error::Exists`] without `force`; [`Error::NotOurs`] for a folder that is no dataset; [`Error::Unwritable`].
    pub fn new(target: &Path, folder: bool, force: bool) -> Result<Self, Error> {
        Self::prepare(target, folder, force, if folder { is_dataset } else { Path::is_file })
    }

    /// Prepares a folder at `target` that may replace, with `force`, one that is `ours`.
    ///
    /// # Errors
    /// As [`Staging::new`].
    pub fn replacing(target: &Path, force: bool, ours: fn(&Path) -> bool) -> Result<Self, Error> {
        Self::prepare(target, true, force, ours)
    }

    fn prepare(target: &Path, folder: bool, force: bool, ours: fn(&Path) -> bool) -> Result<Self, Error> {
        if target.symlink_metadata().is_ok() {
            if !force {
                return Err(Error::Exists { path: target.to_owned() });
            }
            if !ours(target) {
                return Err(Error::NotOurs { path: target.to_owned() });
            }
        }
        let unwritable = |reason| Error::Unwritable { path: target.to_owned(), reason };
        let name = target.file_name().ok_or_else(|| {
            unwritable(std::io::Error::new(std::io::ErrorKind::InvalidInput, "the path has no last part"))
        })?;
        let partial =
            target.with_file_name(format!(".{}.{}.partial", name.to_string_lossy(), std::process::id()));
        if folder {
            fs::create_dir(&partial).map_err(unwritable)?;
        } else {
            fs::File::create_new(&partial).map_err(unwritable)?;
        }
        Ok(Self { target: target.to_owned(), partial, folder, force, committed: false })
    }

    /// Where to write: the folder, or the file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.partial
    }

    /// Where it will be.
    #[must_use]
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// Writes a file inside the folder.
    ///
    /// # Errors
    /// [`Error::WriteFailed`], naming the file as it would have been called.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Error> {
        fs::write(self.partial.join(name), bytes)
            .map_err(|error| Error::write_failed(&self.target.join(name), error))
    }

    /// Gives the output its name, replacing what was there if that was allowed.
    ///
    /// # Errors
    /// [`Error::Exists`] if something appeared there in the meantime, [`Error::WriteFailed`].
    pub fn commit(mut self) -> Result<PathBuf, Error> {
        let failed = |error| Error::write_failed(&self.target, error);
        let there = self.target.symlink_metadata().is_ok();
        if there && !self.force {
            return Err(Error::Exists { path: self.target.clone() });
        }
        if there && self.folder {
            let old = self.partial.with_extension("replaced");
            fs::rename(&self.target, &old).map_err(failed)?;
            if let Err(error) = fs::rename(&self.partial, &self.target) {
                let _ = fs::rename(&old, &self.target); // what was there is better than nothing
                return Err(failed(error));
            }
            fs::remove_dir_all(&old).map_err(failed)?;
        } else {
            fs::rename(&self.partial, &self.target).map_err(failed)?;
        }
        self.committed = true;
        Ok(self.target.clone())
    }
}

/// Whether a folder is one of ours. Many programs call a file `manifest.json`: it must say that motiform wrote it.
fn is_dataset(folder: &Path) -> bool {
    let manifest = fs::read(folder.join(MANIFEST)).unwrap_or_default();
    let manifest: serde_json::Value = serde_json::from_slice(&manifest).unwrap_or_default();
    manifest["motiform"].is_string() && manifest["plan_hash"].is_string()
}

/// Writes a file whole or not at all, replacing an earlier one.
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
            // Nothing to be done about a failure here: the partial name says what it is.
            let _ =
                if self.folder { fs::remove_dir_all(&self.partial) } else { fs::remove_file(&self.partial) };
        }
    }
}
