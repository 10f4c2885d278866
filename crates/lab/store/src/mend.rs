//! Replacements that a kill interrupted.

use crate::place::{Place, sweep};
use crate::replace::forward;
use crate::{Error, Inventory, lock};
use std::path::Path;

/// Goes on with the replacement of a result that a kill interrupted, if there is one. Readers call it before they read.
///
/// # Errors
/// Files that cannot be renamed.
pub fn mend(folder: &Path) -> Result<(), Error> {
    let is_moving = |folder: &Path| Ok(Inventory::read(folder).ok().flatten().and_then(|found| found.moving));
    if is_moving(folder)?.is_none() {
        return Ok(());
    }
    let Ok(target) = folder.canonicalize() else { return Ok(()) };
    let _lock = match lock::lock(&target, folder) {
        Err(Error::Busy { .. }) => return Ok(()), // a living process goes on itself
        lock => lock?,
    };
    if let Some(number) = is_moving(&target)? {
        let place = Place::left(&target, &number);
        if Inventory::read(&place.result())?.is_none() {
            return Ok(()); // somebody removed the new result: what is here stays
        }
        forward(&place, &target, folder)?;
    }
    sweep(&target);
    Ok(())
}
