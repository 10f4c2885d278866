//! The comparison of a folder with its inventory.

use crate::survey::Survey;
use crate::{Error, Inventory};
use std::path::Path;

/// A folder compared with its inventory; names as there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Audit {
    /// Its inventory.
    pub inventory: Inventory,
    /// Files that are as they were written.
    pub unchanged: Vec<String>,
    /// Files that are changed.
    pub changed: Vec<String>,
    /// Files that are not there.
    pub missing: Vec<String>,
    /// Files that others put there.
    pub foreign: Vec<String>,
}

impl Audit {
    /// Reads every listed file of a folder.
    ///
    /// # Errors
    /// [`Error::NoFolder`] where there is none, [`Error::NotVerified`] without an inventory, [`Error::Inventory`],
    /// [`Error::Unwritable`] for a folder that cannot be read.
    pub fn of(folder: &Path) -> Result<Self, Error> {
        if !folder.exists() {
            return Err(Error::NoFolder { path: folder.to_owned() });
        }
        crate::mend(folder)?;
        let inventory =
            Inventory::read(folder)?.ok_or_else(|| Error::NotVerified { path: folder.to_owned() })?;
        let survey = Survey::of(folder, &inventory).map_err(Error::unwritable(folder))?;
        let foreign = survey.outside_results(folder);
        let (there, missing): (Vec<String>, Vec<String>) =
            inventory.files.keys().cloned().partition(|name| folder.join(name).symlink_metadata().is_ok());
        let differs = |name: &String| survey.changed.contains(name) || survey.edited.contains(name);
        let (changed, unchanged) = there.into_iter().partition(differs);
        Ok(Self { inventory, unchanged, changed, missing, foreign })
    }
}
