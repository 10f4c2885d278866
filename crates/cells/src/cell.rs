//! Cells as further steps use them: the frames that count, with their errors, and what was left out.

use crate::Result;
use motiform_inference::{MOST_MODES, Observation, Track};
use motiform_tracks::modes::{CellModes, ModeOptions, modes};
use motiform_tracks::{Options, Tracks, read};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// What was read.
#[derive(Debug)]
pub struct Sample {
    /// The outlines, with units and notes.
    pub tracks: Tracks,
    /// Their modes, cell by cell.
    pub cells: Vec<CellTrack>,
}

/// One cell.
#[derive(Debug)]
pub struct CellTrack {
    /// Its name in the file.
    pub name: String,
    /// All frames, with their flags.
    pub modes: CellModes,
    /// The frames that count: centre, z2, z3, z4 and their covariance. Models of three modes are fitted to the first three of these alone.
    pub track: Track,
    /// Mean radius R0 over these frames; 0 without any.
    pub radius: f64,
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
    #[must_use]
    pub fn of_tracks(tracks: Tracks, modes_options: &ModeOptions) -> Self {
        let cells = modes(&tracks, modes_options).into_iter().map(CellTrack::new).collect();
        Self { tracks, cells }
    }

    /// Mean radius of a cell, or of all cells where none has this name (fits of several cells together).
    #[must_use]
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
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        self.tracks.notes.iter().map(ToString::to_string).collect()
    }
}

impl CellTrack {
    /// The frames of a cell that count. The noise of a vertex is pooled over the cell: that of a frame is uncertain by itself.
    #[must_use]
    pub fn new(modes: CellModes) -> Self {
        let mut frames = Vec::new();
        let mut sum = 0.0;
        for frame in modes.used() {
            let Some(fit) = &frame.radius else { continue };
            let mut covariance = fit.observed_covariance(modes.sigma.unwrap_or(fit.sigma), MOST_MODES);
            covariance.iter_mut().flatten().for_each(|x| *x *= fit.inflation.max(1.0));
            let shape = fit.z.iter().take(MOST_MODES - 1).flatten();
            let y = fit.centre.iter().chain(shape).copied().collect();
            frames.push(Observation { t: frame.t, y, covariance });
            sum += fit.r0;
        }
        let radius = if frames.is_empty() { 0.0 } else { sum / frames.len() as f64 };
        Self { name: modes.name.clone(), modes, track: Track(frames), radius }
    }

    /// How many frames have each flag, by its name.
    #[must_use]
    pub fn flags(&self) -> BTreeMap<&'static str, usize> {
        let mut counts = BTreeMap::new();
        for flag in self.modes.frames.iter().flat_map(|frame| &frame.flags) {
            *counts.entry(flag.name()).or_insert(0) += 1;
        }
        counts
    }

    /// Number of frames that count.
    #[must_use]
    pub fn frames(&self) -> usize {
        self.track.0.len()
    }

    /// Frames without modes of the radius, or left out, by number.
    #[must_use]
    pub fn left_out(&self) -> Vec<i64> {
        let used: Vec<i64> = self.modes.used().map(|frame| frame.frame).collect();
        self.modes.frames.iter().map(|frame| frame.frame).filter(|frame| !used.contains(frame)).collect()
    }
}
