//! The content of a TrackMate file.

use crate::Image;
use std::collections::{HashMap, HashSet};

/// A detection.
#[derive(Debug)]
pub(super) struct Spot {
    pub(super) frame: i64,
    /// Time, in the unit of the file.
    pub(super) t: Option<f64>,
    /// Vertices in the image; none for a point.
    pub(super) points: Vec<[f64; 2]>,
}

/// The links of one track, as the file orders them.
#[derive(Debug, Default)]
pub(super) struct Track {
    pub(super) id: String,
    pub(super) links: Vec<[i64; 2]>,
}

/// The file.
#[derive(Debug, Default)]
pub(super) struct Model {
    pub(super) length_unit: Option<String>,
    pub(super) time_unit: Option<String>,
    pub(super) pixel_size: Option<f64>,
    pub(super) interval: Option<f64>,
    pub(super) image: Option<Image>,
    pub(super) spots: HashMap<i64, Spot>,
    pub(super) all: Vec<Track>,
    /// Tracks that passed the filters of the file, where it has such a list.
    pub(super) kept: Option<HashSet<String>>,
}

impl Model {
    /// The tracks that the file keeps, and the number of others.
    pub(super) fn tracks(&self) -> (Vec<&Track>, usize) {
        let keeps = |track: &&Track| self.kept.as_ref().is_none_or(|kept| kept.contains(&track.id));
        let kept: Vec<&Track> = self.all.iter().filter(keeps).collect();
        let others = self.all.len() - kept.len();
        (kept, others)
    }
}
