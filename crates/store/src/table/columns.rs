//! Typed columns: whole numbers, numbers (null where undefined), texts. As the bytes of one Parquet file and back, and as CSV.

#[cfg(feature = "formats")]
pub use super::parquet_columns::{decode, encode, metadata};
#[cfg(not(feature = "formats"))]
pub use crate::absent::{decode, encode, metadata};

/// A column of a part.
pub struct Column {
    /// Its name.
    pub name: String,
    meaning: &'static str,
    /// Its values.
    pub values: Values,
}

/// The values of a column.
pub enum Values {
    /// Whole numbers.
    Whole(Vec<i64>),
    /// Numbers; NaN is written as null.
    Number(Vec<f64>),
    /// Texts.
    Text(Vec<String>),
}

impl Column {
    /// A column; `meaning` describes it, with its unit.
    #[must_use]
    pub fn new(name: &str, meaning: &'static str, values: Values) -> Self {
        Self { name: name.to_owned(), meaning, values }
    }

    /// Its content, with the unit.
    #[must_use]
    pub fn meaning(&self) -> &'static str {
        self.meaning
    }
}

/// The columns as CSV: a header line, shortest round-trip numbers, an empty field where a number is undefined.
pub fn to_csv(columns: &[Column]) -> Vec<u8> {
    let rows = columns.first().map_or(0, |column| match &column.values {
        Values::Whole(values) => values.len(),
        Values::Number(values) => values.len(),
        Values::Text(values) => values.len(),
    });
    let field = |column: &Column, row: usize| match &column.values {
        Values::Whole(values) => values[row].to_string(),
        Values::Number(values) if values[row].is_nan() => String::new(),
        Values::Number(values) => format!("{:?}", values[row]),
        Values::Text(values) => values[row].clone(),
    };
    let mut out = csv::Writer::from_writer(Vec::new());
    // Writing into memory does not fail, and every record has as many fields as the first.
    let _ = out.write_record(columns.iter().map(|column| &column.name));
    for row in 0..rows {
        let _ = out.write_record(columns.iter().map(|column| field(column, row)));
    }
    out.into_inner().unwrap_or_default()
}
