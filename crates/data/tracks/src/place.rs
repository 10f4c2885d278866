//! The place of something in a file.

use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A place in a file, for messages.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    file: Arc<PathBuf>,
    entry: Option<String>,
    at: At,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum At {
    Whole,
    Line(u64),
    Row(u64),
    Byte(u64),
}

impl Place {
    /// The whole file.
    pub fn file(file: &Path) -> Self {
        Self { file: Arc::new(file.to_owned()), entry: None, at: At::Whole }
    }

    /// An entry of an archive.
    pub fn entry(&self, name: &str) -> Self {
        Self { entry: Some(name.to_owned()), ..self.clone() }
    }

    /// A line, from 1.
    pub fn line(&self, line: u64) -> Self {
        Self { at: At::Line(line), ..self.clone() }
    }

    /// A row of a table without lines, from 0.
    pub fn row(&self, row: u64) -> Self {
        Self { at: At::Row(row), ..self.clone() }
    }

    /// A byte, from 0.
    pub fn byte(&self, byte: u64) -> Self {
        Self { at: At::Byte(byte), ..self.clone() }
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.file
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file.display())?;
        if let Some(entry) = &self.entry {
            write!(f, ", entry {entry}")?;
        }
        match self.at {
            At::Whole => Ok(()),
            At::Line(line) => write!(f, ", line {line}"),
            At::Row(row) => write!(f, ", row {row}"),
            At::Byte(byte) => write!(f, ", byte {byte}"),
        }
    }
}
