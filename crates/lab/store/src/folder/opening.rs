//! Results that are begun, or gone on with.

use super::{Folder, State};
use crate::place::{name_of, number, sweep};
use crate::replace::{replaced, retires};
use crate::staged::{is_empty, owned};
use crate::survey::{Survey, kept, remove_partials};
use crate::target::Target;
use crate::{Error, INVENTORY, Inventory, Kind, Staged, lock, mend};
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// The treatment of a result that exists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Opening {
    /// Refuse it.
    New,
    /// Go on with it.
    Resume,
    /// Replace it.
    Replace,
}

impl Opening {
    /// That of the options `--resume` and `--force`.
    pub fn of(resume: bool, force: bool) -> Self {
        match (resume, force) {
            (true, _) => Self::Resume,
            (_, true) => Self::Replace,
            _ => Self::New,
        }
    }
}

impl Folder {
    /// Opens a folder as `opening` says; a new one has `files` from the beginning (such as its manifest).
    ///
    /// # Errors
    /// Those of [`Staged::new`] and [`Folder::resume`].
    pub fn open(shown: &Path, kind: Kind, opening: Opening, files: &[(&str, &[u8])]) -> Result<Self, Error> {
        if opening == Opening::Resume {
            let target = Target::new(shown)?;
            if target.exists() && !(kind == Kind::Report && is_empty(&target.path)) {
                return Self::resume(shown, kind);
            }
        }
        let staged = Staged::new(shown, kind, opening == Opening::Replace)?;
        for (name, bytes) in files {
            staged.write(name, bytes)?;
        }
        let mut notes = staged.notes().to_vec();
        let (target, lock, more) = staged.finish(false)?;
        let path = target.path.clone();
        notes.extend(more);
        notes.extend(replaced(&path).iter().filter(|old| retires(old, &path)).map(|old| {
            format!(
                "what was in {} is in {} until the new result is complete",
                shown.display(),
                shown.with_file_name(name_of(old)).display()
            )
        }));
        Ok(Self { new: Some(target), ..Self::begin(shown, path, lock, notes)? })
    }

    /// Opens a result to go on with it. Incomplete files of a killed run are removed.
    ///
    /// # Errors
    /// [`Error::NotContinued`], [`Error::OtherKind`], [`Error::Busy`], [`Error::Unwritable`].
    pub fn resume(shown: &Path, kind: Kind) -> Result<Self, Error> {
        let target = Target::new(shown)?;
        mend(&target.path)?;
        let mut notes = sweep(&target.path);
        let inventory = owned(&target, kind).map_err(|error| match error {
            Error::NotOurs { path } => Error::NotContinued { path },
            other => other,
        })?;
        let lock = lock::lock(&target.path, shown)?;
        let others = Survey::names(&target.path, &inventory).map_err(Error::unwritable(shown))?;
        notes.extend(kept(shown, &others));
        Self::begin(shown, target.path, lock, notes)
    }

    /// Opens a result of any kind to draw its figures again. A folder without an inventory (an earlier
    /// version's) gets those that it does not have.
    ///
    /// # Errors
    /// [`Error::Busy`], [`Error::Inventory`], [`Error::Unwritable`].
    pub fn redraw(shown: &Path) -> Result<Self, Error> {
        let target = Target::new(shown)?;
        mend(&target.path)?;
        if Inventory::read(&target.path)?.is_some() {
            let lock = lock::lock(&target.path, shown)?;
            return Self::begin(shown, target.path, lock, Vec::new());
        }
        let lock = File::open(&target.path).map_err(Error::unwritable(shown))?;
        Ok(Self::with(shown, target.path, lock, Inventory::default(), None))
    }

    fn begin(shown: &Path, path: PathBuf, lock: File, notes: Vec<String>) -> Result<Self, Error> {
        let unwritable = Error::unwritable(shown);
        let inventory = Inventory::read(&path)?.unwrap_or_default();
        remove_partials(&path, &inventory).map_err(&unwritable)?;
        let log = File::options().append(true).open(path.join(INVENTORY)).map_err(&unwritable)?;
        let folder = Self::with(shown, path, lock, inventory, Some(log));
        folder.state().notes = notes;
        folder.state().announce(&folder.start).map_err(|error| Error::write_failed(shown, error))?;
        Ok(folder)
    }

    /// A folder whose inventory is known; files are listed in `log`, if there is one.
    fn with(shown: &Path, path: PathBuf, lock: File, inventory: Inventory, log: Option<File>) -> Self {
        let state =
            State { inventory, log, announced: false, files: 0, notes: Vec::new(), locks: Vec::new() };
        Self {
            shown: shown.to_owned(),
            path,
            new: None,
            start: start(),
            state: Mutex::new(state),
            _lock: lock,
        }
    }
}

/// The common start of the names of this process's incomplete files.
fn start() -> String {
    format!(".{}-", number())
}
