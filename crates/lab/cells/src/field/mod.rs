//! The field of view as an instrument: what the stage and the camera add to all cells, found in all of them together.
//!
//! Jumps of the stage are found first and left out of what follows, then a jitter of whole frames, then a drift. What is found can be
//! subtracted from the outlines ([`Correction`]). All cells that are read together are taken as one field of view. Definitions:
//! docs/cells.md, section 'The field of view'.

mod correction;
mod drift;
mod flow;
mod grid;
mod jitter;
mod jumps;
mod magnification;
mod pixels;
mod words;

pub use correction::Correction;
pub use drift::CommonDrift;
pub use flow::Flow;
pub use jitter::Jitter;
pub use jumps::StageJump;
pub use magnification::Magnification;

use grid::Grid;
use motiform_tracks::modes::CellModes;
use motiform_tracks::{Note, Tracks};
use serde::Serialize;
use std::borrow::Cow;

/// The cells without those that are another one again in most of their frames: their motion is no motion in common.
fn once<'c>(tracks: &Tracks, cells: &'c [CellModes]) -> Cow<'c, [CellModes]> {
    let again = |cell: &CellModes| {
        let same = |note: &Note| match note {
            Note::SameCell { second, frames, .. } => *second == cell.name && 2 * frames > cell.frames.len(),
            _ => false,
        };
        tracks.notes.iter().any(same)
    };
    let kept = || cells.iter().filter(|cell| !again(cell));
    if kept().count() == cells.len() { Cow::Borrowed(cells) } else { kept().cloned().collect() }
}

/// Motion that the cells of a field of view have in common.
///
/// # Units   of the data
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct FieldOfView {
    /// Cells whose place is seen in two frames and more.
    pub cells: usize,
    /// Jumps of the stage.
    pub jumps: Vec<StageJump>,
    /// Displacements of whole frames; `None` with fewer than three cells in the same frames.
    pub jitter: Option<Jitter>,
    /// A velocity that all cells have; `None` with fewer than three cells.
    pub drift: Option<CommonDrift>,
    /// The change of the velocity with the place; `None` with fewer than six cells in the first frame.
    pub flow: Option<Flow>,
    /// A change of the magnification; `None` where none is seen, as with fewer than three cells.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub magnification: Option<Magnification>,
    /// Side of the pixels whose edges or middles the outlines follow; `None` for smooth outlines.
    pub pixel: Option<f64>,
    /// The motion that was subtracted from the outlines. The numbers above are those before.
    pub corrected: Vec<Correction>,
}

impl FieldOfView {
    /// Their common motion.
    ///
    /// # Checked by  tests/all/field.rs: walkers and rods on a stage of known drift, jumps, jitter and pixels, and without
    pub fn of(tracks: &Tracks, cells: &[CellModes]) -> Self {
        // of masks whose size is known outlines lie on edges and middles of pixels
        let pixel = pixels::pitch(tracks).map(|pitch| tracks.image.map_or(pitch, |image| image.pixel));
        let cells = &once(tracks, cells)[..];
        let Some(mut grid) = Grid::of(cells) else { return Self { pixel, ..Self::default() } };
        let mut jumps = jumps::find(&grid, cells);
        grid.subtract_jumps(&jumps);
        let (jitter, drift, flow) = (Jitter::of(&grid), CommonDrift::of(&grid), Flow::of(&grid));
        let magnification = magnification::find(&grid, cells);
        if let Some(jitter) = jitter.as_ref().filter(|jitter| jitter.is_seen()) {
            jumps.iter_mut().for_each(|jump| jump.add_jitter(jitter.deviation));
        }
        let cells = grid.cells();
        Self { cells, jumps, jitter, drift, flow, magnification, pixel, corrected: Vec::new() }
    }

    /// The common velocity, if it is seen and was not subtracted.
    pub fn uncorrected_drift(&self) -> Option<[f64; 2]> {
        let seen = self.drift.filter(CommonDrift::is_seen);
        seen.filter(|_| !self.is_corrected(Correction::Drift)).map(|drift| drift.velocity)
    }

    /// `true` if velocities differ from place to place.
    pub fn flows(&self) -> bool {
        self.flow.as_ref().is_some_and(Flow::is_seen)
    }

    /// `true` if this was subtracted from the outlines.
    pub fn is_corrected(&self, what: Correction) -> bool {
        self.corrected.contains(&what)
    }

    /// Displacement of the stage in a frame, of what is to be corrected.
    fn displacement(&self, frame: i64, t: f64, wanted: &[Correction]) -> [f64; 2] {
        let mut sum = [0.0; 2];
        let mut add = |by: [f64; 2]| sum = [0, 1].map(|k| sum[k] + by[k]);
        for one in wanted {
            match one {
                Correction::Jumps => {
                    self.jumps
                        .iter()
                        .filter(|jump| jump.frame <= frame)
                        .for_each(|jump| add(jump.displacement));
                }
                Correction::Jitter => {
                    add(self.jitter.as_ref().map_or([0.0; 2], |jitter| jitter.displacement(frame)));
                }
                Correction::Drift => {
                    if let Some(drift) = self.drift.filter(CommonDrift::is_seen) {
                        add(drift.velocity.map(|v| v * (t - drift.since)));
                    }
                }
            }
        }
        sum
    }
}
