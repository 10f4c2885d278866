//! Tables as Parquet: one DOUBLE column each, null where a value is undefined; zstd; opens in pandas, polars, R, Julia.

use super::parquet_input::{self, wrong};
use motiform_study::Error;
use motiform_study::table::{Column, Table};
use parquet::basic::{Compression, Repetition, Type as PhysicalType, ZstdLevel};
use parquet::column::reader::ColumnReader;
use parquet::data_type::DoubleType;
use parquet::errors::Result;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::FileReader;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::Type;
use std::path::Path;
use std::sync::Arc;

/// Rows of a row group: bounded memory while writing and reading.
const GROUP_ROWS: usize = 1 << 18;

/// Writes the table; `metadata` (a JSON text) is kept under the key `motiform`, column meanings under
/// `motiform.columns`.
pub(crate) fn write(table: &Table, metadata: &str, path: &Path) -> std::result::Result<(), Error> {
    try_write(table, metadata, path).map_err(|error| Error::write_failed(path, error))
}

fn try_write(table: &Table, metadata: &str, path: &Path) -> Result<()> {
    let schema = Arc::new(schema(table)?);
    let meanings: serde_json::Map<String, serde_json::Value> =
        table.columns.iter().map(|c| (c.name.clone(), c.meaning.clone().into())).collect();
    let properties = WriterProperties::builder()
        .set_compression(Compression::ZSTD(ZstdLevel::try_new(3)?))
        .set_dictionary_enabled(false)
        .set_created_by(format!("motiform {}", motiform_study::dataset::VERSION))
        .set_key_value_metadata(Some(vec![
            KeyValue::new("motiform".to_owned(), metadata.to_owned()),
            KeyValue::new("motiform.columns".to_owned(), serde_json::Value::Object(meanings).to_string()),
        ]))
        .build();
    let file = std::fs::File::create(path)?;
    let mut writer = SerializedFileWriter::new(file, schema, Arc::new(properties))?;
    for start in (0..table.rows()).step_by(GROUP_ROWS) {
        let mut group = writer.next_row_group()?;
        for column in &table.columns {
            let values = &column.values[start..table.rows().min(start + GROUP_ROWS)];
            let Some(mut out) = group.next_column()? else { break };
            write_column(out.typed::<DoubleType>(), values)?;
            out.close()?;
        }
        group.close()?;
    }
    writer.into_inner()?.sync_all()?;
    Ok(())
}

fn schema(table: &Table) -> Result<Type> {
    let field = |column: &Column| {
        let field = Type::primitive_type_builder(&column.name, PhysicalType::DOUBLE);
        field.with_repetition(Repetition::OPTIONAL).build().map(Arc::new)
    };
    let fields = table.columns.iter().map(field).collect::<Result<Vec<_>>>()?;
    Type::group_type_builder("schema").with_fields(fields).build()
}

fn write_column(
    out: &mut parquet::column::writer::ColumnWriterImpl<'_, DoubleType>,
    values: &[f64],
) -> Result<()> {
    let levels: Vec<i16> = values.iter().map(|value| i16::from(!value.is_nan())).collect();
    let defined: Vec<f64> = values.iter().copied().filter(|value| !value.is_nan()).collect();
    out.write_batch(&defined, Some(&levels), None)?;
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

/// What was written as `metadata`, if the file has it.
pub(crate) fn read_metadata(path: &Path) -> std::result::Result<Option<String>, Error> {
    let read = parquet_input::read(path, |reader| {
        let entries = reader.metadata().file_metadata().key_value_metadata();
        let entry = entries.and_then(|entries| entries.iter().find(|entry| entry.key == "motiform"));
        Ok(entry.and_then(|entry| entry.value.clone()))
    });
    read.map_err(|error| Error::unreadable(path, error))
}
