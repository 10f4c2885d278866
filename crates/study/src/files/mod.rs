//! Datasets on disk: a folder that appears whole or not at all.

mod csv_table;
mod folder;
mod parquet_table;
mod staging;

pub use folder::{Format, read_dataset, write_dataset, write_table};
pub use staging::{Staging, replace_file};
