//! The contents of a folder, compared with its inventory.

use crate::place::name_of;
use crate::{INVENTORY, Inventory, error, is_figure, sha256_file};
use std::fs;
use std::io::Result;
use std::path::Path;

/// The contents of a folder, sorted; names as in its inventory, those of folders with `/` at their end.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Survey {
    /// Listed data that are changed.
    pub(crate) changed: Vec<String>,
    /// Listed figures that are changed.
    pub(crate) edited: Vec<String>,
    /// Everything that is not listed.
    pub(crate) foreign: Vec<String>,
}

impl Survey {
    /// Reads a folder. Every listed file is read.
    pub(crate) fn of(folder: &Path, inventory: &Inventory) -> Result<Self> {
        let mut survey = Self::default();
        survey.walk(folder, "", inventory, &|name, digests| is_ours(&folder.join(name), digests))?;
        for names in [&mut survey.changed, &mut survey.edited, &mut survey.foreign] {
            names.sort_unstable();
        }
        Ok(survey)
    }

    /// The names that are not listed, without reading files. Results inside a result have their own
    /// inventory.
    pub(crate) fn names(folder: &Path, inventory: &Inventory) -> Result<Vec<String>> {
        let mut survey = Self::default();
        survey.walk(folder, "", inventory, &|_, _| Ok(true))?;
        survey.foreign.sort_unstable();
        Ok(survey.outside_results(folder))
    }

    /// The names that are not listed here, nor in the inventory of a result inside this one.
    pub(crate) fn outside_results(&self, folder: &Path) -> Vec<String> {
        let is_result = |name: &str| name.ends_with('/') && folder.join(name).join(INVENTORY).is_file();
        self.foreign.iter().filter(|name| !is_result(name)).cloned().collect()
    }

    fn walk(
        &mut self,
        folder: &Path,
        prefix: &str,
        inventory: &Inventory,
        is_unchanged: &dyn Fn(&str, &[String]) -> Result<bool>,
    ) -> Result<()> {
        for entry in fs::read_dir(folder.join(prefix))?.collect::<Result<Vec<_>>>()? {
            let Ok(name) = entry.file_name().into_string() else {
                self.foreign.push(format!("{prefix}{}", entry.file_name().to_string_lossy()));
                continue;
            };
            let name = format!("{prefix}{name}");
            let kind = entry.file_type()?;
            if let Some(digests) = inventory.files.get(&name) {
                if !is_unchanged(&name, digests)? {
                    if is_figure(&name) { self.edited.push(name) } else { self.changed.push(name) }
                }
            } else if kind.is_dir() {
                let inside = format!("{name}/");
                if inventory.files.keys().any(|listed| listed.starts_with(&inside)) {
                    self.walk(folder, &inside, inventory, is_unchanged)?;
                } else {
                    self.foreign.push(inside);
                }
            } else if name != INVENTORY && !is_partial(&name, inventory) {
                self.foreign.push(name);
            }
        }
        Ok(())
    }
}

/// Returns `true` if a file is there as it was listed. One that cannot be read is not.
///
/// # Errors
/// The process may open no more files, or has no memory: then nothing is known of the file.
pub(crate) fn is_ours(path: &Path, digests: &[String]) -> Result<bool> {
    if !path.symlink_metadata().is_ok_and(|there| there.is_file()) {
        return Ok(false);
    }
    match sha256_file(path) {
        Ok(found) => Ok(digests.contains(&found)),
        Err(error) if error::is_shortage(&error) => Err(error),
        Err(_) => Ok(false),
    }
}

/// Returns `true` if it is an incomplete file of this folder.
pub(crate) fn is_partial(name: &str, inventory: &Inventory) -> bool {
    let name = name.rsplit('/').next().unwrap_or(name);
    inventory.partials.iter().any(|start| {
        let number = name.strip_prefix(start.as_str()).and_then(|rest| rest.strip_suffix(".partial"));
        number.is_some_and(|number| number.bytes().all(|digit| digit.is_ascii_digit()))
    })
}

/// A sentence about what stays in a folder.
pub(crate) fn kept(folder: &Path, foreign: &[String]) -> Option<String> {
    const MOST: usize = 8;
    let (first, rest) = foreign.split_at(foreign.len().min(MOST));
    let more = if rest.is_empty() { String::new() } else { format!(" and {} more", rest.len()) };
    (!first.is_empty()).then(|| {
        format!("kept in {}: {}{more}, which motiform did not write", folder.display(), first.join(", "))
    })
}

/// Removes incomplete files of killed runs, which the inventory announces.
pub(crate) fn remove_partials(folder: &Path, inventory: &Inventory) -> Result<()> {
    for entry in fs::read_dir(folder)?.collect::<Result<Vec<_>>>()? {
        if is_partial(&name_of(&entry.path()), inventory) && entry.file_type()?.is_file() {
            fs::remove_file(entry.path())?;
        }
    }
    Ok(())
}
