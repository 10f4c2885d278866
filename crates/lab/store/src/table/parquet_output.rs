//! Writing Parquet files: zstd, no dictionaries, so that the same columns give the same bytes.
//!
//! Numbers of a short table are stored as they are: preparing the compressor of a column costs more than
//! writing a thousand numbers, and
//! they hardly get shorter. (The parts of a scan have some 40 rows and 17 columns of numbers: compressors
//! took a tenth of Fig. 1.)

use crate::table::columns::{Column, Stored, View, rows};
use crate::table::file::GROUP_ROWS;
use parquet::basic::{Compression, LogicalType, Repetition, Type as PhysicalType, ZstdLevel};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::Result;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{ColumnPath, Type};
use std::io::Write;
use std::ops::Range;
use std::sync::Arc;

/// Rows from which on numbers are compressed.
const COMPRESSED_ROWS: usize = 1024;

/// Writes columns of equal length with these entries in the metadata; meanings are a separate entry,
/// `motiform.columns`.
pub(crate) fn write<W: Write + Send>(
    out: W,
    columns: &[Column<impl Stored>],
    metadata: Vec<(&str, String)>,
    created_by: String,
) -> Result<W> {
    let rows = rows(columns);
    let mut writer = Groups::new(out, columns, rows, created_by)?;
    for start in (0..rows).step_by(GROUP_ROWS) {
        writer.group(columns, start..rows.min(start + GROUP_ROWS))?;
    }
    writer.finish(metadata)
}

/// A file that is written group by group.
pub(crate) struct Groups<W: Write + Send> {
    writer: SerializedFileWriter<W>,
    meanings: String,
}

impl<W: Write + Send> Groups<W> {
    /// A file with columns of these names and types; `rows` of them at least decide whether numbers are compressed.
    pub(crate) fn new(
        out: W,
        columns: &[Column<impl Stored>],
        rows: usize,
        created_by: String,
    ) -> Result<Self> {
        let fields = columns.iter().map(schema).collect::<Result<Vec<_>>>()?;
        let schema = Type::group_type_builder("schema").with_fields(fields).build()?;
        let meanings: serde_json::Map<String, serde_json::Value> =
            columns.iter().map(|column| (column.name.clone(), (&*column.meaning).into())).collect();
        let mut properties =
            WriterProperties::builder().set_compression(Compression::ZSTD(ZstdLevel::try_new(3)?));
        for column in columns
            .iter()
            .filter(|column| rows < COMPRESSED_ROWS && !matches!(column.values.view(), View::Text(_)))
        {
            let path = ColumnPath::from(column.name.as_str());
            properties = properties.set_column_compression(path, Compression::UNCOMPRESSED);
        }
        let properties = properties.set_dictionary_enabled(false).set_created_by(created_by).build();
        let writer = SerializedFileWriter::new(out, Arc::new(schema), Arc::new(properties))?;
        Ok(Self { writer, meanings: serde_json::Value::Object(meanings).to_string() })
    }

    /// Writes these rows as a group.
    pub(crate) fn group(&mut self, columns: &[Column<impl Stored>], rows: Range<usize>) -> Result<()> {
        let mut group = self.writer.next_row_group()?;
        for column in columns {
            put(column.values.view(), rows.clone(), &mut group)?;
        }
        group.close()?;
        Ok(())
    }

    /// Ends the file.
    pub(crate) fn finish(mut self, metadata: Vec<(&str, String)>) -> Result<W> {
        for (key, value) in metadata.into_iter().chain([("motiform.columns", self.meanings)]) {
            self.writer.append_key_value_metadata(KeyValue::new(key.to_owned(), value));
        }
        self.writer.into_inner()
    }
}

fn schema(column: &Column<impl Stored>) -> Result<Arc<Type>> {
    let (physical, repetition, logical) = match column.values.view() {
        View::Whole(_) => (PhysicalType::INT64, Repetition::REQUIRED, None),
        View::Number(_) => (PhysicalType::DOUBLE, Repetition::OPTIONAL, None),
        View::Text(_) => (PhysicalType::BYTE_ARRAY, Repetition::REQUIRED, Some(LogicalType::String)),
    };
    let field = Type::primitive_type_builder(&column.name, physical).with_repetition(repetition);
    field.with_logical_type(logical).build().map(Arc::new)
}

/// Writes these rows of a column.
fn put<W: Write + Send>(
    values: View<'_>,
    rows: Range<usize>,
    group: &mut SerializedRowGroupWriter<'_, W>,
) -> Result<()> {
    let Some(mut out) = group.next_column()? else { return Ok(()) };
    match values {
        View::Whole(values) => out.typed::<Int64Type>().write_batch(&values[rows], None, None)?,
        View::Number(values) => {
            let values = &values[rows];
            let levels = levels(values);
            let numbers = out.typed::<DoubleType>();
            if levels.contains(&0) {
                let defined: Vec<f64> = values.iter().copied().filter(|value| !value.is_nan()).collect();
                numbers.write_batch(&defined, Some(&levels), None)?
            } else {
                numbers.write_batch(values, Some(&levels), None)?
            }
        }
        View::Text(values) => {
            let texts: Vec<ByteArray> =
                values[rows].iter().map(|text| ByteArray::from(text.as_str())).collect();
            out.typed::<ByteArrayType>().write_batch(&texts, None, None)?
        }
    };
    out.close()
}

/// 1 for each number, 0 for one that is not defined. A loop: this crate is built for size, where iterators
/// are calls for every number.
fn levels(values: &[f64]) -> Vec<i16> {
    let mut levels = vec![1; values.len()];
    let mut row = 0;
    while row < values.len() {
        if values[row].is_nan() {
            levels[row] = 0;
        }
        row += 1;
    }
    levels
}
