//! Files and options that no outlines can be read from.

use crate::{Format, Place};
use std::path::PathBuf;

/// The way to tell cells of one name apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Apart {
    /// By a column of the table.
    Column,
    /// By names of files, entries or images, in words.
    Names(&'static str),
}

impl std::fmt::Display for Apart {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Column => "give each cell a name of its own in a column, and name that",
            Self::Names(words) => words,
        })
    }
}

/// The setting of [`Options`](crate::Options) by which a file of unknown content can be read, if it is what it seems to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setting {
    /// Names of the columns of a table.
    Columns,
    /// The format: label masks.
    Masks,
}

/// The reasons why no tracks were read or written. Messages name the file, the line or entry, and the remedy.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs, reason = "each message says what its fields are")]
pub enum Error {
    /// The file system refused.
    #[error("{}: {reason}", .file.display())]
    Io {
        file: PathBuf,
        /// The reason; in the message, so it is no source.
        reason: std::io::Error,
    },
    /// No path was given.
    #[error("there is no file to read: give at least one")]
    NoFile,
    /// A file that would be read twice.
    #[error("{} is given twice: give every file once", .file.display())]
    Twice { file: PathBuf },
    /// The content is that of no known format.
    #[error("{}: not a file of outlines that is known here ({found}); the formats are {}", .file.display(), Format::list())]
    UnknownFormat { file: PathBuf, found: String, setting: Option<Setting> },
    /// The content fits several formats.
    #[error("{}: the content fits {}; choose one with the option format", .file.display(), names(.candidates))]
    Ambiguous { file: PathBuf, candidates: Vec<Format> },
    /// Something else stands where the format requires this.
    #[error("{place}: {found}, where {expected} is expected")]
    Structure { place: Place, found: String, expected: String },
    /// The content ends too early.
    #[error("{place}: the file ends before {missing}: it is truncated; write or copy it again")]
    Truncated { place: Place, missing: String },
    /// A column is not there, or several could be meant.
    #[error("{}: {found} for {wanted} among the columns {}; name it", .file.display(), .known.join(", "))]
    Column { file: PathBuf, wanted: &'static str, found: String, known: Vec<String> },
    /// More than is read at once.
    #[error("{place}: more than {limit} {what}; split the file (in Rust: or raise Options::limits.{key})")]
    Limit { place: Place, what: &'static str, limit: u64, key: &'static str },
    /// A sound file without an outline.
    #[error("{}: no outline: {reason}", .file.display())]
    NoOutlines { file: PathBuf, reason: String },
    /// An outline that belongs to no frame.
    #[error(
        "{place}: the outline has no frame number; name it FRAME-CELL.roi, or set their position in ImageJ"
    )]
    NoFrame { place: Place },
    /// Several bodies under one name.
    #[error(
        "{}: {name:?} has several different outlines in {conflicts} of its {frames} frames, first in frame \
        {first}: several cells have one name; {remedy}",
        .file.display()
    )]
    MixedCells {
        file: PathBuf,
        name: String,
        /// Frames with different outlines.
        conflicts: usize,
        frames: usize,
        first: i64,
        remedy: Apart,
    },
    /// The file and an option say different things.
    #[error("{}: the file says {what} = {file_says}, the option {key} says {option_says}; leave the option \
        out or correct the file", .file.display())]
    Disagree { file: PathBuf, what: &'static str, key: &'static str, file_says: String, option_says: String },
    /// Units in the header of a table that are not known, or contradict each other.
    #[error("{}: {found}; {remedy}", .file.display())]
    HeaderUnit { file: PathBuf, found: String, remedy: &'static str },
    /// Files in different units cannot be read together.
    #[error("{}: its {what} is {found}, that of the files before it {before}; read them separately", .file.display())]
    Units { file: PathBuf, what: &'static str, found: String, before: String },
    /// A unit of an option that is not known.
    #[error("{key} = {value:?}: this unit is not known; choose one of {known}")]
    OptionUnit { key: &'static str, value: String, known: String },
    /// An option out of its range.
    #[error("{key} = {value}: {remedy}")]
    Setting { key: &'static str, value: f64, remedy: &'static str },
    /// A name of a format that is not known.
    #[error("unknown format {name:?}: choose one of {}", Format::list())]
    FormatName { name: String },
    /// Data that this format cannot hold.
    #[error("{format} cannot hold this: {reason}")]
    Unwritable { format: Format, reason: String },
    /// A file to write whose name ends in nothing known.
    #[error("{}: outlines are written as a table (.csv: cell, frame, i, x, y) or, one cell in um and s, as \
        AmoePy's text (.txt): end the name in one of these", .file.display())]
    Ending { file: PathBuf },
}

impl Error {
    pub(crate) fn structure(place: &Place, found: impl Into<String>, expected: impl Into<String>) -> Self {
        Self::Structure { place: place.clone(), found: found.into(), expected: expected.into() }
    }
}

fn names(formats: &[Format]) -> String {
    formats.iter().map(|format| format.name()).collect::<Vec<_>>().join(" and ")
}

/// Result of reading or writing.
pub type Result<T> = std::result::Result<T, Error>;
