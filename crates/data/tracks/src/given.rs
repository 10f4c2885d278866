//! Outlines that a caller has in memory -> tracks.

use crate::after::{filed_twice, implausible, positions, sentinels};
use crate::numbering::{median_difference, numbers};
use crate::read::sound;
use crate::resolve::{Resolved, resolve};
use crate::{Cell, Note, Result, Tracks};
use motiform_dynamics::sample::sort_by_number;
use std::path::Path;

/// The units and the orientation of outlines in memory.
#[derive(Debug, Clone, PartialEq)]
pub struct Given {
    /// Unit of coordinates.
    pub length_unit: String,
    /// Unit of times.
    pub time_unit: String,
    /// `true` if y points down.
    pub y_down: Option<bool>,
}

/// Tracks from outlines in memory, with the notes and checks of files: vertices that are not finite are
/// counted and left out, a repeated last vertex is dropped. Frames are counted from the times, in intervals.
/// No frame of a cell may occur twice.
///
/// # Errors
/// [`NoOutlines`](crate::Error::NoOutlines), where no outline has an area.
pub fn given(mut cells: Vec<Cell>, about: Given) -> Result<Tracks> {
    let mut notes = Vec::new();
    for cell in &mut cells {
        notes.extend(number(cell));
        let mut lost = Vec::new();
        for outline in &mut cell.frames {
            let points = (0..).zip(std::mem::take(&mut outline.points)).collect();
            if let Resolved::One { points, missing, .. } = resolve(points) {
                (outline.points, outline.missing) = (points, missing);
                lost.extend((missing > 0).then_some(outline.frame));
            }
        }
        notes.extend(
            (!lost.is_empty()).then(|| Note::MissingVertices { cell: cell.name.clone(), frames: lost }),
        );
    }
    sound(&cells, Path::new("outlines in memory"))?;
    for cell in &mut cells {
        sentinels(cell, &mut notes);
        notes.extend(implausible(cell, &about.length_unit));
    }
    notes.extend(filed_twice(&cells));
    notes.extend(positions(&cells));
    let Given { length_unit, time_unit, y_down } = about;
    Ok(Tracks { cells, files: Vec::new(), length_unit, time_unit, y_down, image: None, notes })
}

/// Numbers of frames from their times; in order where these are not multiples of one interval.
fn number(cell: &mut Cell) -> Option<Note> {
    sort_by_number(&mut cell.frames, |a| a.t);
    let times: Vec<f64> = cell.frames.iter().map(|outline| outline.t).collect();
    let found = numbers(&times, median_difference(&times));
    let note = found.is_none().then(|| Note::UnevenTimes { cell: cell.name.clone() });
    let found = found.unwrap_or_else(|| (0..).take(times.len()).collect());
    for (outline, frame) in cell.frames.iter_mut().zip(found) {
        outline.frame = frame;
    }
    note
}
