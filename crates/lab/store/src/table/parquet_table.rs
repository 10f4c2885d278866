//! Tables as Parquet: one DOUBLE column each, null where a value is undefined; zstd; opens in pandas, polars, R, Julia.

use super::file::places;
use super::parquet_input::{self, Read, values, wrong};
use super::parquet_output::Groups;
use crate::Error;
use crate::table::Table;
use parquet::errors::Result;
use parquet::file::metadata::FileMetaData;
use parquet::file::reader::FileReader;
use std::fs::File;
use std::ops::Range;
use std::path::Path;

/// A file of a table that is written while its rows come.
pub(crate) struct Writer(Groups<File>);

impl Writer {
    /// A file with the columns of this table; its number of rows decides whether they are compressed.
    pub(crate) fn new(table: &Table, path: &Path) -> Result<Self> {
        let version = format!("motiform {}", crate::VERSION);
        Ok(Self(Groups::new(File::create(path)?, &table.columns, table.rows(), version)?))
    }

    /// Writes these rows of a table as a group.
    pub(crate) fn rows(&mut self, table: &Table, rows: Range<usize>) -> Result<()> {
        self.0.group(&table.columns, rows)
    }

    /// Ends the file; `metadata` (a JSON text) is kept under the key `motiform`, column meanings under
    /// `motiform.columns`.
    pub(crate) fn finish(self, metadata: &str) -> Result<()> {
        self.0.finish(vec![("motiform", metadata.to_owned())])?.sync_all()?;
        Ok(())
    }
}

/// Gives `take` the groups of rows of a table, one after the other; without rows, one empty group. `take`
/// ends it by an error.
pub(crate) fn groups<E: From<Error>>(
    path: &Path,
    wanted: Option<&[String]>,
    take: &mut dyn FnMut(Table) -> std::result::Result<(), E>,
) -> std::result::Result<(), E> {
    let mut refused = None;
    let read = parquet_input::read(path, |reader| {
        let all = columns(reader.metadata().file_metadata());
        let places = places(&all, wanted).map_err(|problem| wrong(&problem))?;
        let empty = Table { columns: places.iter().map(|&place| all.columns[place].clone()).collect() };
        if reader.num_row_groups() == 0 {
            refused = take(empty.clone()).err();
        }
        for group in 0..reader.num_row_groups() {
            let group = reader.get_row_group(group)?;
            let mut table = empty.clone();
            for (&place, column) in places.iter().zip(&mut table.columns) {
                let Read::Number(values) = values(&*group, place)? else {
                    return Err(wrong(&format!("column {} does not hold numbers", column.name)));
                };
                column.values = values;
            }
            refused = take(table).err();
            if refused.is_some() {
                break;
            }
        }
        Ok(())
    });
    read.map_err(|error| Error::unreadable(path, error))?;
    refused.map_or(Ok(()), Err)
}

/// The columns of a file, without their values.
fn columns(file: &FileMetaData) -> Table {
    let meanings = file
        .key_value_metadata()
        .and_then(|entries| entries.iter().find(|entry| entry.key == "motiform.columns"))
        .and_then(|entry| {
            serde_json::from_slice::<serde_json::Value>(entry.value.as_deref()?.as_bytes()).ok()
        });
    let mut table = Table::default();
    for field in file.schema_descr().columns() {
        let meaning =
            meanings.as_ref().and_then(|all| all.get(field.name())?.as_str()).unwrap_or("").to_owned();
        table.push(field.name(), meaning, Vec::new());
    }
    table
}

/// The `metadata` that was written, if the file has it.
pub(crate) fn read_metadata(path: &Path) -> std::result::Result<Option<String>, Error> {
    let read = parquet_input::read(path, |reader| {
        let entries = reader.metadata().file_metadata().key_value_metadata();
        let entry = entries.and_then(|entries| entries.iter().find(|entry| entry.key == "motiform"));
        Ok(entry.and_then(|entry| entry.value.clone()))
    });
    read.map_err(|error| Error::unreadable(path, error))
}
