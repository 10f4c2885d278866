//! Outlines -> a file for other programs.

use crate::Result;
use motiform_store::{Kind, StagedFile};
use motiform_tracks::{Error, Format, Tracks, write_amoepy, write_csv};
use std::path::{Path, PathBuf};

/// A file that outlines will be written to. It appears when it is complete.
#[derive(Debug)]
pub struct OutlineFile {
    /// Where the user wants it: errors name this.
    target: PathBuf,
    staged: StagedFile,
    format: Format,
}

impl OutlineFile {
    /// Prepares a file: the long table (columns cell, frame, i, x, y) for a name that ends in `.csv`, AmoePy's text for `.txt`.
    ///
    /// # Errors
    /// Another ending; a file that exists, without `force`; a folder that cannot be written to.
    pub fn new(path: &Path, force: bool) -> Result<Self> {
        let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
        let format = match ending.to_str() {
            Some("csv") => Format::Csv,
            Some("txt") => Format::AmoePy,
            _ => return Err(Error::Ending { file: path.to_owned() }.into()),
        };
        let staged = StagedFile::new(path, Kind::Outlines, force)?;
        Ok(Self { target: path.to_owned(), staged, format })
    }

    /// Writes the outlines with all digits, in the units of the tracks.
    ///
    /// # Errors
    /// For AmoePy's text, several cells, or units other than um and s; the file system.
    pub fn write(self, tracks: &Tracks) -> Result<PathBuf> {
        match (self.format, tracks.cells.as_slice()) {
            (Format::AmoePy, [cell]) => write_amoepy(tracks, cell, &self.staged.path()),
            (Format::AmoePy, cells) => {
                let reason = format!("it holds one cell, and there are {}: choose one", cells.len());
                return Err(Error::Unwritable { format: self.format, reason }.into());
            }
            _ => write_csv(tracks, &self.staged.path()),
        }
        .map_err(|error| match error {
            Error::Io { reason, .. } => motiform_study::Error::write_failed(&self.target, reason).into(),
            other => crate::Error::from(other),
        })?;
        Ok(self.staged.commit()?)
    }
}
