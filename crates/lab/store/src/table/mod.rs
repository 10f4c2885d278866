//! A table of numbers with named columns: what is written to Parquet and CSV, and read back.

pub mod columns;
mod csv;
mod file;
mod format;
#[cfg(feature = "formats")]
mod parquet_columns;
#[cfg(feature = "formats")]
pub mod parquet_input;
#[cfg(feature = "formats")]
mod parquet_output;
#[cfg(feature = "formats")]
mod parquet_table;

#[cfg(not(feature = "formats"))]
use crate::absent as parquet_table;
pub use columns::Column;
pub use file::{GROUP_ROWS, TableWriter, read_columns, read_groups, read_table, write_table};
pub use format::Format;

use crate::{Error, Quantity};
use std::borrow::Cow;
use std::path::Path;

/// The text that was written with a Parquet table, such as its manifest; `None` for CSV and where there is none.
///
/// # Errors
/// [`Error::Unreadable`].
pub fn table_metadata(path: &Path) -> Result<Option<String>, Error> {
    match Format::of_path(path) {
        Some(Format::Parquet) => parquet_table::read_metadata(path),
        _ => Ok(None),
    }
}

/// Columns of numbers of equal length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// The columns in file order.
    pub columns: Vec<Column<Vec<f64>>>,
}

impl Table {
    /// The columns of these quantities.
    pub fn of(quantities: &[&Quantity], values: Vec<Vec<f64>>) -> Self {
        let columns = quantities.iter().zip(values).map(|(quantity, values)| Column::of(quantity, values));
        Self { columns: columns.collect() }
    }

    /// Appends a column.
    pub fn push(&mut self, name: &str, meaning: impl Into<Cow<'static, str>>, values: Vec<f64>) {
        self.columns.push(Column::new(name, meaning, values));
    }

    /// The values of a column.
    pub fn get(&self, name: &str) -> Option<&[f64]> {
        self.columns.iter().find(|column| column.name == name).map(|column| column.values.as_slice())
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |column| column.values.len())
    }
}

/// Equality of bits, so that NaN equals NaN: the meaning of 'the same dataset'.
pub fn same_bits(a: &Table, b: &Table) -> bool {
    let bits = |table: &Table| -> Vec<(String, Vec<u64>)> {
        table
            .columns
            .iter()
            .map(|c| (c.name.clone(), c.values.iter().map(|x| x.to_bits()).collect()))
            .collect()
    };
    bits(a) == bits(b)
}
