//! Tables as Parquet: one DOUBLE column each, null where a value is undefined; zstd; opens in pandas, polars, R, Julia.

use super::parquet_input::{self, wrong};
use super::parquet_output::{self, Field, Values};
use motiform_study::Error;
use motiform_study::table::{Column, Table};
use parquet::column::reader::ColumnReader;
use parquet::errors::Result;
use parquet::file::reader::FileReader;
use std::path::Path;

/// Writes the table; `metadata` (a JSON text) is kept under the key `motiform`, column meanings under
/// `motiform.columns`.
pub(crate) fn write(table: &Table, metadata: &str, path: &Path) -> std::result::Result<(), Error> {
    try_write(table, metadata, path).map_err(|error| Error::write_failed(path, error))
}

fn try_write(table: &Table, metadata: &str, path: &Path) -> Result<()> {
    fn field(column: &Column) -> Field<'_> {
        Field { name: &column.name, meaning: &column.meaning, values: Values::Number(&column.values) }
    }
    let fields: Vec<Field<'_>> = table.columns.iter().map(field).collect();
    let version = format!("motiform {}", motiform_study::dataset::VERSION);
    let file = std::fs::File::create(path)?;
    parquet_output::write(file, &fields, vec![("motiform", metadata.to_owned())], version)?.sync_all()?;
    Ok(())
}

/// Reads a table back.
pub(crate) fn read(path: &Path) -> std::result::Result<Table, Error> {
    try_read(path).map_err(|error| Error::unreadable(path, error))
}

fn try_read(path: &Path) -> Result<Table> {
    parquet_input::read(path, |reader| {
        let file = reader.metadata().file_metadata();
        let meanings = file
            .key_value_metadata()
            .and_then(|entries| entries.iter().find(|entry| entry.key == "motiform.columns"))
            .and_then(|entry| serde_json::from_str::<serde_json::Value>(entry.value.as_deref()?).ok());
        let mut columns: Vec<Column> = Vec::new();
        for field in file.schema_descr().columns() {
            let name = field.name().to_owned();
            let meaning = meanings.as_ref().and_then(|all| all.get(&name)?.as_str()).unwrap_or("").to_owned();
            columns.push(Column { name, meaning, values: Vec::new() });
        }
        for group in 0..reader.num_row_groups() {
            let group = reader.get_row_group(group)?;
            for (index, column) in columns.iter_mut().enumerate() {
                let ColumnReader::DoubleColumnReader(mut input) = group.get_column_reader(index)? else {
                    return Err(wrong(&format!("column {} does not hold numbers", column.name)));
                };
                let (values, levels) = parquet_input::column(&mut input, group.metadata().num_rows(), true)?;
                column.values.extend(parquet_input::numbers(values, &levels));
            }
        }
        Ok(Table { columns })
    })
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
