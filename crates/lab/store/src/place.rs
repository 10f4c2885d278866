//! Places for unfinished output, and what killed runs leave of them.
//!
//! Output is written in `.NAME.HEX.partial`, where HEX is a random number: a folder with an inventory that says which target it is for. The
//! inventory is locked while its process lives. A folder without this inventory is somebody else's, whatever its name.

use crate::replace::retire;
use crate::{Error, INVENTORY, Inventory, Kind};
use std::collections::hash_map::RandomState;
use std::fs::{self, File};
use std::hash::{BuildHasher, Hasher};
use std::io::Result;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Created and not yet locked.
const NEW: &str = "new";

/// Being written.
const PARTIAL: &str = "partial";

/// The folder of the new result inside a place.
const RESULT: &str = "result";

/// New output that is not yet locked is a leftover after this time; creating and locking takes a moment.
const SHORT: Duration = Duration::from_secs(60);

/// Bytes of a target's name in the names of its places: the system limits names to 255 bytes.
const LONGEST: usize = 200;

/// A place for unfinished output next to its target, with its lock.
#[derive(Debug)]
pub(crate) struct Place {
    path: PathBuf,
    /// Held as long as the place exists; none if the system has no locks for it.
    lock: Option<File>,
}

impl Place {
    /// Makes a place for the output that will be called `target`.
    pub(crate) fn make(target: &Path, kind: Kind) -> Result<Self> {
        let number = number();
        let new = beside(target, &number, NEW);
        let path = beside(target, &number, PARTIAL);
        fs::create_dir(&new)?;
        let made = || -> Result<Option<File>> {
            let marker = new.join(INVENTORY);
            fs::write(
                &marker,
                Inventory { staging_for: Some(name_of(target)), ..Inventory::new(kind) }.text(),
            )?;
            let lock = File::open(&marker).ok().filter(|file| file.try_lock().is_ok());
            fs::create_dir(new.join(RESULT))?;
            fs::rename(&new, &path)?;
            Ok(lock)
        };
        let lock = made().inspect_err(|_| remove(&new))?;
        Ok(Self { path, lock })
    }

    /// The place of a number, which a killed run left.
    pub(crate) fn left(target: &Path, number: &str) -> Self {
        Self { path: beside(target, number, PARTIAL), lock: None }
    }

    /// The folder for the new result.
    pub(crate) fn result(&self) -> PathBuf {
        self.path.join(RESULT)
    }

    /// The folder for what is replaced.
    pub(crate) fn old(&self) -> PathBuf {
        self.path.join("replaced")
    }

    /// Its number, in hexadecimal.
    pub(crate) fn number(&self) -> String {
        let name = name_of(&self.path);
        name.rsplit('.').nth(1).unwrap_or_default().to_owned()
    }

    /// Removes the place. What is not ours in a replaced result must have been taken out before.
    pub(crate) fn remove(&mut self) {
        self.lock = None; // its file is open: where few may be, removing needs the place
        remove(&self.path);
    }
}

/// A random number by the standard library's own source, with no seed: two processes may have the same number (containers).
pub(crate) fn number() -> String {
    format!("{:016x}", RandomState::new().build_hasher().finish())
}

/// The last part of a path.
pub(crate) fn name_of(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// A name for what is about to be removed: a kill before that leaves a leftover that is known by it.
pub(crate) fn on_its_way_out(target: &Path) -> PathBuf {
    beside(target, &number(), NEW)
}

fn beside(target: &Path, number: &str, end: &str) -> PathBuf {
    target.with_file_name(format!("{}{number}.{end}", start_of(&name_of(target))))
}

/// The common start of the names of the places beside a target.
fn start_of(name: &str) -> String {
    let end = (0..=LONGEST.min(name.len())).rev().find(|&end| name.is_char_boundary(end)).unwrap_or(0);
    format!(".{}.", &name[..end])
}

/// Removes a file, or a folder with its contents, with one open file at a time. After a failure the rest remains.
pub(crate) fn remove(path: &Path) {
    if !path.symlink_metadata().is_ok_and(|there| there.is_dir()) {
        let _ = fs::remove_file(path);
        return;
    }
    let inside: Vec<PathBuf> =
        fs::read_dir(path).into_iter().flatten().flatten().map(|entry| entry.path()).collect();
    // The inventory goes last: it says whose the rest is.
    let (last, first): (Vec<_>, Vec<_>) = inside.into_iter().partition(|path| name_of(path) == INVENTORY);
    first.iter().for_each(|path| remove(path));
    if fs::read_dir(path).is_ok_and(|rest| rest.count() == last.len()) {
        last.iter().for_each(|path| remove(path));
    }
    let _ = fs::remove_dir(path);
}

/// Removes what killed runs left for a target. Returns a description.
pub(crate) fn sweep(target: &Path) -> Vec<String> {
    let folder = target.parent().unwrap_or(Path::new("."));
    let mut done = Vec::new();
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let found = entry.file_name().to_string_lossy().into_owned();
        let Some((number, end)) = end_of(&found, &name_of(target)) else { continue };
        let path = entry.path();
        if !entry.file_type().is_ok_and(|kind| kind.is_dir()) || !is_left(&path, target, end) {
            continue;
        }
        let mut place = Place::left(target, number);
        if end == PARTIAL {
            for old in [place.result(), place.old()] {
                let _ = retire(&old, target); // what fails stays for the next run
            }
            if Inventory::read(&place.old()).is_ok_and(|old| old.is_some()) {
                continue;
            }
            place.remove();
        } else {
            remove(&path);
        }
        if path.symlink_metadata().is_err() {
            done.push(format!("removed {found}, left by a killed run"));
        }
    }
    done
}

/// The number and the end of `.NAME.HEX.END`, if `found` is such a name.
fn end_of<'f>(found: &'f str, name: &str) -> Option<(&'f str, &'static str)> {
    let (number, end) = found.strip_prefix(&start_of(name))?.split_once('.')?;
    let hex = number.len() == 16 && number.bytes().all(|digit| digit.is_ascii_hexdigit());
    let end = [NEW, PARTIAL].into_iter().find(|known| *known == end).filter(|_| hex)?;
    Some((number, end))
}

/// Returns `true` if it is a place for this target that no living process holds.
fn is_left(path: &Path, target: &Path, end: &str) -> bool {
    let old = || {
        let made = path.metadata().and_then(|there| there.modified()).ok();
        made.and_then(|made| made.elapsed().ok()).is_some_and(|age| age > SHORT)
    };
    let ours = match Inventory::read(path) {
        Ok(Some(marker)) if marker.replaced_by == Some(name_of(target)) => {
            end == NEW && has_at_most_its_inventory(path, true)
        }
        Ok(Some(marker)) => marker.staging_for == Some(name_of(target)),
        // killed before the inventory was whole, or after it was removed: nothing of anybody is in it
        Ok(None) | Err(Error::Inventory { .. }) => has_at_most_its_inventory(path, false),
        Err(_) => false,
    };
    let free = || match File::open(path.join(INVENTORY)) {
        Ok(file) => file.try_lock().is_ok(),
        Err(_) => true,
    };
    ours && (end != NEW || old()) && free()
}

/// Returns `true` if nothing else is in a folder; an inventory that is not `whole` is empty.
fn has_at_most_its_inventory(path: &Path, whole: bool) -> bool {
    let mut names = fs::read_dir(path).into_iter().flatten().flatten();
    let is_empty = |entry: &fs::DirEntry| entry.metadata().is_ok_and(|it| it.is_file() && it.len() == 0);
    names.all(|entry| entry.file_name() == INVENTORY && (whole || is_empty(&entry)))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may fail")]
mod tests {
    use super::*;

    #[test]
    fn only_names_of_unfinished_output_are_leftovers() {
        let number = "0123456789abcdef";
        assert_eq!(end_of(".run.0123456789abcdef.partial", "run"), Some((number, PARTIAL)));
        for other in [
            "run",
            ".run.partial",
            ".run.4711.partial",
            ".run.0123456789abcdeg.partial",
            ".run2.0123456789abcdef.partial",
            ".run.0123456789abcdef.partial.txt",
            "run.0123456789abcdef.partial",
        ] {
            assert_eq!(end_of(other, "run"), None, "{other}");
        }
    }

    #[test]
    fn a_living_place_stays_and_a_dead_one_goes() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("run");
        let living = Place::make(&target, Kind::Dataset).unwrap();
        assert_eq!(sweep(&target), Vec::<String>::new());
        assert!(living.path.exists());
        let path = living.path.clone();
        drop(living);
        assert_eq!(sweep(&target).len(), 1);
        assert!(!path.exists());
    }

    /// A kill between the removal of its inventory and its own leaves an empty folder.
    #[test]
    fn a_place_that_was_almost_removed_goes() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("run");
        let place = Place::make(&target, Kind::Dataset).unwrap();
        fs::remove_dir(place.result()).unwrap();
        fs::remove_file(place.path.join(INVENTORY)).unwrap();
        assert_eq!(sweep(&target).len(), 1);
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn what_only_has_the_name_of_a_place_stays() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("run");
        let other = folder.path().join(".run.0123456789abcdef.partial");
        fs::create_dir(&other).unwrap();
        fs::write(other.join("thesis.txt"), "all").unwrap();
        fs::write(folder.path().join(".run.0123456789abcdee.partial"), "mine").unwrap();
        assert_eq!(sweep(&target), Vec::<String>::new());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    }

    #[test]
    fn long_names_have_places() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("é".repeat(127));
        let place = Place::make(&target, Kind::Dataset).unwrap();
        drop(place);
        assert_eq!(sweep(&target).len(), 1);
    }
}
