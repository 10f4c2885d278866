//! The target of an output: links are followed, folders above it are made.

use crate::Error;
use std::fs;
use std::io::{Error as IoError, ErrorKind};
use std::path::{Path, PathBuf};

/// Ends of names of files: a folder is not called so by intention.
const ENDINGS: [&str; 29] = [
    "apng", "avi", "csv", "dat", "doc", "docx", "gif", "gz", "h5", "hdf5", "htm", "html", "jpeg", "jpg",
    "json", "jsonl", "mat", "md", "mp4", "npy", "npz", "parquet", "pdf", "png", "svg", "tar", "toml", "tsv",
    "txt",
];

/// The place of an output, and the folders above it that were made for it.
#[derive(Clone, Debug)]
pub(crate) struct Target {
    /// As given.
    pub(crate) shown: PathBuf,
    /// Its place on disk, without links.
    pub(crate) path: PathBuf,
    made: Vec<PathBuf>,
}

impl Target {
    /// The place of a folder.
    ///
    /// # Errors
    /// [`Error::NamedAsFile`], [`Error::Unwritable`].
    pub(crate) fn folder(shown: &Path) -> Result<Self, Error> {
        let ending =
            shown.extension().map(|end| end.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
        if ENDINGS.contains(&ending.as_str()) && !shown.is_dir() && !shown.is_file() {
            return Err(Error::NamedAsFile { path: shown.to_owned(), ending });
        }
        Self::new(shown)
    }

    /// The place of a file or folder.
    ///
    /// # Errors
    /// [`Error::Unwritable`].
    pub(crate) fn new(shown: &Path) -> Result<Self, Error> {
        let path = followed(shown, 0).map_err(Error::unwritable(shown))?;
        if path.file_name().is_none() {
            let reason = IoError::new(ErrorKind::InvalidInput, "it is the root of the file system");
            return Err(Error::unwritable(shown)(reason));
        }
        let mut made = Vec::new();
        let above = path.parent().unwrap_or(Path::new("."));
        let missing: Vec<&Path> =
            above.ancestors().take_while(|folder| folder.symlink_metadata().is_err()).collect();
        for folder in missing.into_iter().rev() {
            match fs::create_dir(folder) {
                Ok(()) => made.push(folder.to_owned()),
                Err(error) if error.kind() == ErrorKind::AlreadyExists => {} // by another process, just now
                Err(error) => {
                    remove_empty(&made);
                    return Err(Error::unwritable(shown)(error));
                }
            }
        }
        Ok(Self { shown: shown.to_owned(), path, made })
    }

    /// Returns `true` if something is there.
    pub(crate) fn exists(&self) -> bool {
        self.path.symlink_metadata().is_ok()
    }

    /// Removes the folders that were made, if nothing came into them.
    pub(crate) fn undo(&self) {
        remove_empty(&self.made);
    }
}

fn remove_empty(made: &[PathBuf]) {
    for folder in made.iter().rev() {
        let _ = fs::remove_dir(folder); // it fails where something is inside
    }
}

/// The path without links; a link to nothing leads to the place that it names.
pub(crate) fn followed(path: &Path, depth: usize) -> Result<PathBuf, IoError> {
    if let Ok(found) = path.canonicalize() {
        return Ok(found);
    }
    if depth > 40 {
        return Err(IoError::other("its links lead in a circle"));
    }
    let plain: PathBuf = path.components().collect();
    let Some(name) = plain.file_name() else {
        return Err(IoError::new(ErrorKind::InvalidInput, "the path has no last part"));
    };
    let above = plain.parent().filter(|above| !above.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if let Ok(to) = fs::read_link(&plain) {
        return followed(&above.join(to), depth + 1);
    }
    Ok(followed(above, depth + 1)?.join(name))
}
