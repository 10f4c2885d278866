//! The settings of the reader that a caller may give.

use crate::{Error, Format, Result};

/// The settings of the reader. The default finds everything in the files and assumes no scale.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Options {
    /// The format, where the content does not decide it.
    pub format: Option<Format>,
    /// Length of a pixel, in `length_unit`.
    pub pixel_size: Option<f64>,
    /// Time between frames, in `time_unit`.
    pub interval: Option<f64>,
    /// Unit of `pixel_size`, or of lengths that the file states without a unit; um where a pixel size is given without one.
    pub length_unit: Option<String>,
    /// Unit of `interval`, or of times that the file states without a unit; s where an interval is given without one.
    pub time_unit: Option<String>,
    /// Names of columns, where they differ from the usual ones.
    pub columns: Columns,
    /// Bounds of memory.
    pub limits: Limits,
}

/// Names of the columns of a table. Where one is `None`, the usual names are looked for.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Columns {
    /// Name of the cell.
    pub cell: Option<String>,
    /// Number of the frame.
    pub frame: Option<String>,
    /// Place of the vertex along the outline.
    pub i: Option<String>,
    /// First coordinate.
    pub x: Option<String>,
    /// Second coordinate.
    pub y: Option<String>,
    /// Outline as text `POLYGON (...)`.
    pub wkt: Option<String>,
}

impl Columns {
    /// Those with these names (cell, frame, i, x, y, wkt) and headers; other names are left out.
    pub fn named(columns: &[(String, String)]) -> Self {
        let of =
            |name: &str| columns.iter().rev().find(|(own, _)| own == name).map(|(_, header)| header.clone());
        Self { cell: of("cell"), frame: of("frame"), i: of("i"), x: of("x"), y: of("y"), wkt: of("wkt") }
    }
}

/// Bounds of what is read at once. Beyond them reading ends with an error that names the bound.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Vertices of all outlines: 24 bytes each while reading.
    pub vertices: u64,
    /// Outlines of all cells.
    pub outlines: u64,
    /// Bytes of one line, one element of XML, or one entry of an archive.
    pub piece: u64,
    /// Bytes of a file after decompression.
    pub file: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { vertices: 50_000_000, outlines: 2_000_000, piece: 16 << 20, file: 16 << 30 }
    }
}

impl Options {
    /// Checks that scale and interval can be used.
    ///
    /// # Errors
    /// [`Error::Setting`] if one is not finite and above 0.
    pub fn check(&self) -> Result<()> {
        for (key, value) in [("pixel_size", self.pixel_size), ("interval", self.interval)] {
            if let Some(value) = value
                && !(value.is_finite() && value > 0.0)
            {
                return Err(Error::Setting { key, value, remedy: "give a finite number above 0" });
            }
        }
        Ok(())
    }
}
