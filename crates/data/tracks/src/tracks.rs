//! Outlines of cells over time.

use crate::Note;
use motiform_store::counted;
use serde::Serialize;

/// The unit of lengths of unknown scale.
pub const PIXEL: &str = "pixel";

/// The unit of times of unknown interval.
pub const FRAME: &str = "frame";

/// Cells with their outlines, in one unit of length and one of time.
///
/// Coordinates are those of the files, multiplied by the scale. In images the y axis points down ([`Tracks::y_down`]): there a
/// motion that looks anticlockwise on the screen is clockwise in coordinates. Nothing is mirrored here.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Tracks {
    /// The cells, in the order of the files.
    pub cells: Vec<Cell>,
    /// The files, as they were named; empty for outlines that were given.
    pub files: Vec<String>,
    /// Unit of coordinates; [`PIXEL`] where the scale is unknown.
    pub length_unit: String,
    /// Unit of times; [`FRAME`] where the interval is unknown.
    pub time_unit: String,
    /// `true` if y points down: known for formats of images, `None` for tables and text.
    pub y_down: Option<bool>,
    /// The images, where a file describes them.
    pub image: Option<Image>,
    /// The notes made while reading.
    pub notes: Vec<Note>,
}

/// Images, in the unit of length.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Image {
    /// Width and height.
    pub size: [f64; 2],
    /// Length of a pixel.
    pub pixel: f64,
}

/// One cell of a recording: its outlines in time.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Cell {
    /// Its name in the file.
    pub name: String,
    /// Its outlines, by increasing frame; no frame twice.
    pub frames: Vec<Outline>,
}

/// One outline: a closed polygon without a repeated last vertex.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Outline {
    /// Number of the frame.
    pub frame: i64,
    /// Time, in the unit of time.
    pub t: f64,
    /// Vertices in their order along the outline, finite.
    pub points: Vec<[f64; 2]>,
    /// Vertices of the file that were not finite and are not in `points`.
    pub missing: usize,
}

impl Tracks {
    /// Number of outlines of all cells.
    pub fn outlines(&self) -> usize {
        self.cells.iter().map(|cell| cell.frames.len()).sum()
    }

    /// Number of cells and outlines, in words: `1 cell, 400 outlines`.
    pub fn size(&self) -> String {
        let what = if self.cells.iter().all(Cell::has_positions_alone) { "position" } else { "outline" };
        format!("{}, {}", counted(self.cells.len(), "cell"), counted(self.outlines(), what))
    }
}

impl Cell {
    /// `true` if each frame has one point: the position of the cell, which has no outline.
    pub fn has_positions_alone(&self) -> bool {
        self.frames.iter().all(|outline| outline.points.len() == 1 && outline.missing == 0)
    }
}
