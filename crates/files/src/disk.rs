//! Synchronisation of files and names with the disk.
//!
//! A rename may reach the disk before the data do: after a power failure the name may exist without the data. Data are therefore
//! synchronised first, then the folder that contains their names; then follow the rename and the folder that contains the new name
//! (as SQLite does: <https://sqlite.org/atomiccommit.html>, sections 3.7 and 3.8).

use std::fs::{self, File};
use std::io::{Result, Write};
use std::path::Path;

/// Writes a file and waits until it is on disk.
pub fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    let mut file = File::create(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

/// Waits until the names in a folder are on disk.
pub fn sync_folder(folder: &Path) -> Result<()> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    if cfg!(unix) { File::open(folder)?.sync_all() } else { Ok(()) }
}

/// Waits until the files of a folder (not of its subfolders) and their names are on disk.
pub fn sync_all(folder: &Path) -> Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_type()?.is_file() {
            File::open(entry.path())?.sync_all()?;
        }
    }
    sync_folder(folder)
}

/// Renames, and waits until the new name is on disk.
pub fn rename(from: &Path, to: &Path) -> Result<()> {
    fs::rename(from, to)?;
    sync_folder(to.parent().unwrap_or(Path::new(".")))
}

/// Exchanges the names of two folders, if the system can: both names exist at every moment.
#[cfg(target_os = "linux")]
pub fn exchange(one: &Path, other: &Path) -> bool {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    renameat_with(CWD, one, CWD, other, RenameFlags::EXCHANGE).is_ok()
}

/// Exchanges the names of two folders, if the system can: this one cannot.
#[cfg(not(target_os = "linux"))]
pub fn exchange(_one: &Path, _other: &Path) -> bool {
    false
}
