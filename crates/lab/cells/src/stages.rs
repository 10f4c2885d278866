//! The stages of a long fit, each kept as soon as it is done, so that the fit can be continued.

use crate::Result;
use crate::packed::{read_packed, write_packed};
use motiform_dynamics::{Part, Watch};
use motiform_store::Folder;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// The stages of a fit, by name, with the share of the work that is done when each ends: rough values, for the display of progress.
const STAGES: [(&str, f64); 7] = [
    ("whole", 0.3),
    ("selection", 0.35),
    ("handedness", 0.6),
    ("drift", 0.7),
    ("regime", 0.8),
    ("ladder", 0.81),
    ("senses", 1.0),
];

/// Where the results of stages are kept, if they are.
#[derive(Debug, Default)]
pub(crate) struct Stages<'f> {
    folder: Option<(&'f Folder, &'f str)>,
}

impl<'f> Stages<'f> {
    /// Stages that are kept in a folder inside a result.
    pub(crate) fn kept_in(result: &'f Folder, folder: &'f str) -> Self {
        Self { folder: Some((result, folder)) }
    }

    /// The result of a stage: the one that is kept, or else that of `make`, with the watch on its share of the work.
    ///
    /// # Errors
    /// Those of `make`, and a file that cannot be written.
    pub(crate) fn get<T: Serialize + DeserializeOwned>(
        &self,
        name: &str,
        watch: &dyn Watch,
        make: impl FnOnce(&dyn Watch) -> Result<T>,
    ) -> Result<T> {
        let number = STAGES.iter().position(|stage| stage.0 == name).unwrap_or(0);
        let from = if number == 0 { 0.0 } else { STAGES[number - 1].1 };
        let part = Part { watch, from, to: STAGES[number].1 };
        let file = self.folder.map(|(result, folder)| (result, format!("{folder}{name}.json.gz")));
        if let Some(found) = file.as_ref().and_then(|(result, name)| read_packed(result, name)) {
            part.progress(1.0);
            return Ok(found);
        }
        let made = make(&part)?;
        if let Some((result, name)) = file {
            write_packed(result, &name, &made)?;
        }
        part.progress(1.0);
        Ok(made)
    }
}
