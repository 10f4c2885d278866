//! Centroids of the frames that are seen, in pieces between stage jumps.

use motiform_dynamics::sample::ascending;
use motiform_inference::Fix;
use motiform_tracks::modes::{CellModes, Flag, FrameModes};

/// The places of a cell.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Places {
    /// Sampling interval: the median of the times between frames; 0 with fewer than two.
    pub(super) interval: f64,
    /// Pieces, none of them empty.
    pub(super) pieces: Vec<Vec<Fix>>,
}

impl Places {
    /// Of a record that mixes cells there are none.
    pub(super) fn of(modes: &CellModes) -> Self {
        let interval = interval(&modes.frames);
        if modes.mixed().is_some() {
            return Self { interval, pieces: Vec::new() };
        }
        let mut pieces: Vec<Vec<Fix>> = Vec::new();
        let mut new = true;
        for frame in &modes.frames {
            new |= frame.flags.iter().any(Flag::parts);
            if !frame.is_seen() {
                continue;
            }
            let fix = Fix { t: frame.t, at: frame.centroid };
            match pieces.last_mut().filter(|_| !new) {
                Some(piece) => piece.push(fix),
                None => pieces.push(vec![fix]),
            }
            new = false;
        }
        Self { interval, pieces }
    }

    /// The number of intervals between two times, rounded.
    pub(super) fn lag(&self, from: f64, to: f64) -> f64 {
        ((to - from) / self.interval).round()
    }
}

fn interval(frames: &[FrameModes]) -> f64 {
    let mut gaps: Vec<f64> = frames.windows(2).map(|pair| pair[1].t - pair[0].t).collect();
    ascending(&mut gaps);
    gaps.get(gaps.len() / 2).copied().unwrap_or(0.0)
}
