//! Tables as CSV: a header line, shortest round-trip numbers, an empty field where a value is undefined.

use crate::Error;
use crate::Table;
use crate::table::columns::{Column, Stored, View, rows};
use crate::table::file::places;
use std::borrow::Cow;
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
        write_names(&table.columns, &mut out)?;
        Ok(Self(out))
    }

    /// Writes the rows of this table.
    pub(crate) fn rows(&mut self, table: &Table, rows: Range<usize>) -> std::io::Result<()> {
        write_rows(&table.columns, rows, &mut self.0)
    }

    /// Ends the file.
    pub(crate) fn finish(self) -> std::io::Result<()> {
        self.0.into_inner().map_err(std::io::IntoInnerError::into_error)?.sync_all()
    }
}

/// Writes a header line and all rows.
pub(crate) fn write_columns(columns: &[Column<impl Stored>], out: &mut impl Write) -> std::io::Result<()> {
    write_names(columns, out)?;
    write_rows(columns, 0..rows(columns), out)
}

fn write_names<V>(columns: &[Column<V>], out: &mut impl Write) -> std::io::Result<()> {
    let names: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
    writeln!(out, "{}", names.join(","))
}

fn write_rows(
    columns: &[Column<impl Stored>],
    rows: Range<usize>,
    out: &mut impl Write,
) -> std::io::Result<()> {
    // Readers skip an empty line, so the only field of a row is quoted where it is empty.
    let empty = if columns.len() == 1 { "\"\"" } else { "" };
    let views: Vec<View<'_>> = columns.iter().map(|column| column.values.view()).collect();
    for row in rows {
        for (place, view) in views.iter().enumerate() {
            out.write_all(if place == 0 { b"" } else { b"," })?;
            match view {
                View::Whole(values) => write!(out, "{}", values[row])?,
                View::Number(values) if values[row].is_nan() => out.write_all(empty.as_bytes())?,
                View::Number(values) => write!(out, "{:?}", values[row])?,
                View::Text(values) if values[row].is_empty() => out.write_all(empty.as_bytes())?,
                View::Text(values) => out.write_all(quoted(&values[row]).as_bytes())?,
            }
        }
        writeln!(out)?;
    }
    Ok(())
}

/// A text as a field (RFC 4180): in quotes where it contains a comma, a quote or a line end.
fn quoted(text: &str) -> Cow<'_, str> {
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")).into(),
        false => text.into(),
    }
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
    use crate::table::columns::Values;
    use crate::table::same_bits;

    /// Texts with commas, quotes and line ends come back, from a reader that is not ours.
    #[test]
    fn texts_are_quoted_where_they_must_be() {
        let texts = ["plain", "a, b", "say \"no\"", "two\nlines", ""].map(str::to_owned).to_vec();
        let columns = [
            Column::new("name", "", Values::Text(texts.clone())),
            Column::new("count", "", Values::Whole(vec![1, -2, 3, 4, 5])),
        ];
        let text = crate::columns::to_csv(&columns);
        let mut reader = csv::Reader::from_reader(text.as_slice());
        let read: Vec<String> = reader.records().map(|row| row.expect("a row")[0].to_owned()).collect();
        assert_eq!(read, texts);
    }

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
