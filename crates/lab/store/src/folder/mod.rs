//! Results that grow file by file.

mod ending;
mod opening;

pub use opening::Opening;

use crate::inventory::file_line;
use crate::place::name_of;
use crate::replace::{is_taken, make_folders, set_aside};
use crate::survey::is_ours;
use crate::target::Target;
use crate::{Error, Inventory, disk, is_figure, sha256_hex};
use serde_json::json;
use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

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
    /// The file that lines are appended to; none in a folder without an inventory, in which only new figures
    /// are drawn.
    log: Option<File>,
    /// `true` if the inventory on disk holds the common start of the names of incomplete files.
    announced: bool,
    files: u64,
    notes: Vec<String>,
    locks: Vec<File>,
}

impl State {
    /// Writes down how the names of incomplete files begin, before there is one: after a kill they are known to be ours.
    fn announce(&mut self, start: &str) -> std::io::Result<()> {
        if let Some(log) = self.log.as_mut().filter(|_| !self.announced) {
            log.write_all(format!("\n{}\n", json!({ "partial": start })).as_bytes())?;
            self.announced = true;
        }
        Ok(())
    }
}

impl Folder {
    /// The path, as given.
    pub fn shown(&self) -> &Path {
        &self.shown
    }

    /// The remarks for the user, in sentences; each is returned once.
    pub fn notes(&self) -> Vec<String> {
        std::mem::take(&mut self.state().notes)
    }

    /// Returns `true` if the result is complete.
    pub fn is_complete(&self) -> bool {
        self.state().inventory.complete
    }

    /// The listed names.
    pub fn names(&self) -> Vec<String> {
        self.state().inventory.files.keys().cloned().collect()
    }

    /// The bytes of a file, if it is listed and unchanged.
    pub fn read(&self, name: &str) -> Option<Vec<u8>> {
        let path = self.path.join(name);
        let digests = self.state().inventory.files.get(name)?.clone();
        let bytes =
            path.symlink_metadata().ok().filter(fs::Metadata::is_file).and_then(|_| fs::read(path).ok())?;
        digests.contains(&sha256_hex(&bytes)).then_some(bytes)
    }

    /// Writes a file, at once or not at all; `/` in its name makes folders. It replaces a file of this name
    /// that is ours and unchanged. A figure that others wrote or changed stays, with a note, and this one is
    /// not written.
    ///
    /// # Errors
    /// [`Error::Changed`], [`Error::Taken`], [`Error::WriteFailed`].
    pub fn put(&self, name: &str, bytes: &[u8]) -> Result<(), Error> {
        self.draw(name, bytes, false).map(drop)
    }

    /// Writes a figure as [`Folder::put`]; with `force` it replaces one of ours that was edited, which is
    /// kept under another name. Whether it is written.
    ///
    /// # Errors
    /// Those of [`Folder::put`].
    pub fn draw(&self, name: &str, bytes: &[u8], force: bool) -> Result<bool, Error> {
        if !self.gives_way(name, force)? {
            return Ok(false);
        }
        let failed = |error: std::io::Error| Error::write_failed(&self.shown.join(name), error);
        let partial = {
            let mut state = self.state();
            state.files += 1;
            self.path.join(format!("{}{}.partial", self.start, state.files))
        };
        let write = || {
            self.state().announce(&self.start)?;
            make_folders(&self.path, name)?;
            disk::write(&partial, bytes)?;
            self.list(name, &sha256_hex(bytes))?;
            disk::rename(&partial, &self.path.join(name))
        };
        write().inspect_err(|_| drop(fs::remove_file(&partial))).map_err(failed).map(|()| true)
    }

    /// Returns `true` if a name is free for a file of ours, or becomes free; `false` where a figure stays.
    fn gives_way(&self, name: &str, force: bool) -> Result<bool, Error> {
        if !is_taken(&self.path, name) {
            return Ok(true);
        }
        let path = self.shown.join(name);
        let digests = self.state().inventory.files.get(name).cloned();
        let listed = digests.is_some();
        let ours = is_ours(&self.path.join(name), &digests.unwrap_or_default());
        if ours.map_err(|error| Error::write_failed(&path, error))? {
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
        let aside = |count: &str| self.path.join(format!("_damaged{count}-{end}"));
        let shown = self.shown.join(name);
        let free = disk::rename_to_free(&self.path.join(name), aside)
            .map_err(|error| Error::write_failed(&shown, error))?;
        let aside = name_of(&free);
        let note = format!("{} is not as motiform wrote it: it is kept as {aside}", shown.display());
        self.state().notes.push(note);
        Ok(aside)
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
            if is_ours(&self.path.join(&listed), &digests).unwrap_or(false) {
                let _ = fs::remove_file(self.path.join(&listed)); // what is left over harms nothing
            }
        }
        if name.ends_with('/') {
            let _ = fs::remove_dir(self.path.join(name)); // it fails where something else is inside
        }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
