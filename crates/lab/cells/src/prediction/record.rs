//! A record on a grid of times: observed or simulated frames, with gaps.

use motiform_inference::Track;
use serde::{Deserialize, Serialize};

/// Fewest frames of a record whose statistics are compared.
const LEAST: usize = 40;

/// Frames at multiples of the sampling interval; `None` where one is missing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The sampling interval.
    pub dt: f64,
    /// `(x, y, Re z2, Im z2, Re z3, Im z3)` of each frame, of models with z4 eight numbers.
    pub frames: Vec<Option<Vec<f64>>>,
}

impl Record {
    /// The frames of a track at the nearest multiples of its sampling interval; `None` for fewer than 40 frames. Of two frames at one
    /// multiple the first is kept. `modes`: those of the model, as far as they are known.
    pub fn of(track: &Track, modes: usize) -> Option<Self> {
        let dt = track.interval();
        let (first, last) = (track.0.first()?.t, track.0.last()?.t);
        let place = |t: f64| ((t - first) / dt).round();
        if track.0.len() < LEAST || place(last) > 1e7 {
            return None;
        }
        let mut frames = vec![None; place(last) as usize + 1];
        for frame in &track.0 {
            frames[place(frame.t) as usize]
                .get_or_insert_with(|| frame.y.iter().take(2 * modes).copied().collect());
        }
        Some(Self { dt, frames })
    }

    /// Number of amplitudes: 2 to 4.
    pub(super) fn modes(&self) -> usize {
        self.frames.iter().flatten().next().map_or(0, |y| y.len() / 2)
    }
}
