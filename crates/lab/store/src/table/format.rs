//! File formats of tables.

use std::path::Path;

/// The file format of tables.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Format {
    /// Parquet: compact, typed, with the manifest inside.
    #[default]
    Parquet,
    /// Comma-separated text.
    Csv,
}

impl Format {
    /// The format given by the extension of a file name.
    pub fn of_path(path: &Path) -> Option<Self> {
        match path.extension()?.to_str()? {
            "parquet" => Some(Self::Parquet),
            "csv" => Some(Self::Csv),
            _ => None,
        }
    }

    /// The name of the file of a table.
    pub fn file(self, table: &str) -> String {
        let extension = match self {
            Self::Parquet => "parquet",
            Self::Csv => "csv",
        };
        format!("{table}.{extension}")
    }
}
