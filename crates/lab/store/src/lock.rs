//! The lock of a result, on its inventory: a separate file could be deleted while it is computed. The system releases it when the process
//! ends, however it ends.

use crate::{Error, INVENTORY};
use std::fs::{File, TryLockError};
use std::path::Path;

/// Locks the inventory in a folder.
///
/// # Errors
/// [`Error::Busy`], [`Error::Unwritable`]; errors name `shown`.
pub(crate) fn lock(folder: &Path, shown: &Path) -> Result<File, Error> {
    lock_file(&folder.join(INVENTORY), shown)
}

/// Locks a file. A file that was replaced between opening and locking is opened again: the lock is on the one that has the name.
pub(crate) fn lock_file(path: &Path, shown: &Path) -> Result<File, Error> {
    loop {
        let file = File::options().read(true).append(true).open(path).map_err(Error::unwritable(shown))?;
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(Error::Busy { path: shown.to_owned() }),
            Err(TryLockError::Error(error)) => return Err(Error::unwritable(shown)(error)),
        }
        if is_at(&file, path) {
            return Ok(file);
        }
    }
}

/// Returns `true` if an open file still has its name.
#[cfg(unix)]
fn is_at(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let (Ok(open), Ok(there)) = (file.metadata(), path.symlink_metadata()) else { return false };
    (open.dev(), open.ino()) == (there.dev(), there.ino())
}

#[cfg(not(unix))]
fn is_at(_file: &File, path: &Path) -> bool {
    path.exists()
}
