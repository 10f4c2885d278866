//! Whether a folder is as it was written.

use crate::survey::{Survey, is_ours};
use crate::{Error, Inventory};
use std::path::Path;

/// A folder compared with its inventory; names as there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Audit {
    /// What it is.
    pub inventory: Inventory,
    /// Files that are as they were written.
    pub unchanged: Vec<String>,
    /// Files that are changed.
    pub changed: Vec<String>,
    /// Files that are not there.
    pub missing: Vec<String>,
    /// What others put there.
    pub foreign: Vec<String>,
}

impl Audit {
    /// Reads every listed file of a folder.
    ///
    /// # Errors
    /// [`Error::NotVerified`] without an inventory, [`Error::Inventory`], [`Error::Unwritable`] for a folder that cannot be read.
    pub fn of(folder: &Path) -> Result<Self, Error> {
        crate::mend(folder)?;
        let inventory =
            Inventory::read(folder)?.ok_or_else(|| Error::NotVerified { path: folder.to_owned() })?;
        let foreign = Survey::names(folder, &inventory).map_err(Error::unwritable(folder))?;
        let (mut unchanged, mut changed, mut missing) = (Vec::new(), Vec::new(), Vec::new());
        for (name, digests) in &inventory.files {
            let path = folder.join(name);
            match path.symlink_metadata() {
                Err(_) => missing.push(name.clone()),
                Ok(_) if is_ours(&path, digests).map_err(Error::unwritable(&path))? => {
                    unchanged.push(name.clone());
                }
                Ok(_) => changed.push(name.clone()),
            }
        }
        Ok(Self { inventory, unchanged, changed, missing, foreign })
    }
}
