//! A tracked cell that the page shows beside the model that was fitted to it.

use crate::protocol;

/// A tracked cell.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackedCell {
    /// Its name.
    pub name: String,
    /// Units of length and time.
    pub units: [String; 2],
    /// Each frame: time, x, y, R0, then the real and imaginary parts of z2, z3, ... Times increase.
    pub frames: Vec<Vec<f64>>,
}

impl TrackedCell {
    /// For the page; times are counted from the first frame. `model`: the name of the model that was fitted to it.
    pub(crate) fn told(&self, model: &str) -> protocol::Tracked {
        let first = self.frames.first().map_or(0.0, |frame| frame[0]);
        let shifted = |frame: &Vec<f64>| {
            let mut frame = frame.clone();
            frame[0] -= first;
            frame
        };
        let [length, time] = self.units.clone();
        let frames = self.frames.iter().map(shifted).collect();
        protocol::Tracked { model: model.to_owned(), name: self.name.clone(), length, time, frames }
    }
}
