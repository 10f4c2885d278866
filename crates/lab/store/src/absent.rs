//! The substitute for Parquet and HDF5 in a build without the feature `formats`: the refusal to read or write
//! such files. A browser has no files either, so nothing of this is reached there.

use crate::Error;
use crate::Fields;
use crate::Table;
use crate::table::columns::Column;
use std::ops::Range;
use std::path::Path;

/// This build has no Parquet and HDF5 files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Absent;

impl std::fmt::Display for Absent {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("this program was built without Parquet and HDF5 files: use CSV, or build it with the feature `formats`")
    }
}

impl std::error::Error for Absent {}

/// Columns as a Parquet file.
///
/// # Errors
/// Always.
pub fn encode(_columns: &[Column], _metadata: Vec<(&str, String)>) -> Result<Vec<u8>, Absent> {
    Err(Absent)
}

/// The metadata entries of a Parquet file.
///
/// # Errors
/// Always.
pub fn metadata(_path: &Path) -> Result<Vec<(String, String)>, Absent> {
    Err(Absent)
}

/// The columns of a Parquet file.
///
/// # Errors
/// Always.
pub fn decode(_path: &Path) -> Result<Vec<Column>, Absent> {
    Err(Absent)
}

/// No file of a table.
pub(crate) struct Writer(std::convert::Infallible);

impl Writer {
    pub(crate) fn new(_table: &Table, _path: &Path) -> Result<Self, Absent> {
        Err(Absent)
    }

    pub(crate) fn rows(&mut self, _table: &Table, _rows: Range<usize>) -> Result<(), Absent> {
        match self.0 {}
    }

    pub(crate) fn finish(self, _metadata: &str) -> Result<(), Absent> {
        match self.0 {}
    }
}

pub(crate) fn groups<E: From<Error>>(
    path: &Path,
    _wanted: Option<&[String]>,
    _take: &mut dyn FnMut(Table) -> Result<(), E>,
) -> Result<(), E> {
    Err(Error::unreadable(path, Absent).into())
}

pub(crate) fn read_metadata(path: &Path) -> Result<Option<String>, Error> {
    Err(Error::unreadable(path, Absent))
}

/// Writes an HDF5 file.
///
/// # Errors
/// Always.
pub fn write_fields(path: &Path, _fields: &Fields) -> Result<(), Error> {
    Err(Error::write_failed(path, Absent))
}

/// Reads an HDF5 file.
///
/// # Errors
/// Always.
pub fn read_fields(path: &Path) -> Result<Fields, Error> {
    Err(Error::unreadable(path, Absent))
}
