//! Datasets on disk: tables, fields, and their folder (in [`store`], as all results).
//!
//! The feature `formats`, on by default, has Parquet and HDF5 files, which need C and threads; without it they are refused.

#[cfg(not(feature = "formats"))]
mod absent;
pub mod columns;
mod csv_table;
pub use motiform_store::{self as store, Folder, Kind, Opening, Staged, StagedFile, disk, kind_of};
mod fields;
mod folder;
#[cfg(feature = "formats")]
mod hdf5;
mod journal;
#[cfg(feature = "formats")]
mod parquet_columns;
#[cfg(feature = "formats")]
pub mod parquet_input;
#[cfg(feature = "formats")]
mod parquet_output;
#[cfg(feature = "formats")]
mod parquet_table;
mod table_file;

#[cfg(not(feature = "formats"))]
use absent as parquet_table;
#[cfg(not(feature = "formats"))]
pub use absent::{Absent, read_fields, write_fields};
pub use csv_table::table_to_csv;
pub use fields::Fields;
pub use folder::{
    Format, read_dataset, read_dataset_by, read_table_file, table_path, trajectory_path, write_dataset,
    write_rest,
};
#[cfg(feature = "formats")]
pub use hdf5::{read_fields, write_fields};
pub use journal::{Journal, WORK, end_of_work};
#[cfg(feature = "formats")]
pub use parquet_input::decoding;
pub use table_file::{GROUP_ROWS, TableWriter, read_columns, read_groups, write_table};
