//! Tables on disk, Parquet or CSV, written and read in groups of rows: in memory that does not grow with the table.

use super::{csv, parquet_table};
use crate::{Error, Format, Table};
use serde::Serialize;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Rows of a group: what is in memory while a table is written or read. A table with fewer has one group.
pub const GROUP_ROWS: usize = 1 << 18;

/// A table that is written while its rows come.
///
/// The same rows give the same bytes as [`crate::write_table`], however they come.
pub struct TableWriter {
    path: PathBuf,
    format: Format,
    /// Rows that are not in the file yet: at most one group.
    table: Table,
    /// `true` if there are rows in the file that are not in the table any more.
    written: bool,
    /// Begins with the first full group, or at the end: a short table is stored differently.
    file: Option<Kind>,
}

enum Kind {
    Csv(csv::Writer),
    Parquet(parquet_table::Writer),
}

impl Kind {
    fn new(table: &Table, format: Format, path: &Path) -> Result<Self, Error> {
        let failed = |error: &dyn std::fmt::Display| Error::write_failed(path, error);
        Ok(match format {
            Format::Csv => Self::Csv(csv::Writer::new(table, path).map_err(|error| failed(&error))?),
            Format::Parquet => {
                Self::Parquet(parquet_table::Writer::new(table, path).map_err(|error| failed(&error))?)
            }
        })
    }

    fn rows(&mut self, table: &Table, rows: Range<usize>, path: &Path) -> Result<(), Error> {
        match self {
            Self::Csv(file) => file.rows(table, rows).map_err(|error| Error::write_failed(path, error)),
            Self::Parquet(file) => file.rows(table, rows).map_err(|error| Error::write_failed(path, error)),
        }
    }

    fn finish(self, manifest: &impl Serialize, path: &Path) -> Result<(), Error> {
        match self {
            Self::Csv(file) => file.finish().map_err(|error| Error::write_failed(path, error)),
            Self::Parquet(file) => {
                let metadata =
                    serde_json::to_string(manifest).map_err(|error| Error::write_failed(path, error))?;
                file.finish(&metadata).map_err(|error| Error::write_failed(path, error))
            }
        }
    }
}

impl TableWriter {
    /// A table at `path` with the columns of `empty`, which has no rows.
    pub fn new(empty: Table, format: Format, path: &Path) -> Self {
        Self { path: path.to_owned(), format, table: empty, written: false, file: None }
    }

    /// The rows that are not in the file yet, for a further one: call [`TableWriter::advance`] after each.
    pub fn table(&mut self) -> &mut Table {
        &mut self.table
    }

    /// Writes a group where there is a whole one.
    ///
    /// # Errors
    /// [`Error::WriteFailed`].
    pub fn advance(&mut self) -> Result<(), Error> {
        if self.table.rows() < GROUP_ROWS {
            return Ok(());
        }
        self.flush()?;
        self.written = true;
        self.table.columns.iter_mut().for_each(|column| column.values.clear());
        Ok(())
    }

    /// Begins again: the rows so far are no part of the table.
    pub fn restart(&mut self) {
        self.table.columns.iter_mut().for_each(|column| column.values.clear());
        (self.written, self.file) = (false, None); // the next file of this name replaces it
    }

    fn flush(&mut self) -> Result<(), Error> {
        let file = match &mut self.file {
            Some(file) => file,
            none => none.insert(Kind::new(&self.table, self.format, &self.path)?),
        };
        if self.table.rows() == 0 { Ok(()) } else { file.rows(&self.table, 0..self.table.rows(), &self.path) }
    }

    /// Ends the file, with the manifest inside if the format supports it. Gives the whole table where it has
    /// one group at most.
    ///
    /// # Errors
    /// [`Error::WriteFailed`].
    pub fn finish(mut self, manifest: &impl Serialize) -> Result<Option<Table>, Error> {
        self.flush()?;
        if let Some(file) = self.file {
            file.finish(manifest, &self.path)?;
        }
        Ok((!self.written).then_some(self.table))
    }
}

/// Writes one table to `path` in the given format, with the manifest inside if the format supports it.
///
/// # Errors
/// [`Error::WriteFailed`].
pub fn write_table(
    table: &Table,
    manifest: &impl Serialize,
    format: Format,
    path: &Path,
) -> Result<(), Error> {
    let mut file = Kind::new(table, format, path)?;
    for start in (0..table.rows()).step_by(GROUP_ROWS) {
        file.rows(table, start..table.rows().min(start + GROUP_ROWS), path)?;
    }
    file.finish(manifest, path)
}

/// Gives `take` the rows of a table, a group at a time; a table without rows is one empty group. An error of
/// `take` ends it.
///
/// # Errors
/// [`Error::Unreadable`], and what `take` refuses.
pub fn read_groups<E: From<Error>>(
    path: &Path,
    take: &mut dyn FnMut(Table) -> Result<(), E>,
) -> Result<(), E> {
    read_columns(path, None, take)
}

/// As [`read_groups`], with these columns alone, in the order of the file; of Parquet no other one is read.
/// `None`: all.
///
/// # Errors
/// As [`read_groups`]; [`Error::Unreadable`] for a column that is not there.
pub fn read_columns<E: From<Error>>(
    path: &Path,
    columns: Option<&[String]>,
    take: &mut dyn FnMut(Table) -> Result<(), E>,
) -> Result<(), E> {
    match Format::of_path(path) {
        Some(Format::Csv) => csv::groups(path, columns, take),
        Some(Format::Parquet) => parquet_table::groups(path, columns, take),
        None => Err(Error::unreadable(path, "it is not a table: give a .parquet or .csv file").into()),
    }
}

/// The places of the columns that are wanted.
///
/// # Errors
/// One is not there, in a sentence.
pub(crate) fn places(all: &Table, wanted: Option<&[String]>) -> Result<Vec<usize>, String> {
    let names: Vec<&str> = all.columns.iter().map(|column| column.name.as_str()).collect();
    let Some(wanted) = wanted else { return Ok((0..names.len()).collect()) };
    if let Some(missing) = wanted.iter().find(|name| !names.contains(&name.as_str())) {
        return Err(format!("it has no column {missing}: it has {}", names.join(", ")));
    }
    Ok((0..names.len()).filter(|&place| wanted.iter().any(|name| name == names[place])).collect())
}

/// A whole table, Parquet or CSV by its extension.
///
/// # Errors
/// [`Error::Unreadable`].
pub fn read_table(path: &Path) -> Result<Table, Error> {
    let mut whole: Option<Table> = None;
    read_groups(path, &mut |group| -> Result<(), Error> {
        let Some(whole) = &mut whole else {
            whole = Some(group);
            return Ok(());
        };
        for (column, part) in whole.columns.iter_mut().zip(group.columns) {
            column.values.extend(part.values);
        }
        Ok(())
    })?;
    Ok(whole.unwrap_or_default())
}
