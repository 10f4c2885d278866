//! Errors of results on disk.

use crate::Kind;
use std::path::{Path, PathBuf};

/// A place that is not written to, or a file that cannot be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "each message says what its fields are")]
pub enum Error {
    /// The output exists.
    #[error("{} exists", .path.display())]
    Exists { path: PathBuf },
    /// The output exists and is a result of the same kind, which can be continued.
    #[error("{} exists and contains {}", .path.display(), .kind.words())]
    Resumable { path: PathBuf, kind: Kind },
    /// The output exists and has no inventory.
    #[error(
        "{} exists and has no inventory of motiform (others wrote it, or an earlier version): it is not replaced",
        .path.display()
    )]
    NotOurs { path: PathBuf },
    /// The output exists and is a result of another kind.
    #[error("{} exists and contains {found}, not {}: it is not replaced", .path.display(), .asked.words())]
    OtherKind { path: PathBuf, found: String, asked: Kind },
    /// A folder without an inventory cannot be continued.
    #[error(
        "{} has no inventory of motiform (others wrote it, or an earlier version): it is not continued",
        .path.display()
    )]
    NotContinued { path: PathBuf },
    /// A folder to be verified that does not exist.
    #[error("there is no folder {}", .path.display())]
    NoFolder { path: PathBuf },
    /// A folder without an inventory cannot be verified.
    #[error("{} has no inventory of motiform (others wrote it, or an earlier version): there is nothing to \
        compare it with", .path.display())]
    NotVerified { path: PathBuf },
    /// A file of ours was changed by others.
    #[error("{} was changed after motiform wrote it: it is not replaced; move it to another place", .path.display())]
    Changed { path: PathBuf },
    /// Something that is not ours has the name of a file of the result.
    #[error(
        "{} was not written by motiform, and a file of the result has this name: it is not replaced; move it to another place",
        .path.display()
    )]
    Taken { path: PathBuf },
    /// A folder whose name ends as that of a file.
    #[error("{}: the output is a folder, and this is the name of a file; give a name without .{ending}", .path.display())]
    NamedAsFile { path: PathBuf, ending: String },
    /// An inventory that is damaged, or of a later version.
    #[error("cannot read {}: {reason}", .path.display())]
    Inventory { path: PathBuf, reason: String },
    /// Another process writes there.
    #[error("another motiform process computes in {}: wait until it is done", .path.display())]
    Busy { path: PathBuf },
    /// A place without write access.
    #[error("cannot write {}: {reason}", .path.display())]
    Unwritable {
        path: PathBuf,
        /// The system's reason. (Not a `source`, because the message already contains it.)
        reason: std::io::Error,
    },
    /// A file that cannot be read.
    #[error("cannot read {}: {reason}", .path.display())]
    Unreadable { path: PathBuf, reason: String },
    /// Writing failed (for example because of a full disk).
    #[error("writing {} failed: {reason}; {}", .path.display(), advice(.reason))]
    WriteFailed { path: PathBuf, reason: String },
}

impl Error {
    /// Returns `true` if the input was valid but the machine failed.
    pub fn is_machine_failure(&self) -> bool {
        matches!(self, Self::WriteFailed { .. })
    }

    /// [`Error::Unreadable`] of a path, with the reason as text.
    pub fn unreadable(path: &Path, reason: impl std::fmt::Display) -> Self {
        Self::Unreadable { path: path.to_owned(), reason: reason.to_string() }
    }

    /// [`Error::WriteFailed`] of a path, with the reason as text.
    pub fn write_failed(path: &Path, reason: impl std::fmt::Display) -> Self {
        Self::WriteFailed { path: path.to_owned(), reason: reason.to_string() }
    }

    /// [`Error::Unwritable`] of a path; [`Error::WriteFailed`] where there is no space, or the process may open no more files.
    pub(crate) fn unwritable(path: &Path) -> impl Fn(std::io::Error) -> Self {
        use std::io::ErrorKind::{FileTooLarge, QuotaExceeded, StorageFull};
        move |reason| match reason.kind() {
            StorageFull | QuotaExceeded | FileTooLarge => Self::write_failed(path, reason),
            _ if is_shortage(&reason) => Self::write_failed(path, reason),
            _ => Self::Unwritable { path: path.to_owned(), reason },
        }
    }
}

/// Returns `true` if the process lacks something that is needed to look at a file: open files, of its own or
/// of the system, or memory.
pub(crate) fn is_shortage(error: &std::io::Error) -> bool {
    cfg!(unix) && matches!(error.raw_os_error(), Some(24 | 23 | 12))
}

/// The remedy for a failed write: it depends on the system's reason, which ends with its number.
pub fn advice(reason: &str) -> &'static str {
    const ADVICE: [(&[&str], &str); 3] = [
        (&["(os error 28)", "(os error 122)", "(os error 27)"], "free some space and run again"),
        (&["(os error 36)", "(os error 63)"], "choose a shorter name"),
        (&["(os error 24)", "(os error 23)"], "allow more open files (ulimit -n) and run again"),
    ];
    let known = ADVICE.iter().find(|(ends, _)| ends.iter().any(|end| reason.ends_with(end)));
    known.map_or("mend this and run again", |(_, advice)| advice)
}
