//! The computation of a folder of fits.

use crate::{CellTrack, Error, FitOptions, Result, Sample, TOGETHER};
use motiform_study::Error as StudyError;
use motiform_study::dataset::VERSION;
use motiform_study::plan::sha256_hex;
use serde::{Deserialize, Serialize};
use std::fs;
use std::path::Path;

/// The computation of a folder.
pub(crate) const MANIFEST: &str = "_fit.json";
/// Raised when the numbers of a fit, or what is stored of it, change.
const FORMAT: u32 = 6;

/// One cell of the input.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Input {
    name: String,
    /// SHA-256 of the frames that count, with their errors.
    frames: String,
    /// Time between frames, and mean radius: they tell another interval or scale from other outlines.
    #[serde(default)]
    interval: f64,
    #[serde(default)]
    radius: f64,
}

impl Input {
    /// The part of the frames that differs.
    fn change(&self, asked: &Self) -> String {
        let differ = |there: f64, asked: f64| (there / asked - 1.0).abs() > 1e-9;
        if self.interval > 0.0 && differ(self.interval, asked.interval) {
            return format!("frame interval {} there, {} requested", self.interval, asked.interval);
        }
        if self.radius > 0.0 && differ(self.radius, asked.radius) {
            return format!("mean radius {:.4} there, {:.4} requested", self.radius, asked.radius);
        }
        "other frames".to_owned()
    }
}

/// The settings, the units and the cells.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Manifest {
    motiform: String,
    format: u32,
    pub(super) settings: FitOptions,
    units: [String; 2],
    cells: Vec<Input>,
}

impl Manifest {
    pub(super) fn new(sample: &Sample, cells: &[&CellTrack], options: &FitOptions) -> Self {
        let input = |cell: &&CellTrack| Input {
            name: cell.name.clone(),
            frames: digest(cell, options.modes),
            interval: cell.track.interval(),
            radius: cell.radius,
        };
        Self {
            motiform: VERSION.to_owned(),
            format: FORMAT,
            settings: options.clone(),
            units: [sample.tracks.length_unit.clone(), sample.tracks.time_unit.clone()],
            cells: cells.iter().map(input).collect(),
        }
    }

    pub(super) fn read(folder: &Path) -> Result<Self> {
        let no = |reason: String| Error::NoFits { path: folder.to_owned(), reason };
        let bytes = fs::read(folder.join(MANIFEST)).map_err(|error| no(format!("{MANIFEST}: {error}")))?;
        serde_json::from_slice(&bytes).map_err(|error| no(format!("{MANIFEST}: {error}")))
    }

    pub(super) fn bytes(&self, folder: &Path) -> Result<Vec<u8>> {
        let failed = |error| StudyError::write_failed(&folder.join(MANIFEST), error);
        let mut bytes = serde_json::to_vec_pretty(self).map_err(failed)?;
        bytes.push(b'\n');
        Ok(bytes)
    }

    /// Number of fits.
    pub(super) fn fits(&self) -> usize {
        if self.settings.together { 1 } else { self.cells.len() }
    }

    /// The name of a fit.
    pub(super) fn name(&self, number: usize) -> &str {
        if self.settings.together { TOGETHER } else { &self.cells[number].name }
    }

    /// The request that differs from what is there.
    pub(super) fn differences(&self, asked: &Self) -> Vec<String> {
        let mut found = Vec::new();
        if self.format != asked.format {
            found.push(format!("fits of format {} there, {} here", self.format, asked.format));
        }
        let values = [&self.settings, &asked.settings].map(|of| serde_json::to_value(of).unwrap_or_default());
        for (key, there) in values[0].as_object().into_iter().flatten() {
            if *there != values[1][key] {
                found.push(format!("{key}: {there} there, {} requested", values[1][key]));
            }
        }
        if self.units != asked.units {
            found.push(format!(
                "units: {} there, {} requested",
                self.units.join(", "),
                asked.units.join(", ")
            ));
        }
        let names = |of: &Self| of.cells.iter().map(|cell| cell.name.clone()).collect::<Vec<_>>();
        if names(self) == names(asked) {
            let changed =
                self.cells.iter().zip(&asked.cells).filter(|(there, asked)| there.frames != asked.frames);
            found.extend(
                changed.take(3).map(|(there, asked)| format!("cell {}: {}", there.name, there.change(asked))),
            );
        } else {
            found.push(format!(
                "{} cells there, {} requested, not the same ones",
                self.cells.len(),
                asked.cells.len()
            ));
        }
        found
    }
}

/// SHA-256 of what a fit is made from: frames, and the beginnings of pieces.
pub(crate) fn digest(cell: &CellTrack, modes: usize) -> String {
    let own = 2 * modes;
    let mut bytes = Vec::with_capacity(cell.frames() * 43 * 8);
    for frame in &cell.track.0 {
        let covariance = frame.covariance.iter().take(own).flat_map(|row| row.iter().take(own));
        let numbers = std::iter::once(&frame.t).chain(frame.y.iter().take(own)).chain(covariance);
        numbers.for_each(|x| bytes.extend_from_slice(&x.to_le_bytes()));
    }
    cell.breaks.iter().for_each(|&place| bytes.extend_from_slice(&(place as u64).to_le_bytes()));
    sha256_hex(&bytes)
}
