//! Synchronisation of files and names with the disk.
//!
//! A rename may reach the disk before the data do: after a power failure the name may exist without the data. Data are therefore
//! synchronised first, then the folder that contains their names; then follow the rename and the folder that contains the new name
//! (as SQLite does: <https://sqlite.org/atomiccommit.html>, sections 3.7 and 3.8).

use std::fs::{self, File};
use std::io::{ErrorKind, Result, Write};
use std::path::{Path, PathBuf};

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

/// Renames what has no other's name: what has the new name already stays, and it is an error.
pub fn rename_new(from: &Path, to: &Path) -> Result<()> {
    rename_without_replacing(from, to)?;
    sync_folder(to.parent().unwrap_or(Path::new(".")))
}

/// Renames to the first name that nothing has, of those that `name` makes of "", "-2", "-3" and so on; that name.
pub fn rename_to_free(from: &Path, name: impl Fn(&str) -> PathBuf) -> Result<PathBuf> {
    let counts = std::iter::once(String::new()).chain((2_u64..).map(|number| format!("-{number}")));
    for to in counts.map(|count| name(&count)) {
        match rename_new(from, &to) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            renamed => return renamed.map(|()| to),
        }
    }
    Err(ErrorKind::AlreadyExists.into())
}

#[cfg(target_os = "linux")]
fn rename_without_replacing(from: &Path, to: &Path) -> Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    use rustix::io::Errno;
    match renameat_with(CWD, from, CWD, to, RenameFlags::NOREPLACE) {
        Err(Errno::INVAL | Errno::NOSYS | Errno::OPNOTSUPP) => rename_if_absent(from, to), // a file system without it
        renamed => Ok(renamed?),
    }
}

#[cfg(not(target_os = "linux"))]
fn rename_without_replacing(from: &Path, to: &Path) -> Result<()> {
    rename_if_absent(from, to)
}

fn rename_if_absent(from: &Path, to: &Path) -> Result<()> {
    if to.symlink_metadata().is_ok() {
        return Err(ErrorKind::AlreadyExists.into());
    }
    fs::rename(from, to)
}

/// Writes new bytes into a file that exists and may be locked, and waits until they are on disk.
pub fn overwrite(path: &Path, bytes: &[u8]) -> Result<()> {
    let mut file = File::options().write(true).truncate(true).open(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}
