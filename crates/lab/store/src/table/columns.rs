//! Columns: whole numbers, numbers (null where undefined), texts. As the bytes of one Parquet file and back,
//! and as CSV.

#[cfg(feature = "formats")]
pub use super::parquet_columns::{decode, encode, metadata};
#[cfg(not(feature = "formats"))]
pub use crate::absent::{decode, encode, metadata};

use super::csv::write_columns;
use crate::Quantity;
use std::borrow::Cow;

/// A column of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Column<V = Values> {
    /// Name, ASCII.
    pub name: String,
    /// Its meaning, with its unit; for an undefined value, the reason.
    pub meaning: Cow<'static, str>,
    /// The values.
    pub values: V,
}

/// The values of a column.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Whole numbers.
    Whole(Vec<i64>),
    /// Numbers; NaN where undefined (written as null, or an empty field).
    Number(Vec<f64>),
    /// Texts.
    Text(Vec<String>),
}

/// Values are collected from what rows hold.
macro_rules! collected {
    ($($entry:ty => $Kind:ident, $value:expr;)*) => {$(
        impl FromIterator<$entry> for Values {
            fn from_iter<I: IntoIterator<Item = $entry>>(entries: I) -> Self {
                Self::$Kind(entries.into_iter().map($value).collect())
            }
        }
    )*};
}

collected! {
    f64 => Number, |number| number;
    Option<f64> => Number, |number| number.unwrap_or(f64::NAN);
    i64 => Whole, |number| number;
    usize => Whole, |number| i64::try_from(number).unwrap_or(i64::MAX);
    bool => Whole, i64::from;
    String => Text, |text| text;
    &'static str => Text, str::to_owned;
}

/// The values of a column, borrowed.
#[derive(Clone, Copy, Debug)]
pub enum View<'c> {
    /// Whole numbers.
    Whole(&'c [i64]),
    /// Numbers; NaN where undefined.
    Number(&'c [f64]),
    /// Texts.
    Text(&'c [String]),
}

/// Values that a file can hold.
pub trait Stored {
    /// The values, borrowed.
    fn view(&self) -> View<'_>;
}

impl Stored for Values {
    fn view(&self) -> View<'_> {
        match self {
            Self::Whole(values) => View::Whole(values),
            Self::Number(values) => View::Number(values),
            Self::Text(values) => View::Text(values),
        }
    }
}

impl Stored for Vec<f64> {
    fn view(&self) -> View<'_> {
        View::Number(self)
    }
}

impl View<'_> {
    /// Number of values.
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Whole(values) => values.len(),
            Self::Number(values) => values.len(),
            Self::Text(values) => values.len(),
        }
    }
}

impl<V> Column<V> {
    /// A column; `meaning` describes it, with its unit.
    pub fn new(name: &str, meaning: impl Into<Cow<'static, str>>, values: V) -> Self {
        Self { name: name.to_owned(), meaning: meaning.into(), values }
    }

    /// A column of a quantity, in the units of a model.
    pub fn of(quantity: &Quantity, values: V) -> Self {
        Self::new(quantity.name, quantity.described(), values)
    }

    /// A column of a quantity, in the units of the data.
    pub fn of_data(quantity: &Quantity, values: V) -> Self {
        Self::new(quantity.name, quantity.meaning, values)
    }
}

/// Number of rows of columns of equal length.
pub(crate) fn rows(columns: &[Column<impl Stored>]) -> usize {
    columns.first().map_or(0, |column| column.values.view().len())
}

/// The columns as CSV: a header line, shortest round-trip numbers, an empty field where a number is undefined.
pub fn to_csv(columns: &[Column<impl Stored>]) -> Vec<u8> {
    let mut text = Vec::new();
    let _ = write_columns(columns, &mut text); // writing into memory does not fail
    text
}
