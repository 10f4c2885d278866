//! Cells as further steps use them: the frames that count, with their errors, and what was left out.

use crate::{Correction, FieldOfView, Result, Units};
use motiform_inference::{LEAST_FRAMES, MOST_MODES, Observation, Track};
use motiform_tracks::modes::{CellModes, Flag, FrameModes, ModeOptions, modes};
use motiform_tracks::{Options, Tracks, read};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// The file or folder that was read.
#[derive(Debug)]
pub struct Sample {
    /// The outlines, with units and notes.
    pub tracks: Tracks,
    /// Their modes, cell by cell.
    pub cells: Vec<CellTrack>,
    /// Motion that they share: drift, jumps and jitter of the stage.
    pub field: FieldOfView,
}

/// One cell with the modes of its outlines, and the frames of them that count.
#[derive(Debug)]
pub struct CellTrack {
    /// Its name in the file.
    pub name: String,
    /// All frames, with their flags.
    pub modes: CellModes,
    /// The frames that count: centre, z2, z3, z4 and their covariance. Models of three modes are fitted to the first three of these alone.
    pub track: Track,
    /// Frames of the track, by their place in it, at which a piece begins: the stage jumps there, and no displacement counts.
    pub breaks: Vec<usize>,
    /// `true` if the jumps were subtracted from the outlines: then the path goes on across them.
    pub bridged: bool,
    /// The velocity with which all cells drift together, if that is seen and was not subtracted.
    pub drift: Option<[f64; 2]>,
    /// `true` if velocities differ from place to place in its field of view.
    pub flows: bool,
    /// Mean radius R0 over these frames; 0 without any.
    pub radius: f64,
    /// Units of its lengths and times.
    pub units: Units,
}

impl Sample {
    /// Reads files and computes modes.
    ///
    /// # Errors
    /// Files that cannot be read: which, where, and what to do.
    pub fn read(paths: &[PathBuf], options: &Options, modes_options: &ModeOptions) -> Result<Self> {
        Ok(Self::of_tracks(read(paths, options)?, modes_options))
    }

    /// Computes the modes of outlines that were read or given.
    pub fn of_tracks(tracks: Tracks, modes_options: &ModeOptions) -> Self {
        let modes = modes(&tracks, modes_options);
        let field = FieldOfView::of(&tracks, &modes);
        Self { cells: with_field(modes, &field, &Units::of_tracks(&tracks)), tracks, field }
    }

    /// The same cells without these motions of the stage, as they were found in all cells together.
    #[must_use]
    pub fn corrected(mut self, wanted: &[Correction], modes_options: &ModeOptions) -> Self {
        if !wanted.is_empty() {
            self.field.correct(&mut self.tracks, wanted);
            let units = Units::of_tracks(&self.tracks);
            self.cells = with_field(modes(&self.tracks, modes_options), &self.field, &units);
        }
        self
    }

    /// Mean radius of a cell, or of all cells where none has this name (fits of several cells together).
    pub fn radius(&self, cell: &str) -> f64 {
        let of = |own: &dyn Fn(&&CellTrack) -> bool| {
            let radii: Vec<f64> = self.cells.iter().filter(own).map(|cell| cell.radius).collect();
            (!radii.is_empty()).then(|| radii.iter().sum::<f64>() / radii.len() as f64)
        };
        of(&|one| one.name == cell).or_else(|| of(&|one| one.radius > 0.0)).unwrap_or(0.0)
    }

    /// These cells alone, with the notes that are about them or about the files. Borders of images were found with all cells.
    #[must_use]
    pub fn only(mut self, names: &[String]) -> Self {
        let chosen = |name: &str| names.iter().any(|one| one == name);
        self.tracks.cells.retain(|cell| chosen(&cell.name));
        self.cells.retain(|cell| chosen(&cell.name));
        self.tracks.notes.retain(|note| {
            let about = note.cells();
            about.is_empty() || about.into_iter().any(chosen)
        });
        self
    }

    /// Notes about the files, as sentences.
    pub fn notes(&self) -> Vec<String> {
        self.tracks.notes.iter().map(ToString::to_string).collect()
    }
}

impl CellTrack {
    /// Returns `true` for a track of positions, which has no outlines.
    pub(crate) fn has_no_outlines(&self) -> bool {
        self.modes.frames.iter().any(|frame| frame.flags.contains(&Flag::PositionAlone))
    }

    /// The frames of a cell that count. The noise of a vertex is pooled over the cell: that of a frame is uncertain by itself.
    fn new(modes: CellModes, field: &FieldOfView, units: &Units) -> Self {
        let (mut frames, mut breaks, mut parted) = (Vec::new(), Vec::new(), false);
        let mut sum = 0.0;
        let jumps = |frame: &FrameModes| field.jumps.iter().any(|jump| jump.frame == frame.frame);
        for frame in &modes.frames {
            parted |= frame.flags.iter().any(Flag::parts) || jumps(frame);
            if !frame.counts() {
                continue;
            }
            if std::mem::take(&mut parted) && !frames.is_empty() {
                breaks.push(frames.len());
            }
            let Some(fit) = &frame.radius else { continue };
            let mut covariance = fit.observed_covariance(modes.sigma.unwrap_or(fit.sigma), MOST_MODES);
            covariance.iter_mut().flatten().for_each(|x| *x *= fit.inflation.max(1.0));
            let shape = fit.z.iter().take(MOST_MODES - 1).flatten();
            let y = fit.centre.iter().chain(shape).copied().collect();
            frames.push(Observation { t: frame.t, y, covariance });
            sum += fit.r0;
        }
        let radius = if frames.is_empty() { 0.0 } else { sum / frames.len() as f64 };
        let bridged = field.is_corrected(Correction::Jumps);
        Self {
            name: modes.name.clone(),
            modes,
            track: Track(frames),
            breaks,
            bridged,
            drift: field.uncorrected_drift(),
            flows: field.flows(),
            radius,
            units: units.clone(),
        }
    }

    /// The pieces of the track between jumps of the stage that are long enough for a fit.
    pub fn pieces(&self) -> Vec<Track> {
        let ends = self.breaks.iter().copied().chain([self.track.0.len()]);
        let starts = std::iter::once(0).chain(self.breaks.iter().copied());
        let pieces = starts.zip(ends).map(|(from, to)| Track(self.track.0[from..to].to_vec()));
        pieces.filter(|piece| piece.0.len() >= LEAST_FRAMES).collect()
    }

    /// The path as it would be without a velocity that is not the cell's own.
    pub(crate) fn path_without(&self, velocity: [f64; 2]) -> Track {
        let mut path = self.path();
        let since = path.0.first().map_or(0.0, |first| first.t);
        for frame in &mut path.0 {
            (0..2).for_each(|k| frame.y[k] -= velocity[k] * (frame.t - since));
        }
        path
    }

    /// The track where its jumps were subtracted, or else its longest piece: where displacements count.
    pub fn path(&self) -> Track {
        if self.bridged || self.breaks.is_empty() {
            return self.track.clone();
        }
        self.pieces().into_iter().max_by_key(|piece| piece.0.len()).unwrap_or(Track(Vec::new()))
    }

    /// Number of frames with each flag, by its name.
    pub fn flags(&self) -> BTreeMap<&'static str, usize> {
        let mut counts = BTreeMap::new();
        for flag in self.modes.frames.iter().flat_map(|frame| &frame.flags) {
            *counts.entry(flag.name()).or_insert(0) += 1;
        }
        counts
    }

    /// Number of frames that count.
    pub fn frames(&self) -> usize {
        self.track.0.len()
    }

    /// Frames without modes of the radius, or left out, by number.
    pub fn left_out(&self) -> Vec<i64> {
        let used: Vec<i64> = self.modes.used().map(|frame| frame.frame).collect();
        self.modes.frames.iter().map(|frame| frame.frame).filter(|frame| !used.contains(frame)).collect()
    }
}

/// Cells with what their field of view says: frames at which the stage jumps have its flag, whatever the cell shows by itself.
fn with_field(mut all: Vec<CellModes>, field: &FieldOfView, units: &Units) -> Vec<CellTrack> {
    if !field.is_corrected(Correction::Jumps) {
        for jump in &field.jumps {
            let frames = all.iter_mut().flat_map(|cell| &mut cell.frames);
            for frame in frames.filter(|frame| frame.frame == jump.frame) {
                frame
                    .flags
                    .retain(|flag| !matches!(flag, Flag::PositionStep { .. } | Flag::StageJump { .. }));
                let [x, y] = jump.displacement;
                frame.flags.push(Flag::StageJump { distance: (x * x + y * y).sqrt() });
            }
        }
    }
    all.into_iter().map(|modes| CellTrack::new(modes, field, units)).collect()
}
