//! Observed tracks of shape modes.

use crate::linear::cholesky;
use crate::{Error, Result};
use serde::{Deserialize, Serialize};

/// Numbers observed in a frame: x, y and the real and imaginary parts of `z2` and `z3`.
pub const OBSERVED: usize = 6;

/// What these numbers are called in messages.
const NAMES: [&str; OBSERVED] = ["x", "y", "Re z2", "Im z2", "Re z3", "Im z3"];

/// Fewest frames of a cell.
pub const LEAST_FRAMES: usize = 8;

/// One frame: the centre of the outline and its modes `R = R0 + sum 2 Re(z_n exp(i n theta))`.
///
/// The centre is the point about which the outline has no first harmonic; that of the area biases the fit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Observation {
    /// Time; a missing frame is one whose time does not occur.
    pub t: f64,
    /// `(x, y, Re z2, Im z2, Re z3, Im z3)`.
    pub y: [f64; OBSERVED],
    /// Covariance of the errors of `y`. The fit multiplies it by one factor `s^2` for all frames.
    pub covariance: [[f64; OBSERVED]; OBSERVED],
}

/// The track of one cell: its frames in the order of time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Track(pub Vec<Observation>);

impl Track {
    /// The interval between frames that occurs most: their median.
    #[must_use]
    pub fn interval(&self) -> f64 {
        let mut gaps: Vec<f64> = self.0.windows(2).map(|pair| pair[1].t - pair[0].t).collect();
        gaps.sort_by(f64::total_cmp);
        gaps.get(gaps.len() / 2).copied().unwrap_or(0.0)
    }

    /// Every `n`-th of its frames.
    #[must_use]
    pub fn thinned(&self, n: usize) -> Self {
        Self(self.0.iter().step_by(n.max(1)).cloned().collect())
    }

    /// The same motion seen in a mirror: `y -> -y`, `z -> conj(z)`.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let sign = [1.0, -1.0, 1.0, -1.0, 1.0, -1.0];
        let mirror = |frame: &Observation| Observation {
            t: frame.t,
            y: std::array::from_fn(|i| sign[i] * frame.y[i]),
            covariance: std::array::from_fn(|i| {
                std::array::from_fn(|j| sign[i] * sign[j] * frame.covariance[i][j])
            }),
        };
        Self(self.0.iter().map(mirror).collect())
    }
}

/// Checks what the other functions rely on.
pub(crate) fn check(tracks: &[Track]) -> Result<()> {
    if tracks.is_empty() {
        return Err(Error::NoCell);
    }
    for (cell, track) in tracks.iter().enumerate() {
        if track.0.len() < LEAST_FRAMES {
            return Err(Error::TooShort { cell, frames: track.0.len(), least: LEAST_FRAMES });
        }
        for (frame, observation) in track.0.iter().enumerate() {
            check_frame(cell, frame, observation)?;
        }
        for (frame, pair) in track.0.windows(2).enumerate() {
            let (before, t) = (pair[0].t, pair[1].t);
            if t <= before {
                return Err(Error::Times { cell, frame: frame + 1, t, before });
            }
        }
    }
    Ok(())
}

fn check_frame(cell: usize, frame: usize, observation: &Observation) -> Result<()> {
    let named = NAMES.into_iter().zip(observation.y).chain([("the time", observation.t)]);
    for (what, value) in named {
        if !value.is_finite() {
            return Err(Error::NotFinite { cell, frame, what, value });
        }
    }
    let c = &observation.covariance;
    let size = (0..OBSERVED).map(|i| c[i][i]).fold(0.0, f64::max);
    let symmetric = (0..OBSERVED).all(|i| (0..i).all(|j| (c[i][j] - c[j][i]).abs() <= 1e-9 * size));
    if !symmetric || cholesky(c).is_none() {
        return Err(Error::Covariance { cell, frame });
    }
    Ok(())
}
