//! Tables as CSV: a header line, shortest round-trip numbers, an empty field where a value is undefined.

use motiform_study::Error;
use motiform_study::table::{Column, Table};
use std::io::{BufWriter, Write};
use std::path::Path;

pub(crate) fn write(table: &Table, path: &Path) -> Result<(), Error> {
    let failed = |error: std::io::Error| Error::write_failed(path, error);
    let mut out = BufWriter::new(std::fs::File::create(path).map_err(failed)?);
    write_to(table, &mut out).map_err(failed)?;
    out.into_inner().map_err(|error| failed(error.into_error()))?.sync_all().map_err(failed)
}

/// The text of a table's CSV file.
#[must_use]
pub fn table_to_csv(table: &Table) -> Vec<u8> {
    let mut text = Vec::new();
    let _ = write_to(table, &mut text); // writing into memory does not fail
    text
}

fn write_to(table: &Table, out: &mut impl Write) -> std::io::Result<()> {
    let names: Vec<&str> = table.columns.iter().map(|column| column.name.as_str()).collect();
    writeln!(out, "{}", names.join(","))?;
    // Readers skip an empty line, so the only field of a row is quoted where it is empty.
    let undefined = if table.columns.len() == 1 { "\"\"" } else { "" };
    for row in 0..table.rows() {
        for (place, column) in table.columns.iter().enumerate() {
            let comma = if place == 0 { "" } else { "," };
            let value = column.values[row];
            if value.is_nan() { write!(out, "{comma}{undefined}") } else { write!(out, "{comma}{value:?}") }?;
        }
        writeln!(out)?;
    }
    Ok(())
}

pub(crate) fn read(path: &Path) -> Result<Table, Error> {
    let unreadable = |error: csv::Error| Error::unreadable(path, error);
    let mut reader = csv::Reader::from_path(path).map_err(unreadable)?;
    let names = reader.headers().map_err(unreadable)?.clone();
    let mut columns: Vec<Column> = names
        .iter()
        .map(|name| Column { name: name.to_owned(), meaning: String::new(), values: Vec::new() })
        .collect();
    for (row, record) in reader.records().enumerate() {
        let record = record.map_err(unreadable)?;
        for (column, field) in columns.iter_mut().zip(&record) {
            let value = if field.is_empty() { Ok(f64::NAN) } else { field.parse() };
            let value = value.map_err(|_| {
                Error::unreadable(
                    path,
                    format!("row {}, column {}: {field:?} is not a number", row + 2, column.name),
                )
            })?;
            column.values.push(value);
        }
    }
    Ok(Table { columns })
}

#[cfg(test)]
mod tests {
    use super::*;
    use motiform_study::table::same_bits;

    /// Tables of one column need care: a line with an empty field is an empty line, and readers skip those.
    #[test]
    fn an_undefined_value_in_a_single_column_is_kept() {
        let mut table = Table::default();
        table.push("rest_time", "", vec![1.0, f64::NAN, -0.0, f64::NAN]);
        let file = tempfile::NamedTempFile::new().expect("a temporary file");
        write(&table, file.path()).expect("written");
        assert!(same_bits(&table, &read(file.path()).expect("read")));
    }
}
