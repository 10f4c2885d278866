//! Columns as the bytes of one Parquet file, and back.

use crate::table::columns::{Column, Values};
use crate::table::parquet_input::{column, numbers, read, wrong};
use crate::table::parquet_output::{self, Field};
use parquet::column::reader::ColumnReader;
use parquet::data_type::ByteArray;
use parquet::errors::Result;
use parquet::file::reader::FileReader;
use std::path::Path;
use std::sync::Arc;

fn field(column: &Column) -> Field<'_> {
    let values = match &column.values {
        Values::Whole(values) => parquet_output::Values::Whole(values),
        Values::Number(values) => parquet_output::Values::Number(values),
        Values::Text(values) => parquet_output::Values::Text(values),
    };
    Field { name: &column.name, meaning: column.meaning(), values }
}

/// The file, with these entries in its metadata. The same columns give the same bytes.
pub fn encode(columns: &[Column], metadata: Vec<(&str, String)>) -> Result<Vec<u8>> {
    let fields: Vec<Field<'_>> = columns.iter().map(field).collect();
    // the manifest knows the version
    parquet_output::write(Vec::new(), &fields, metadata, "motiform".to_owned())
}

/// The metadata entries of a file.
pub fn metadata(path: &Path) -> Result<Vec<(String, String)>> {
    read(path, |reader| {
        let entries = reader.metadata().file_metadata().key_value_metadata().cloned().unwrap_or_default();
        Ok(entries.into_iter().filter_map(|entry| Some((entry.key, entry.value?))).collect())
    })
}

/// The columns of a file; meanings are not read back.
pub fn decode(path: &Path) -> Result<Vec<Column>> {
    read(path, |reader| {
        if reader.num_row_groups() != 1 {
            return Err(wrong("a part has one row group"));
        }
        let group = reader.get_row_group(0)?;
        let rows = group.metadata().num_rows();
        let read = |(place, field): (usize, &Arc<parquet::schema::types::ColumnDescriptor>)| {
            Ok(Column::new(field.name(), "", read_values(group.get_column_reader(place)?, rows)?))
        };
        reader.metadata().file_metadata().schema_descr().columns().iter().enumerate().map(read).collect()
    })
}

fn read_values(reader: ColumnReader, rows: i64) -> Result<Values> {
    Ok(match reader {
        ColumnReader::Int64ColumnReader(mut input) => Values::Whole(column(&mut input, rows, false)?.0),
        ColumnReader::DoubleColumnReader(mut input) => {
            let (values, levels) = column(&mut input, rows, true)?;
            Values::Number(numbers(values, &levels))
        }
        ColumnReader::ByteArrayColumnReader(mut input) => {
            let values: Vec<ByteArray> = column(&mut input, rows, false)?.0;
            let text = |bytes: &ByteArray| bytes.as_utf8().map(str::to_owned);
            Values::Text(values.iter().map(text).collect::<Result<_>>()?)
        }
        _ => return Err(wrong("a column has an unexpected type")),
    })
}
