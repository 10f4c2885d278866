//! The formats, by name.

use crate::{Error, Result};
use std::str::FromStr;

motiform_dynamics::named! {
    /// A format of files with outlines. Found from the content; the option `format` chooses where several fit.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[non_exhaustive]
    pub enum Format by name {
        /// A CSV table with one vertex per row: columns cell, frame, i, x, y.
        Csv = "csv",
        /// The same table as Parquet.
        Parquet = "parquet",
        /// TrackMate's XML with outlines (`ROI_N_POINTS`).
        TrackMate = "trackmate",
        /// QuimP's `_snake.csv` and `_outline.csv`: tab separated, blocks headed `#frame N`.
        QuimpTable = "quimp-csv",
        /// QuimP's `.snQP`, with the `.paQP` of the same name in the same folder.
        QuimpNodes = "quimp-snqp",
        /// AmoePy's text: a line for each frame, `t x0 y0 x1 y1 ...`, seconds and micrometres.
        AmoePy = "amoepy",
        /// One ImageJ region of interest.
        Roi = "roi",
        /// A zip archive of ImageJ regions of interest.
        RoiZip = "roi-zip",
        /// Lines or a CSV column of `POLYGON ((x y, ...))`.
        Wkt = "wkt",
        /// Label masks: TIFF or PNG images, or a folder of them.
        Masks = "masks",
    }
}

impl Format {
    /// The names of all formats, for messages.
    pub fn list() -> String {
        Self::ALL.map(Self::name).join(", ")
    }

    /// Returns `true` if the y axis of this format points down, as in images. The others do not say.
    pub fn is_of_images(self) -> bool {
        matches!(
            self,
            Self::TrackMate | Self::QuimpTable | Self::QuimpNodes | Self::Roi | Self::RoiZip | Self::Masks
        )
    }
}

impl FromStr for Format {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self> {
        Self::find(name).ok_or_else(|| Error::FormatName { name: name.to_owned() })
    }
}
