//! The part of the stage's motion that is subtracted from the outlines.

use super::FieldOfView;
use motiform_tracks::Tracks;
use serde::Serialize;
use std::str::FromStr;

motiform_dynamics::named! {
    /// A motion of the stage or of the images that can be subtracted.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
    #[serde(rename_all = "kebab-case")]
    pub enum Correction by name {
        /// A velocity that all cells have.
        Drift = "drift",
        /// Jumps from one frame to the next.
        Jumps = "jumps",
        /// Displacements of single frames.
        Jitter = "jitter",
    }
}

impl FromStr for Correction {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        Self::find(name).ok_or_else(|| {
            format!("there is no correction {name:?}: give drift, jumps or jitter, separated by commas")
        })
    }
}

impl FieldOfView {
    /// Takes these motions out of all outlines, as they were found.
    pub(crate) fn correct(&mut self, tracks: &mut Tracks, wanted: &[Correction]) {
        for outline in tracks.cells.iter_mut().flat_map(|cell| &mut cell.frames) {
            let by = self.displacement(outline.frame, outline.t, wanted);
            outline.points.iter_mut().for_each(|point| *point = [0, 1].map(|k| point[k] - by[k]));
        }
        self.corrected = wanted.to_vec();
    }
}
