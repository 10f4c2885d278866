//! Output that is not complete yet, beside its place.

use crate::place::{Place, sweep};
use crate::target::Target;
use crate::{Error, Inventory, Kind, disk};
use std::fs::File;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// A folder or file that is written beside its place. Dropped before [`Draft::done`], it leaves nothing behind.
#[derive(Debug)]
pub(crate) struct Draft {
    pub(crate) target: Target,
    pub(crate) kind: Kind,
    pub(crate) place: Place,
    /// The lock of what is replaced, if something is.
    pub(crate) held: Option<File>,
    /// The remarks on the place, in sentences.
    pub(crate) notes: Vec<String>,
    is_done: bool,
}

impl Draft {
    /// Makes a place beside `target`. `admit` gives the lock of what is there and may be replaced, if there is something.
    ///
    /// # Errors
    /// Those of `admit`; [`Error::Unwritable`].
    pub(crate) fn new(
        target: Target,
        kind: Kind,
        admit: impl FnOnce(&Target, &mut Vec<String>) -> Result<Option<File>, Error>,
    ) -> Result<Self, Error> {
        let prepare = || {
            let mut notes = sweep(&target.path);
            let held = admit(&target, &mut notes)?;
            let place = Place::make(&target.path, kind).map_err(Error::unwritable(&target.shown))?;
            Ok((place, held, notes))
        };
        let (place, held, notes) = prepare().inspect_err(|_| target.undo())?;
        Ok(Self { target, kind, place, held, notes, is_done: false })
    }

    /// The same failure with the final name of the file; `name` finds it from that in the place.
    pub(crate) fn shown(&self, error: Error, name: impl Fn(&Path) -> PathBuf) -> Error {
        match error {
            Error::WriteFailed { path, reason } => {
                let path = path.strip_prefix(self.place.result()).map(name).unwrap_or(path.clone());
                Error::WriteFailed { path, reason }
            }
            other => other,
        }
    }

    /// A failure to write the output.
    pub(crate) fn failed(&self, error: impl std::fmt::Display) -> Error {
        Error::write_failed(&self.target.shown, error)
    }

    /// Gives what is new the name of the target, which nothing must have by now.
    ///
    /// # Errors
    /// [`Error::Exists`], [`Error::WriteFailed`].
    pub(crate) fn appear(&self, new: &Path) -> Result<(), Error> {
        disk::rename_new(new, &self.target.path).map_err(|error| match error.kind() {
            ErrorKind::AlreadyExists => Error::Exists { path: self.target.shown.clone() },
            _ => self.failed(error),
        })
    }

    /// The output has its name: the place goes.
    pub(crate) fn done(&mut self) {
        self.is_done = true;
        self.place.remove();
    }
}

impl Drop for Draft {
    fn drop(&mut self) {
        if self.is_done {
            return;
        }
        self.held = None;
        // What was replaced by then, and is not ours, may be in the place: the next run goes on or takes it out.
        if Inventory::read(&self.place.old()).is_ok_and(|old| old.is_none()) {
            self.place.remove();
            self.target.undo();
        }
    }
}
