//! What the disk must hold before a name appears.
//!
//! A rename may reach the disk before the data do: after a power cut the name stands, and behind it is nothing. So data are
//! synchronised first, then the folder that holds their names, then comes the rename, then the folder that holds the new name
//! (as SQLite does: <https://sqlite.org/atomiccommit.html>, sections 3.7 and 3.8).

use std::fs::{self, File};
use std::io::{Result, Write};
use std::path::Path;

/// Writes a file and waits until the disk has it.
pub fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    let mut file = File::create(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}

/// Waits until the disk has the names in a folder.
pub fn sync_folder(folder: &Path) -> Result<()> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    if cfg!(unix) { File::open(folder)?.sync_all() } else { Ok(()) }
}

/// Waits until the disk has the files of a folder (none of its subfolders) and their names.
pub fn sync_all(folder: &Path) -> Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        if entry.file_type()?.is_file() {
            File::open(entry.path())?.sync_all()?;
        }
    }
    sync_folder(folder)
}

/// Renames, and waits until the disk has the new name.
pub fn rename(from: &Path, to: &Path) -> Result<()> {
    fs::rename(from, to)?;
    sync_folder(to.parent().unwrap_or(Path::new(".")))
}

/// Gives two folders each other's names, if the system can: at every moment both names are there.
#[cfg(target_os = "linux")]
pub fn exchange(one: &Path, other: &Path) -> bool {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    renameat_with(CWD, one, CWD, other, RenameFlags::EXCHANGE).is_ok()
}

/// Gives two folders each other's names, if the system can: this one cannot.
#[cfg(not(target_os = "linux"))]
pub fn exchange(_one: &Path, _other: &Path) -> bool {
    false
}
