//! The finished items of a long piece of work, kept for a run that continues it.

use crate::Error;
use crate::Folder;

/// The folder of unfinished work, within that of its result.
pub const WORK: &str = "_work/";

/// Keeps finished items by their names.
pub trait Journal: Sync {
    /// An item of an earlier run; `None` where there is none, or it was changed.
    fn finished(&self, item: &str) -> Option<Vec<u8>>;

    /// Keeps an item.
    ///
    /// # Errors
    /// It cannot be written.
    fn finish(&self, item: &str, content: &[u8]) -> Result<(), Error>;
}

/// Nothing is kept.
impl Journal for () {
    fn finished(&self, _item: &str) -> Option<Vec<u8>> {
        None
    }

    fn finish(&self, _item: &str, _content: &[u8]) -> Result<(), Error> {
        Ok(())
    }
}

/// Items are files below the result until [`end_of_work`].
impl Journal for Folder {
    fn finished(&self, item: &str) -> Option<Vec<u8>> {
        self.read(&format!("{WORK}{item}"))
    }

    fn finish(&self, item: &str, content: &[u8]) -> Result<(), Error> {
        self.put(&format!("{WORK}{item}"), content)
    }
}

/// Removes what was kept: the result has everything.
pub fn end_of_work(folder: &Folder) {
    folder.discard(WORK);
}
