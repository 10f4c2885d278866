//! Columns as the bytes of one Parquet file, and back.

use crate::table::columns::{Column, Values};
use crate::table::parquet_input::{Read, read, values, wrong};
use crate::table::parquet_output;
use parquet::data_type::ByteArray;
use parquet::errors::Result;
use parquet::file::reader::FileReader;
use std::path::Path;
use std::sync::Arc;

/// The file, with these entries in its metadata. The same columns give the same bytes.
pub fn encode(columns: &[Column], metadata: Vec<(&str, String)>) -> Result<Vec<u8>> {
    // the manifest knows the version
    parquet_output::write(Vec::new(), columns, metadata, "motiform".to_owned())
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
        let read = |(place, field): (usize, &Arc<parquet::schema::types::ColumnDescriptor>)| {
            Ok(Column::new(field.name(), "", whole(values(&*group, place)?)?))
        };
        reader.metadata().file_metadata().schema_descr().columns().iter().enumerate().map(read).collect()
    })
}

/// The values of a column of ours: texts and whole numbers are there in all rows.
fn whole(found: Read) -> Result<Values> {
    Ok(match found {
        Read::Whole(values) => Values::Whole(values),
        Read::Number(values) => Values::Number(values),
        Read::Text(values) => {
            let text = |bytes: Option<ByteArray>| match bytes {
                Some(bytes) => bytes.as_utf8().map(str::to_owned),
                None => Err(wrong("a text is missing")),
            };
            Values::Text(values.into_iter().map(text).collect::<Result<_>>()?)
        }
    })
}
