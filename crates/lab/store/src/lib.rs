//! Results on disk: tables as Parquet and CSV, fields as HDF5, and folders with one rule for what in them is ours.
//!
//! Every folder that motiform writes has an inventory, [`INVENTORY`]: what kind of result it is, and the name and SHA-256 of each of its
//! files. A file is replaced or removed only if the inventory lists it and its digest is one that was listed: then motiform wrote it and
//! nobody changed it. Everything else stays in its place.
//!
//! * [`Staged`]: a result that is there whole or not at all, written beside its place.
//! * [`Folder`]: a result that grows file by file, and can be continued after a kill.
//! * [`StagedFile`]: a single file; its inventory is a hidden file in the same folder.
//!
//! The feature `formats`, on by default, has Parquet and HDF5 files, which need C and threads; without it they are refused.

#[cfg(not(feature = "formats"))]
mod absent;
mod audit;
mod counted;
mod digest;
pub mod disk;
mod draft;
mod error;
mod fields;
mod folder;
#[cfg(feature = "formats")]
mod hdf5;
mod inventory;
mod journal;
mod kind;
mod lock;
mod mend;
mod place;
pub mod quantity;
mod replace;
mod single;
mod staged;
mod survey;
pub mod table;
mod target;

#[cfg(not(feature = "formats"))]
pub use absent::{Absent, read_fields, write_fields};
pub use audit::Audit;
pub use counted::counted;
pub use digest::{sha256_file, sha256_hex};
pub use error::{Error, advice};
pub use fields::Fields;
pub use folder::{Folder, Opening};
#[cfg(feature = "formats")]
pub use hdf5::{read_fields, write_fields};
pub use inventory::{INVENTORY, Inventory, is_figure};
pub use journal::{Journal, WORK, end_of_work};
pub use kind::{Kind, kind_of};
pub use mend::mend;
pub use quantity::{Dimension, Quantity};
pub use single::StagedFile;
pub use staged::Staged;
#[cfg(feature = "formats")]
pub use table::parquet_input::decoding;
pub use table::{
    Format, GROUP_ROWS, Table, TableWriter, columns, read_columns, read_groups, read_table, table_metadata,
    write_table,
};

/// Version of motiform, as inventories state it.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
