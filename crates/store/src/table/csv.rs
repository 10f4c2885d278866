//! Tables as CSV: a header line, shortest round-trip numbers, an empty field where a value is undefined.

use crate::Error;
use crate::Table;
use crate::table::file::places;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::ops::Range;
use std::path::Path;

/// Rows that are read at a time.
const ROWS: usize = 1 << 16;

/// A file of a table that is written while its rows come.
pub(crate) struct Writer(BufWriter<File>);

impl Writer {
    /// A file with the columns of this table.
    pub(crate) fn new(table: &Table, path: &Path) -> std::io::Result<Self> {
        let mut out = BufWriter::new(File::create(path)?);
        write_names(table, &mut out)?;
        Ok(Self(out))
    }

    /// Writes the rows of this table.
    pub(crate) fn rows(&mut self, table: &Table, rows: Range<usize>) -> std::io::Result<()> {
        write_rows(table, rows, &mut self.0)
    }

    /// Ends the file.
    pub(crate) fn finish(self) -> std::io::Result<()> {
        self.0.into_inner().map_err(std::io::IntoInnerError::into_error)?.sync_all()
    }
}

/// The text of a table's CSV file.
#[must_use]
pub fn table_to_csv(table: &Table) -> Vec<u8> {
    let mut text = Vec::new();
    // Writing into memory does not fail.
    let _ = write_names(table, &mut text).and_then(|()| write_rows(table, 0..table.rows(), &mut text));
    text
}

fn write_names(table: &Table, out: &mut impl Write) -> std::io::Result<()> {
    let names: Vec<&str> = table.columns.iter().map(|column| column.name.as_str()).collect();
    writeln!(out, "{}", names.join(","))
}

fn write_rows(table: &Table, rows: Range<usize>, out: &mut impl Write) -> std::io::Result<()> {
    // Readers skip an empty line, so the only field of a row is quoted where it is empty.
    let undefined = if table.columns.len() == 1 { "\"\"" } else { "" };
    for row in rows {
        for (place, column) in table.columns.iter().enumerate() {
            let comma = if place == 0 { "" } else { "," };
            let value = column.values[row];
            if value.is_nan() { write!(out, "{comma}{undefined}") } else { write!(out, "{comma}{value:?}") }?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// Gives `take` the rows of a table, some at a time; without rows, one empty group. `take` ends it by an error.
pub(crate) fn groups<E: From<Error>>(
    path: &Path,
    wanted: Option<&[String]>,
    take: &mut dyn FnMut(Table) -> Result<(), E>,
) -> Result<(), E> {
    let unreadable = |error: csv::Error| Error::unreadable(path, error);
    let mut reader = csv::Reader::from_path(path).map_err(unreadable)?;
    let mut all = Table::default();
    reader.headers().map_err(unreadable)?.iter().for_each(|name| all.push(name, "", Vec::new()));
    let places = places(&all, wanted).map_err(|problem| Error::unreadable(path, problem))?;
    let empty = Table { columns: places.iter().map(|&place| all.columns[place].clone()).collect() };
    let mut table = empty.clone();
    let mut given = false;
    for (row, record) in reader.records().enumerate() {
        let record = record.map_err(unreadable)?;
        for (column, field) in
            table.columns.iter_mut().zip(places.iter().filter_map(|&place| record.get(place)))
        {
            column.values.push(number(field).ok_or_else(|| {
                let problem = format!("row {}, column {}: {field:?} is not a number", row + 2, column.name);
                Error::unreadable(path, problem)
            })?);
        }
        if table.rows() == ROWS {
            take(std::mem::replace(&mut table, empty.clone()))?;
            given = true;
        }
    }
    if table.rows() > 0 || !given { take(table) } else { Ok(()) }
}

/// The number in a field: NaN where it is empty.
fn number(field: &str) -> Option<f64> {
    if field.is_empty() { Some(f64::NAN) } else { field.parse().ok() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::same_bits;

    /// Tables of one column need care: a line with an empty field is an empty line, and readers skip those.
    #[test]
    fn an_undefined_value_in_a_single_column_is_kept() {
        let mut table = Table::default();
        table.push("rest_time", "", vec![1.0, f64::NAN, -0.0, f64::NAN]);
        let file = tempfile::NamedTempFile::new().expect("a temporary file");
        let mut writer = Writer::new(&table, file.path()).expect("a file");
        writer.rows(&table, 0..4).and_then(|()| writer.finish()).expect("written");
        let mut read = None;
        groups(file.path(), None, &mut |rows| {
            read = Some(rows);
            Ok::<(), Error>(())
        })
        .expect("read");
        assert!(read.is_some_and(|read| same_bits(&table, &read)));
    }
}
