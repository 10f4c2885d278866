//! Writing Parquet files: zstd, no dictionaries, so that the same columns give the same bytes.
//!
//! Numbers of a short table are stored as they are: preparing the compressor of a column costs more than writing a thousand numbers, and
//! they hardly get shorter. (The parts of a scan have some 40 rows and 17 columns of numbers: compressors took a tenth of Fig. 1.)

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

/// A column to be written.
pub(crate) struct Field<'c> {
    pub(crate) name: &'c str,
    /// Its meaning, with its unit.
    pub(crate) meaning: &'c str,
    pub(crate) values: Values<'c>,
}

/// Its values.
#[derive(Clone, Copy)]
pub(crate) enum Values<'c> {
    Whole(&'c [i64]),
    /// NaN is written as null.
    Number(&'c [f64]),
    Text(&'c [String]),
}

/// Writes columns of equal length with these entries in the metadata; meanings are a separate entry, `motiform.columns`.
pub(crate) fn write<W: Write + Send>(
    out: W,
    columns: &[Field<'_>],
    metadata: Vec<(&str, String)>,
    created_by: String,
) -> Result<W> {
    let rows = columns.first().map_or(0, |column| column.values.len());
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
    pub(crate) fn new(out: W, columns: &[Field<'_>], rows: usize, created_by: String) -> Result<Self> {
        let fields = columns.iter().map(Field::schema).collect::<Result<Vec<_>>>()?;
        let schema = Type::group_type_builder("schema").with_fields(fields).build()?;
        let meanings: serde_json::Map<String, serde_json::Value> =
            columns.iter().map(|column| (column.name.to_owned(), column.meaning.into())).collect();
        let mut properties =
            WriterProperties::builder().set_compression(Compression::ZSTD(ZstdLevel::try_new(3)?));
        for column in columns.iter().filter(|column| rows < COMPRESSED_ROWS && !column.is_text()) {
            let path = ColumnPath::from(column.name);
            properties = properties.set_column_compression(path, Compression::UNCOMPRESSED);
        }
        let properties = properties.set_dictionary_enabled(false).set_created_by(created_by).build();
        let writer = SerializedFileWriter::new(out, Arc::new(schema), Arc::new(properties))?;
        Ok(Self { writer, meanings: serde_json::Value::Object(meanings).to_string() })
    }

    /// Writes these rows as a group.
    pub(crate) fn group(&mut self, columns: &[Field<'_>], rows: Range<usize>) -> Result<()> {
        let mut group = self.writer.next_row_group()?;
        for column in columns {
            column.values.write(rows.clone(), &mut group)?;
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

impl Field<'_> {
    fn is_text(&self) -> bool {
        matches!(self.values, Values::Text(_))
    }

    fn schema(&self) -> Result<Arc<Type>> {
        let (physical, repetition, logical) = match self.values {
            Values::Whole(_) => (PhysicalType::INT64, Repetition::REQUIRED, None),
            Values::Number(_) => (PhysicalType::DOUBLE, Repetition::OPTIONAL, None),
            Values::Text(_) => (PhysicalType::BYTE_ARRAY, Repetition::REQUIRED, Some(LogicalType::String)),
        };
        let field = Type::primitive_type_builder(self.name, physical).with_repetition(repetition);
        field.with_logical_type(logical).build().map(Arc::new)
    }
}

impl Values<'_> {
    fn len(&self) -> usize {
        match self {
            Self::Whole(values) => values.len(),
            Self::Number(values) => values.len(),
            Self::Text(values) => values.len(),
        }
    }

    fn write<W: Write + Send>(
        &self,
        rows: Range<usize>,
        group: &mut SerializedRowGroupWriter<'_, W>,
    ) -> Result<()> {
        let Some(mut out) = group.next_column()? else { return Ok(()) };
        match self {
            Self::Whole(values) => out.typed::<Int64Type>().write_batch(&values[rows], None, None)?,
            Self::Number(values) => {
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
            Self::Text(values) => {
                let texts: Vec<ByteArray> =
                    values[rows].iter().map(|text| ByteArray::from(text.as_str())).collect();
                out.typed::<ByteArrayType>().write_batch(&texts, None, None)?
            }
        };
        out.close()
    }
}

/// 1 for each number, 0 for one that is not defined. A loop: this crate is built for size, where iterators are calls for every number.
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
