//! Datasets on disk, written atomically.

pub mod columns;
mod csv_table;
pub mod disk;
mod folder;
mod hdf5;
mod leftovers;
pub mod parquet_input;
mod parquet_output;
mod parquet_table;
mod staging;

pub use csv_table::table_to_csv;
pub use folder::{Format, read_dataset, read_table_file, write_dataset, write_table};
pub use hdf5::{Fields, read_fields, write_fields};
pub use leftovers::sweep;
pub use parquet_input::decoding;
pub use staging::{Staging, replace_file};
