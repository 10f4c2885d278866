//! A spot while it is being read.

use super::model::Spot;
use crate::{Error, Place, Result};

/// Its attributes, and the coordinates so far.
pub(super) struct Open {
    pub(super) id: i64,
    pub(super) spot: Spot,
    pub(super) position: [f64; 2],
    pub(super) announced: Option<usize>,
    pub(super) values: Vec<f64>,
}

impl Open {
    /// The spot with its vertices: the coordinates are relative to its position.
    pub(super) fn outlined(mut self, place: &Place) -> Result<Spot> {
        let count = self.announced.unwrap_or(0);
        // three coordinates per vertex where the file says so
        let step = if count > 0 && self.values.len() == 3 * count { 3 } else { 2 };
        if !self.values.is_empty() && self.values.len() != step * count {
            let found = format!("{} coordinates in spot {}", self.values.len(), self.id);
            return Err(Error::structure(place, found, format!("two for each of {count} vertices")));
        }
        let [x, y] = self.position;
        self.spot.points = self.values.chunks_exact(step).map(|v| [x + v[0], y + v[1]]).collect();
        Ok(self.spot)
    }
}
