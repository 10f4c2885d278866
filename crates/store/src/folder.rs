//! Results that grow file by file.

use crate::inventory::file_line;
use crate::place::{name_of, number, sweep};
use crate::replace::{is_taken, make_folders, replaced, retire, retires, set_aside};
use crate::staged::{is_empty, owned};
use crate::survey::{Survey, is_ours, kept, remove_partials};
use crate::target::Target;
use crate::{Error, INVENTORY, Inventory, Kind, Staged, disk, is_figure, lock, mend, sha256_hex};
use serde_json::json;
use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// What to do with a result that exists.
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
    #[must_use]
    pub fn of(resume: bool, force: bool) -> Self {
        match (resume, force) {
            (true, _) => Self::Resume,
            (_, true) => Self::Replace,
            _ => Self::New,
        }
    }
}

/// A result folder that is being written. While it lives, no other process writes there. Every file in it is whole, and is listed before
/// it has its name: after a kill, what is there is known to be ours, and [`Folder::resume`] goes on.
#[derive(Debug)]
pub struct Folder {
    shown: PathBuf,
    path: PathBuf,
    /// Its place, if it is new.
    new: Option<Target>,
    start: String,
    state: Mutex<State>,
    /// Held as long as it is written: the lock, and that of an inventory that was replaced.
    _lock: File,
}

#[derive(Debug)]
struct State {
    inventory: Inventory,
    /// Where lines are appended; none in a folder without an inventory, in which only new figures are drawn.
    log: Option<File>,
    files: u64,
    notes: Vec<String>,
    locks: Vec<File>,
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

    /// Opens a result of any kind to draw its figures again. A folder without an inventory (an earlier version's) gets those that it does not have.
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
        let state = State {
            inventory: Inventory::default(),
            log: None,
            files: 0,
            notes: Vec::new(),
            locks: Vec::new(),
        };
        Ok(Self {
            shown: shown.to_owned(),
            path: target.path,
            new: None,
            start: start(),
            state: Mutex::new(state),
            _lock: lock,
        })
    }

    /// Gives a folder of an earlier version its inventory: it lists `names`, which the caller knows to be ours and unchanged.
    ///
    /// # Errors
    /// [`Error::Unwritable`].
    pub fn adopt(shown: &Path, kind: Kind, names: &[String]) -> Result<(), Error> {
        let unwritable = Error::unwritable(shown);
        let mut inventory = Inventory::new(kind);
        for name in names {
            let digest = crate::sha256_file(&shown.join(name)).map_err(&unwritable)?;
            inventory.list(name, &digest);
        }
        let new = shown.join(format!("{}0.partial", start()));
        disk::write(&new, inventory.text().as_bytes()).map_err(&unwritable)?;
        disk::rename_new(&new, &shown.join(INVENTORY))
            .inspect_err(|_| drop(fs::remove_file(&new)))
            .map_err(unwritable)
    }

    fn begin(shown: &Path, path: PathBuf, lock: File, notes: Vec<String>) -> Result<Self, Error> {
        let unwritable = Error::unwritable(shown);
        let inventory = Inventory::read(&path)?.unwrap_or_default();
        remove_partials(&path, &inventory).map_err(&unwritable)?;
        let mut log = File::options().append(true).open(path.join(INVENTORY)).map_err(&unwritable)?;
        let start = start();
        let line = format!("\n{}\n", json!({ "partial": start }));
        log.write_all(line.as_bytes()).map_err(|error| Error::write_failed(shown, error))?;
        let state = State { inventory, log: Some(log), files: 0, notes, locks: Vec::new() };
        Ok(Self { shown: shown.to_owned(), path, new: None, start, state: Mutex::new(state), _lock: lock })
    }

    /// Where it is, as given.
    #[must_use]
    pub fn shown(&self) -> &Path {
        &self.shown
    }

    /// Where it is, without links.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What a person should know, in sentences; each is returned once.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        std::mem::take(&mut self.state().notes)
    }

    /// Whether the result is complete.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.state().inventory.complete
    }

    /// The listed names.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        self.state().inventory.files.keys().cloned().collect()
    }

    /// The bytes of a file, if it is listed and unchanged.
    #[must_use]
    pub fn read(&self, name: &str) -> Option<Vec<u8>> {
        let path = self.path.join(name);
        let digests = self.state().inventory.files.get(name)?.clone();
        let bytes =
            path.symlink_metadata().ok().filter(fs::Metadata::is_file).and_then(|_| fs::read(path).ok())?;
        digests.contains(&sha256_hex(&bytes)).then_some(bytes)
    }

    /// Writes a file, at once or not at all; `/` in its name makes folders. It replaces a file of this name that is ours and unchanged. A figure that others
    /// wrote or changed stays, with a note, and this one is not written.
    ///
    /// # Errors
    /// [`Error::Changed`], [`Error::Taken`], [`Error::WriteFailed`].
    pub fn put(&self, name: &str, bytes: &[u8]) -> Result<(), Error> {
        self.write(name, bytes, false)
    }

    /// Writes a figure as [`Folder::put`]; with `force` it replaces one of ours that was edited, which is kept under another name.
    ///
    /// # Errors
    /// Those of [`Folder::put`].
    pub fn draw(&self, name: &str, bytes: &[u8], force: bool) -> Result<(), Error> {
        self.write(name, bytes, force)
    }

    fn write(&self, name: &str, bytes: &[u8], force: bool) -> Result<(), Error> {
        if !self.gives_way(name, force)? {
            return Ok(());
        }
        let failed = |error: std::io::Error| Error::write_failed(&self.shown.join(name), error);
        let partial = {
            let mut state = self.state();
            state.files += 1;
            self.path.join(format!("{}{}.partial", self.start, state.files))
        };
        let write = || {
            make_folders(&self.path, name)?;
            disk::write(&partial, bytes)?;
            self.list(name, &sha256_hex(bytes))?;
            disk::rename(&partial, &self.path.join(name))
        };
        write().inspect_err(|_| drop(fs::remove_file(&partial))).map_err(failed)
    }

    /// Whether a name is free for a file of ours, or becomes free; `false` where a figure stays.
    fn gives_way(&self, name: &str, force: bool) -> Result<bool, Error> {
        if !is_taken(&self.path, name) {
            return Ok(true);
        }
        let path = self.shown.join(name);
        let digests = self.state().inventory.files.get(name).cloned();
        let listed = digests.is_some();
        if is_ours(&self.path.join(name), &digests.unwrap_or_default()) {
            return Ok(true);
        }
        if !is_figure(name) {
            return Err(if listed { Error::Changed { path } } else { Error::Taken { path } });
        }
        if listed && force {
            let aside = set_aside(&self.path, name).map_err(|error| Error::write_failed(&path, error))?;
            self.state().notes.push(format!("{} was edited: it is kept as {aside}", path.display()));
            return Ok(true);
        }
        let why =
            if listed { "was edited since motiform drew it" } else { "is not known to be drawn by motiform" };
        self.state()
            .notes
            .push(format!("{} {why}: it is kept, and this figure is not written", path.display()));
        Ok(false)
    }

    fn list(&self, name: &str, digest: &str) -> std::io::Result<()> {
        let mut state = self.state();
        state.inventory.list(name, digest);
        match &mut state.log {
            Some(log) => log.write_all(file_line(name, digest).as_bytes()).inspect_err(|_| {
                let _ = log.write_all(b"\n"); // the next line is not appended to half of this one
            }),
            None => Ok(()),
        }
    }

    /// Moves something that has the name of a file of ours out of the way, under a name that begins with `_`; the new name.
    ///
    /// # Errors
    /// [`Error::WriteFailed`].
    pub fn keep_aside(&self, name: &str) -> Result<String, Error> {
        let end = name.rsplit('/').next().unwrap_or(name);
        for count in 1.. {
            let aside =
                if count == 1 { format!("_damaged-{end}") } else { format!("_damaged-{count}-{end}") };
            match disk::rename_new(&self.path.join(name), &self.path.join(&aside)) {
                Err(error) if error.kind() == std::io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(Error::write_failed(&self.shown.join(name), error)),
                Ok(()) => {
                    let path = self.shown.join(name).display().to_string();
                    self.state()
                        .notes
                        .push(format!("{path} is not as motiform wrote it: it is kept as {aside}"));
                    return Ok(aside);
                }
            }
        }
        Ok(name.to_owned())
    }

    /// Removes a file, or with `/` at the end of its name a folder of them, as far as they are ours and unchanged.
    pub fn discard(&self, name: &str) {
        let files: Vec<(String, Vec<String>)> = {
            let state = self.state();
            let within = |listed: &str| listed == name || (name.ends_with('/') && listed.starts_with(name));
            state
                .inventory
                .files
                .iter()
                .filter(|(listed, _)| within(listed))
                .map(|(a, b)| (a.clone(), b.clone()))
                .collect()
        };
        for (listed, digests) in files {
            if is_ours(&self.path.join(&listed), &digests) {
                let _ = fs::remove_file(self.path.join(&listed)); // what is left over harms nothing
            }
        }
        if name.ends_with('/') {
            let _ = fs::remove_dir(self.path.join(name)); // it fails where something else is inside
        }
    }

    /// Checks that no listed file is changed, figures excepted, so that work of hours is not done in vain. Changed files of unfinished work (in a folder
    /// whose name begins with `_`) are kept under another name, with a note: they are computed again.
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

    /// Takes a result away whose computation failed before there was anything of it, and puts back what it replaced.
    pub fn abandon(self) {
        let Some(target) = &self.new else { return };
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
        let new = self.path.join(format!("{}0.partial", self.start));
        disk::write(&new, inventory.text().as_bytes()).map_err(failed)?;
        let lock = lock::lock_file(&new, &self.shown)?;
        disk::rename(&new, &self.path.join(INVENTORY)).map_err(failed)?;
        state.log = Some(File::options().append(true).open(self.path.join(INVENTORY)).map_err(failed)?);
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

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// How the names of this process's incomplete files begin.
fn start() -> String {
    format!(".{}-", number())
}
