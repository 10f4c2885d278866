//! Folders of label masks.

use crate::input::{io, shorten};
use crate::{Error, Note, Place, Result};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Ends of the names of images.
const IMAGES: [&str; 3] = ["tif", "tiff", "png"];
/// Tables of tracks of the Cell Tracking Challenge.
const TABLES: [&str; 2] = ["res_track.txt", "man_track.txt"];

/// The images of a folder with their frames: the last numbers of their names where all have different ones, else their order.
pub(super) fn images(folder: &Path) -> Result<Vec<(Option<i64>, PathBuf)>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).map_err(io(folder))? {
        let path = entry.map_err(io(folder))?.path();
        let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
        if IMAGES.iter().any(|known| ending == *known) {
            found.push((number(&path), path));
        }
    }
    if found.is_empty() {
        let reason =
            "the folder has no image: the names of label masks end in .tif, .tiff or .png".to_owned();
        return Err(Error::NoOutlines { file: folder.to_owned(), reason });
    }
    let numbers: BTreeSet<i64> = found.iter().filter_map(|one| one.0).collect();
    if numbers.len() < found.len() {
        found.iter_mut().for_each(|one| one.0 = None);
    }
    found.sort_unstable();
    Ok(found)
}

/// The last number of a name.
pub(super) fn number(path: &Path) -> Option<i64> {
    let stem = path.file_stem()?.to_string_lossy().into_owned();
    stem.split(|c: char| !c.is_ascii_digit()).rfind(|digits| !digits.is_empty())?.parse().ok()
}

/// The divisions of cells according to the table of tracks.
pub(super) fn divisions(folder: &Path) -> Result<Vec<Note>> {
    let Some(table) = TABLES.map(|name| folder.join(name)).into_iter().find(|path| path.exists()) else {
        return Ok(Vec::new());
    };
    let place = Place::file(&table);
    let bytes = fs::read(&table).map_err(io(&table))?;
    let text = crate::input::text(&bytes);
    let mut daughters: BTreeMap<i64, Vec<i64>> = BTreeMap::new();
    for (number, line) in (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty()) {
        let words: Option<Vec<i64>> = line.split_whitespace().map(|word| word.parse().ok()).collect();
        let Some(&[label, _, _, parent]) = words.as_deref() else {
            let found = format!("{:?}", shorten(line));
            return Err(Error::structure(&place.line(number), found, "label, begin, end and parent"));
        };
        if parent != 0 {
            daughters.entry(parent).or_default().push(label);
        }
    }
    let note = |(parent, labels): (i64, Vec<i64>)| Note::Becomes {
        cell: parent.to_string(),
        into: labels.iter().map(ToString::to_string).collect(),
    };
    Ok(daughters.into_iter().map(note).collect())
}
