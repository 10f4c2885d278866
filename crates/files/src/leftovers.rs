//! Names of unfinished output, and leftovers of killed runs.
//!
//! Output is written under `.NAME.HEX.partial`, where HEX is a random number, and locked while its process lives: the system releases the
//! lock when the process ends, however it ends. A file or folder with such a name and no lock is a leftover.

use super::disk;
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

/// The folder to be replaced, if two folders cannot be exchanged.
const REPLACED: &str = "replaced";

/// New output that is not yet locked is a leftover after this time; creating and locking takes a moment.
const SHORT: Duration = Duration::from_secs(60);

/// A place for unfinished output next to its target, with its lock.
#[derive(Debug)]
pub(crate) struct Place {
    pub(super) path: PathBuf,
    /// Held as long as the place exists; none if the system has no locks for it.
    _lock: Option<File>,
}

impl Place {
    /// Creates a folder or an empty file for the output that will be called `target`.
    pub(crate) fn make(target: &Path, folder: bool) -> Result<Self> {
        // Random by the standard library's own source, with no seed: two processes may have the same number (containers).
        let number = RandomState::new().build_hasher().finish();
        let new = beside(target, number, NEW);
        if folder {
            fs::create_dir(&new)?;
        } else {
            File::create_new(&new)?;
        }
        let lock = File::open(&new).ok().filter(|file| file.try_lock().is_ok());
        let path = beside(target, number, PARTIAL);
        fs::rename(&new, &path).inspect_err(|_| remove(&new))?;
        Ok(Self { path, _lock: lock })
    }
}

/// The place of the folder that is replaced.
pub(crate) fn replaced(target: &Path) -> PathBuf {
    beside(target, RandomState::new().build_hasher().finish(), REPLACED)
}

fn beside(target: &Path, number: u64, end: &str) -> PathBuf {
    let name = target.file_name().unwrap_or_default().to_string_lossy();
    target.with_file_name(format!(".{name}.{number:016x}.{end}"))
}

/// Removes a file, or a folder with its contents. After a failure the rest remains, under a name that marks it as a leftover.
pub(crate) fn remove(path: &Path) {
    let folder = path.symlink_metadata().is_ok_and(|there| there.is_dir());
    let _ = if folder { fs::remove_dir_all(path) } else { fs::remove_file(path) };
}

/// Removes leftovers of killed runs for `target`, and restores the folder that one of them was about to replace. Returns a description.
pub fn sweep(target: &Path) -> Vec<String> {
    let folder = target.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let Some(name) = target.file_name() else { return Vec::new() };
    let name = name.to_string_lossy();
    let mut done = Vec::new();
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let found = entry.file_name().to_string_lossy().into_owned();
        let Some(end) = end_of(&found, &name) else { continue };
        let path = entry.path();
        if !is_left(&path, end) {
            continue;
        }
        if end == REPLACED && target.symlink_metadata().is_err() {
            if disk::rename(&path, target).is_ok() {
                done.push(format!("restored {}, which a killed run was about to replace", target.display()));
            }
            continue;
        }
        remove(&path);
        if path.symlink_metadata().is_err() {
            done.push(format!("removed {found}, left by a killed run"));
        }
    }
    done
}

/// The end of `.NAME.HEX.END`, if `found` is such a name.
fn end_of(found: &str, name: &str) -> Option<&'static str> {
    let rest = found.strip_prefix('.')?.strip_prefix(name)?.strip_prefix('.')?;
    let (number, end) = rest.split_once('.')?;
    let hex = (1..=16).contains(&number.len()) && number.bytes().all(|digit| digit.is_ascii_hexdigit());
    [NEW, PARTIAL, REPLACED].into_iter().find(|known| *known == end).filter(|_| hex)
}

/// Whether no living process holds it.
fn is_left(path: &Path, end: &str) -> bool {
    let old = || {
        let made = path.metadata().and_then(|there| there.modified()).ok();
        made.and_then(|made| made.elapsed().ok()).is_some_and(|age| age > SHORT)
    };
    File::open(path).is_ok_and(|file| file.try_lock().is_ok()) && (end != NEW || old())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_names_of_unfinished_output_are_leftovers() {
        assert_eq!(end_of(".run.0123456789abcdef.partial", "run"), Some(PARTIAL));
        assert_eq!(end_of(".run.4711.partial", "run"), Some(PARTIAL), "an earlier version's");
        for other in [
            "run",
            ".run.partial",
            ".run.xyz.partial",
            ".run2.12.partial",
            ".run.12.partial.txt",
            "run.12.partial",
        ] {
            assert_eq!(end_of(other, "run"), None, "{other}");
        }
    }

    #[test]
    fn a_living_place_stays_and_a_dead_one_goes() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("run");
        for kind in [true, false] {
            let living = Place::make(&target, kind).unwrap();
            assert_eq!(sweep(&target), Vec::<String>::new());
            assert!(living.path.exists());
            let path = living.path.clone();
            drop(living);
            assert_eq!(sweep(&target).len(), 1);
            assert!(!path.exists());
        }
    }

    #[test]
    fn what_was_about_to_be_replaced_comes_back() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("run");
        fs::create_dir(replaced(&target)).unwrap();
        assert!(sweep(&target)[0].contains("back"));
        assert!(target.is_dir());
    }
}
