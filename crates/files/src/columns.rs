//! Typed columns as the bytes of one Parquet file, and back: whole numbers, numbers (null where undefined), texts.

use crate::parquet_input::{column, numbers, read, wrong};
use crate::parquet_output::{self, Field};
use parquet::column::reader::ColumnReader;
use parquet::data_type::ByteArray;
use parquet::errors::Result;
use parquet::file::reader::FileReader;
use std::path::Path;
use std::sync::Arc;

/// A column of a part.
pub struct Column {
    /// Its name.
    pub name: String,
    meaning: &'static str,
    /// Its values.
    pub values: Values,
}

/// The values of a column.
pub enum Values {
    /// Whole numbers.
    Whole(Vec<i64>),
    /// Numbers; NaN is written as null.
    Number(Vec<f64>),
    /// Texts.
    Text(Vec<String>),
}

impl Column {
    /// A column; `meaning` describes it, with its unit.
    #[must_use]
    pub fn new(name: &str, meaning: &'static str, values: Values) -> Self {
        Self { name: name.to_owned(), meaning, values }
    }

    fn field(&self) -> Field<'_> {
        let values = match &self.values {
            Values::Whole(values) => parquet_output::Values::Whole(values),
            Values::Number(values) => parquet_output::Values::Number(values),
            Values::Text(values) => parquet_output::Values::Text(values),
        };
        Field { name: &self.name, meaning: self.meaning, values }
    }
}

/// The columns as CSV: a header line, shortest round-trip numbers, an empty field where a number is undefined.
pub fn to_csv(columns: &[Column]) -> Vec<u8> {
    let rows = columns.first().map_or(0, |column| match &column.values {
        Values::Whole(values) => values.len(),
        Values::Number(values) => values.len(),
        Values::Text(values) => values.len(),
    });
    let field = |column: &Column, row: usize| match &column.values {
        Values::Whole(values) => values[row].to_string(),
        Values::Number(values) if values[row].is_nan() => String::new(),
        Values::Number(values) => format!("{:?}", values[row]),
        Values::Text(values) => values[row].clone(),
    };
    let mut out = csv::Writer::from_writer(Vec::new());
    // Writing into memory does not fail, and every record has as many fields as the first.
    let _ = out.write_record(columns.iter().map(|column| &column.name));
    for row in 0..rows {
        let _ = out.write_record(columns.iter().map(|column| field(column, row)));
    }
    out.into_inner().unwrap_or_default()
}

/// The file, with these entries in its metadata. The same columns give the same bytes.
pub fn encode(columns: &[Column], metadata: Vec<(&str, String)>) -> Result<Vec<u8>> {
    let fields: Vec<Field<'_>> = columns.iter().map(Column::field).collect();
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
