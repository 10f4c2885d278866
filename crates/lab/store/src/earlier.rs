//! The kind of a folder, also of one that an earlier version wrote: those have no inventory, but can be read.

use crate::{Inventory, Kind, mend};
use std::fs;
use std::path::Path;

/// Files of results of earlier versions, all of which are in their folder.
const EARLIER: [(&[&str], Kind); 8] = [
    (&["_manifest.json"], Kind::Scan),
    (&["manifest.json", "branches.json"], Kind::Branches),
    (&["manifest.json", "curves.json"], Kind::Curves),
    (&["manifest.json"], Kind::Dataset),
    (&["_fit.json"], Kind::Fits),
    (&["summary.json", "modes.parquet"], Kind::Observations),
    (&["statistics.json"], Kind::Statistics),
    (&["lifetimes.json"], Kind::Lifetimes),
];

/// The kind of a folder, for readers: by its inventory, or else by its files. An interrupted replacement is finished before.
#[must_use]
pub fn kind_of(folder: &Path) -> Option<Kind> {
    let _ = mend(folder); // reading says what is wrong
    if let Ok(Some(inventory)) = Inventory::read(folder) {
        return Kind::of_name(&inventory.kind);
    }
    let has = |name: &&str| fs::metadata(folder.join(name)).is_ok_and(|there| there.is_file());
    EARLIER.into_iter().find(|(names, _)| names.iter().all(has)).map(|(_, kind)| kind)
}
