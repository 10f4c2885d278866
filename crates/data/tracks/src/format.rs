//! The formats, by name.

use crate::{Error, Result};
use std::fmt;
use std::str::FromStr;

/// A format of files with outlines. Found from the content; the option `format` chooses where several fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// A CSV table with one vertex per row: columns cell, frame, i, x, y.
    Csv,
    /// The same table as Parquet.
    Parquet,
    /// TrackMate's XML with outlines (`ROI_N_POINTS`).
    TrackMate,
    /// QuimP's `_snake.csv` and `_outline.csv`: tab separated, blocks headed `#frame N`.
    QuimpTable,
    /// QuimP's `.snQP`, with the `.paQP` of the same name in the same folder.
    QuimpNodes,
    /// AmoePy's text: a line for each frame, `t x0 y0 x1 y1 ...`, seconds and micrometres.
    AmoePy,
    /// One ImageJ region of interest.
    Roi,
    /// A zip archive of ImageJ regions of interest.
    RoiZip,
    /// Lines or a CSV column of `POLYGON ((x y, ...))`.
    Wkt,
    /// Label masks: TIFF or PNG images, or a folder of them.
    Masks,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 10] = [
        Self::Csv,
        Self::Parquet,
        Self::TrackMate,
        Self::QuimpTable,
        Self::QuimpNodes,
        Self::AmoePy,
        Self::Roi,
        Self::RoiZip,
        Self::Wkt,
        Self::Masks,
    ];

    /// Its name in options.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Parquet => "parquet",
            Self::TrackMate => "trackmate",
            Self::QuimpTable => "quimp-csv",
            Self::QuimpNodes => "quimp-snqp",
            Self::AmoePy => "amoepy",
            Self::Roi => "roi",
            Self::RoiZip => "roi-zip",
            Self::Wkt => "wkt",
            Self::Masks => "masks",
        }
    }

    /// The names of all formats, for messages.
    #[must_use]
    pub fn list() -> String {
        Self::ALL.map(Self::name).join(", ")
    }

    /// Returns `true` if the y axis of this format points down, as in images. The others do not say.
    #[must_use]
    pub fn is_of_images(self) -> bool {
        matches!(
            self,
            Self::TrackMate | Self::QuimpTable | Self::QuimpNodes | Self::Roi | Self::RoiZip | Self::Masks
        )
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Format {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self> {
        let known = Self::ALL.into_iter().find(|format| format.name() == name);
        known.ok_or_else(|| Error::FormatName { name: name.to_owned() })
    }
}
