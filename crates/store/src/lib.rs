//! Result folders: one rule for what in them is ours.
//!
//! Every folder that motiform writes has an inventory, [`INVENTORY`]: what kind of result it is, and the name and SHA-256 of each of its
//! files. A file is replaced or removed only if the inventory lists it and its digest is one that was listed: then motiform wrote it and
//! nobody changed it. Everything else stays in its place.
//!
//! * [`Staged`]: a result that is there whole or not at all, written beside its place.
//! * [`Folder`]: a result that grows file by file, and can be continued after a kill.
//! * [`StagedFile`]: a single file; its inventory is a hidden file in the same folder.

mod audit;
mod digest;
pub mod disk;
mod draft;
mod earlier;
mod error;
mod folder;
mod inventory;
mod kind;
mod lock;
mod mend;
mod place;
mod replace;
mod single;
mod staged;
mod survey;
mod target;

pub use audit::Audit;
pub use digest::{sha256_file, sha256_hex};
pub use earlier::kind_of;
pub use error::{Error, advice};
pub use folder::{Folder, Opening};
pub use inventory::{INVENTORY, Inventory, is_figure};
pub use kind::Kind;
pub use mend::mend;
pub use single::StagedFile;
pub use staged::Staged;

/// Version of motiform, as inventories state it.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
