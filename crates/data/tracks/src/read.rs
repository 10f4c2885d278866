//! Files -> tracks.

use crate::after::{filed_twice, implausible, large, positions, sentinels};
use crate::formats::{self, Found};
use crate::scale::{apply, scales};
use crate::{Apart, Cell, Error, Format, Image, Note, Options, Result, Tracks, detect};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Reads files of outlines; several files are one data set.
///
/// The format of each file is found from its content ([`detect()`]); gzip files are unpacked. Coordinates are
/// multiplied by the scale and times by the interval, which come from the file or from the options and are
/// never assumed: where nobody says them, the units are [`PIXEL`](crate::PIXEL) and [`FRAME`](crate::FRAME).
/// Outlines of one cell may lie in several `.roi` files; otherwise a cell whose name occurs in several files
/// is named `file: cell`.
///
/// # Errors
/// Every [`Error`] names the file, the line or entry, and what to do. What can be read but must be known is a [`Note`].
///
/// # Checked by  tests/all/: a file of each format, damaged files, random bytes
pub fn read<P: AsRef<Path>>(paths: &[P], options: &Options) -> Result<Tracks> {
    options.check()?;
    if let Some(file) = twice(paths) {
        return Err(Error::Twice { file: file.to_owned() });
    }
    let mut together: Option<Tracks> = None;
    let mut whence: Vec<Source> = Vec::new();
    for path in paths {
        let path = path.as_ref();
        let (one, format) = file(path, options)?;
        whence.extend(one.cells.iter().map(|_| Source { file: path.to_owned(), format }));
        match &mut together {
            None => together = Some(one),
            Some(all) => add(all, one, path)?,
        }
    }
    let mut tracks = together.ok_or(Error::NoFile)?;
    join(&mut tracks, &whence)?;
    let notes = &mut tracks.notes;
    for cell in &mut tracks.cells {
        sentinels(cell, notes);
        notes.extend(implausible(cell, &tracks.length_unit));
    }
    tracks.notes.extend(large(&tracks.cells, &tracks.length_unit));
    tracks.notes.extend(filed_twice(&tracks.cells));
    tracks.notes.extend(positions(&tracks.cells));
    once(&mut tracks.notes);
    Ok(tracks)
}

/// A path that is given more than once.
fn twice<P: AsRef<Path>>(paths: &[P]) -> Option<&Path> {
    let known = |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let mut seen = BTreeSet::new();
    paths.iter().map(AsRef::as_ref).find(|path| !seen.insert(known(path)))
}

/// The file and the format that a cell was read from.
struct Source {
    file: PathBuf,
    format: Format,
}

fn file(path: &Path, options: &Options) -> Result<(Tracks, Format)> {
    let format = match options.format {
        Some(format) => format,
        None => detect(path, options)?,
    };
    let Found { mut cells, mut notes, scale, image } = formats::read(path, format, options)?;
    sound(&cells, path)?;
    let (uses, more) = scales(&scale, options, path)?;
    apply(&mut cells, &uses);
    notes.extend(more);
    let [length, time] = uses;
    let scaled = |value: f64| value * length.factor;
    let image = image.map(|image| Image { size: image.size.map(scaled), pixel: scaled(image.pixel) });
    let y_down = format.is_of_images().then_some(true);
    let files = vec![path.display().to_string()];
    Ok((
        Tracks { cells, files, length_unit: length.unit, time_unit: time.unit, y_down, image, notes },
        format,
    ))
}

/// At least one outline must have an area, or all are positions.
pub(crate) fn sound(cells: &[Cell], path: &Path) -> Result<()> {
    let most = cells.iter().flat_map(|cell| &cell.frames).map(|outline| outline.points.len()).max();
    let missing: usize = cells.iter().flat_map(|cell| &cell.frames).map(|outline| outline.missing).sum();
    let reason = match most {
        None => "the file holds no vertex".to_owned(),
        Some(0..3) if missing > 0 => {
            format!("{missing} vertices are not finite numbers, and no frame has 3 others")
        }
        Some(1) => return Ok(()), // a table of positions
        Some(0..3) => {
            format!(
                "no frame has more than {} vertices: give 3 and more in each frame, or one, the position of the cell",
                most.unwrap_or(0)
            )
        }
        Some(_) => return Ok(()),
    };
    Err(Error::NoOutlines { file: path.to_owned(), reason })
}

fn add(all: &mut Tracks, one: Tracks, path: &Path) -> Result<()> {
    let differ = |what, found: &str, before: &str| Error::Units {
        file: path.to_owned(),
        what,
        found: found.to_owned(),
        before: before.to_owned(),
    };
    if one.length_unit != all.length_unit {
        return Err(differ("unit of length", &one.length_unit, &all.length_unit));
    }
    if one.time_unit != all.time_unit {
        return Err(differ("unit of time", &one.time_unit, &all.time_unit));
    }
    all.y_down = if all.y_down == one.y_down { all.y_down } else { None };
    all.image = if all.image == one.image { all.image } else { None };
    all.cells.extend(one.cells);
    all.files.extend(one.files);
    all.notes.extend(one.notes);
    Ok(())
}

/// Outlines of one cell from several regions become one cell; other cells of the same name are told apart by their files.
fn join(tracks: &mut Tracks, whence: &[Source]) -> Result<()> {
    let mut places: BTreeMap<String, Vec<usize>> = BTreeMap::new();
    for (at, cell) in tracks.cells.iter().enumerate() {
        places.entry(cell.name.clone()).or_default().push(at);
    }
    let mut gone = vec![false; tracks.cells.len()];
    for same in places.into_values().filter(|same| same.len() > 1) {
        if same.iter().all(|&at| matches!(whence[at].format, Format::Roi | Format::Masks)) {
            let mut frames = Vec::new();
            for &at in &same {
                frames.append(&mut tracks.cells[at].frames);
                gone[at] = at != same[0];
            }
            frames.sort_by_key(|outline| outline.frame);
            if let Some(pair) = frames.windows(2).find(|pair| pair[0].frame == pair[1].frame) {
                return Err(mixed(
                    &tracks.cells[same[0]].name,
                    &whence[same[0]].file,
                    pair[0].frame,
                    frames.len(),
                ));
            }
            tracks.cells[same[0]].frames = frames;
        } else {
            for at in same {
                let stem = formats::stem(&whence[at].file);
                tracks.cells[at].name = format!("{stem}: {}", tracks.cells[at].name);
            }
        }
    }
    let mut gone = gone.into_iter();
    tracks.cells.retain(|_| !gone.next().unwrap_or(false));
    Ok(())
}

/// That units are unknown is said of the first file only: all files have the same units.
fn once(notes: &mut Vec<Note>) {
    let (mut scale, mut interval) = (0, 0);
    notes.retain(|note| {
        let count = match note {
            Note::UnknownScale { .. } => &mut scale,
            Note::UnknownInterval { .. } => &mut interval,
            _ => return true,
        };
        *count += 1;
        *count == 1
    });
}

fn mixed(name: &str, file: &Path, first: i64, frames: usize) -> Error {
    let remedy = Apart::Names("name the files FRAME-CELL.roi, images of labels NAME-FRAME");
    Error::MixedCells { file: file.to_owned(), name: name.to_owned(), conflicts: 1, frames, first, remedy }
}
