//! The modes of all frames of all cells.

use super::border::Borders;
use super::breaks::{displacements, mixed, reason};
use super::flag::Flag;
use super::frame::{FrameModes, ModeOptions, outline_modes};
use super::quality::{gaps, jumps, repeated};
use crate::{Cell, Tracks};
use serde::Serialize;

/// Shape of one cell over time.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CellModes {
    /// Name of the cell.
    pub name: String,
    /// All its frames, those that are left out too.
    pub frames: Vec<FrameModes>,
    /// Root mean square of sigma over the frames that count: the noise of a vertex, pooled. `None` where no frame counts.
    pub sigma: Option<f64>,
}

impl CellModes {
    /// Frames that are no observations of the shape, with the reasons.
    pub fn left_out(&self) -> impl Iterator<Item = &FrameModes> {
        self.frames.iter().filter(|frame| frame.is_left_out())
    }

    /// The reason why the record is not that of one cell in one unit: two cells under one name, or a unit
    /// that changes. `None` for a sound record.
    pub fn inconsistent(&self) -> Option<String> {
        reason(&self.frames)
    }

    /// The reason why displacements from frame to frame are not those of one cell: nothing about its path follows from this record.
    pub fn mixed(&self) -> Option<String> {
        mixed(&self.frames)
    }

    /// Frames with modes of the radius that count.
    pub fn used(&self) -> impl Iterator<Item = &FrameModes> {
        self.frames.iter().filter(|frame| frame.counts())
    }
}

/// Modes and quality of every frame. Frames are never dropped: each says by its flags what is wrong, and whether it is left out.
pub fn modes(tracks: &Tracks, options: &ModeOptions) -> Vec<CellModes> {
    let borders = Borders::find(tracks);
    tracks.cells.iter().map(|cell| cell_modes(cell, &borders, options)).collect()
}

fn cell_modes(cell: &Cell, borders: &Borders, options: &ModeOptions) -> CellModes {
    let mut frames: Vec<FrameModes> = Vec::with_capacity(cell.frames.len());
    let positions = cell.has_positions_alone();
    for outline in &cell.frames {
        let mut modes = outline_modes(&outline.points, options);
        (modes.frame, modes.t) = (outline.frame, outline.t);
        if outline.missing > 0 {
            let of = outline.points.len() + outline.missing;
            modes.flags.push(Flag::MissingVertices { count: outline.missing, of });
        }
        match positions {
            true => modes.flags = vec![Flag::PositionAlone],
            false => modes.flags.extend(borders.flags(&outline.points)),
        }
        frames.push(modes);
    }
    if !positions {
        repeated(cell, &mut frames);
    }
    gaps(&mut frames);
    jumps(&mut frames, options.jump);
    displacements(&mut frames);
    let mut modes = CellModes { name: cell.name.clone(), frames, sigma: None };
    let squares: Vec<f64> =
        modes.used().filter_map(|frame| frame.radius.as_ref()).map(|fit| fit.sigma * fit.sigma).collect();
    if !squares.is_empty() {
        modes.sigma = Some((squares.iter().sum::<f64>() / squares.len() as f64).sqrt());
    }
    modes
}
