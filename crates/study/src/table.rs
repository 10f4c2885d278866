//! A table of numbers with named columns: what is written to Parquet and CSV, and read back.

/// A column of numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Name, ASCII.
    pub name: String,
    /// Its meaning, with its unit; for an undefined value, the reason.
    pub meaning: String,
    /// The values; NaN where undefined (written as null, or an empty field).
    pub values: Vec<f64>,
}

/// Columns of equal length.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// The columns in file order.
    pub columns: Vec<Column>,
}

impl Table {
    /// Appends a column.
    pub fn push(&mut self, name: &str, meaning: impl Into<String>, values: Vec<f64>) {
        self.columns.push(Column { name: name.to_owned(), meaning: meaning.into(), values });
    }

    /// The values of a column.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&[f64]> {
        self.columns.iter().find(|column| column.name == name).map(|column| column.values.as_slice())
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |column| column.values.len())
    }
}

/// Equality of bits, so that NaN equals NaN: the meaning of 'the same dataset'.
#[must_use]
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
