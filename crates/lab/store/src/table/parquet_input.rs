//! Reading Parquet files that may be damaged: every count is checked against the data before anything is allocated.

use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::{ByteArray, DataType};
use parquet::errors::{ParquetError, Result};
use parquet::file::metadata::ParquetMetaData;
use parquet::file::reader::{FileReader, RowGroupReader, SerializedFileReader};
use std::cell::Cell;
use std::fs::File;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

/// Rows that are read at a time: the row count claimed by a page is never trusted beyond this.
const BATCH: usize = 1 << 16;

thread_local! {
    static DECODING: Cell<bool> = const { Cell::new(false) };
}

/// Returns `true` if this thread is reading a Parquet file: the library panics on some damaged files, which
/// is caught and becomes an error. A program's panic hook may stay silent meanwhile.
pub fn decoding() -> bool {
    DECODING.get()
}

/// Opens a file, checks its footer against its length, and reads it.
pub fn read<T>(path: &Path, contents: impl FnOnce(&SerializedFileReader<File>) -> Result<T>) -> Result<T> {
    let length = path.metadata()?;
    if !length.is_file() {
        return Err(wrong("it is not a file"));
    }
    DECODING.set(true);
    let read = catch_unwind(AssertUnwindSafe(|| {
        let reader = SerializedFileReader::new(File::open(path)?)?;
        check(reader.metadata(), length.len())?;
        contents(&reader)
    }));
    DECODING.set(false);
    read.unwrap_or_else(|_| Err(wrong("it is damaged")))
}

/// The footer must be consistent with the file: the library asserts some of this, and trusts the rest.
fn check(metadata: &ParquetMetaData, length: u64) -> Result<()> {
    let length = i64::try_from(length).unwrap_or(i64::MAX);
    let mut rows = 0_i64;
    for group in metadata.row_groups() {
        rows = rows.checked_add(group.num_rows()).unwrap_or(-1);
        for chunk in group.columns() {
            let start = chunk.dictionary_page_offset().unwrap_or(chunk.data_page_offset());
            let end = start.checked_add(chunk.compressed_size()).unwrap_or(-1);
            if start < 0 || chunk.compressed_size() < 0 || end > length || end < 0 {
                return Err(wrong("a column lies outside the file"));
            }
            if group.num_rows() < 0 || chunk.num_values() != group.num_rows() {
                return Err(wrong(&format!(
                    "a column has {} values where its group has {} rows",
                    chunk.num_values(),
                    group.num_rows()
                )));
            }
        }
    }
    if rows != metadata.file_metadata().num_rows() {
        let said = metadata.file_metadata().num_rows();
        return Err(wrong(&format!("its footer says {said} rows, its groups {rows}")));
    }
    Ok(())
}

/// The values of a column of a group of rows.
pub enum Read {
    /// Integers without gaps.
    Whole(Vec<i64>),
    /// Numbers; NaN for nulls.
    Number(Vec<f64>),
    /// Texts, as references to the pages: a long text that is repeated takes no memory.
    Text(Vec<Option<ByteArray>>),
}

/// Reads a column of a group: floating-point numbers, integers (with nulls they are numbers) or texts.
///
/// # Errors
/// Another type, nested values, fewer rows than the footer states.
pub fn values(group: &dyn RowGroupReader, place: usize) -> Result<Read> {
    let description = group.metadata().column(place).column_descr_ptr();
    let name = description.name();
    if description.max_rep_level() > 0 || description.max_def_level() > 1 {
        return Err(wrong(&format!("column {name} is nested")));
    }
    let (rows, nulls) = (group.metadata().num_rows(), description.max_def_level() > 0);
    macro_rules! numbers {
        ($input:expr, $of:expr) => {{
            let (values, levels) = column(&mut $input, rows, nulls)?;
            let values: Vec<f64> = values.into_iter().map($of).collect();
            Read::Number(if nulls { numbers(values, &levels) } else { values })
        }};
    }
    Ok(match group.get_column_reader(place)? {
        ColumnReader::Int64ColumnReader(mut input) if !nulls => {
            Read::Whole(column(&mut input, rows, false)?.0)
        }
        ColumnReader::DoubleColumnReader(mut input) => numbers!(input, |value| value),
        ColumnReader::FloatColumnReader(mut input) => numbers!(input, f64::from),
        ColumnReader::Int32ColumnReader(mut input) => numbers!(input, f64::from),
        ColumnReader::Int64ColumnReader(mut input) => numbers!(input, |value| value as f64),
        ColumnReader::ByteArrayColumnReader(mut input) => {
            let (values, levels) = column(&mut input, rows, nulls)?;
            let mut texts = values.into_iter();
            let text = |level: i16| if level == 0 { None } else { texts.next() };
            Read::Text(if nulls { levels.into_iter().map(text).collect() } else { texts.map(Some).collect() })
        }
        _ => return Err(wrong(&format!("column {name} has a type that is not read here"))),
    })
}

/// The values of a column of `rows` rows and, for a column with nulls, which rows have one (1) or none (0).
fn column<T: DataType>(
    input: &mut ColumnReaderImpl<T>,
    rows: i64,
    nulls: bool,
) -> Result<(Vec<T::T>, Vec<i16>)> {
    let rows = usize::try_from(rows).map_err(|_| wrong("a group has less than no rows"))?;
    let (mut values, mut levels, mut read) = (Vec::new(), Vec::new(), 0);
    while read < rows {
        let levels = nulls.then_some(&mut levels);
        let records = input.read_records(BATCH.min(rows - read), levels, None, &mut values)?.0;
        if records == 0 {
            return Err(wrong(&format!("a column has {read} rows where the footer says {rows}")));
        }
        read += records;
    }
    if nulls && levels.is_empty() {
        levels.resize(values.len(), 1); // a column that has no nulls has no levels
    }
    let found = if nulls { levels.len() } else { values.len() };
    if found != rows {
        return Err(wrong(&format!("a column has {found} values in {rows} rows")));
    }
    Ok((values, levels))
}

/// A column of numbers with NaN for each null.
fn numbers(values: Vec<f64>, levels: &[i16]) -> Vec<f64> {
    let mut defined = values.into_iter();
    levels
        .iter()
        .map(|&level| if level == 0 { f64::NAN } else { defined.next().unwrap_or(f64::NAN) })
        .collect()
}

/// An error of this reason.
pub fn wrong(what: &str) -> ParquetError {
    ParquetError::General(what.to_owned())
}
