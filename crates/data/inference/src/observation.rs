//! Observed tracks of shape modes.

use crate::{Error, MOST_MODES, Result};
use motiform_dynamics::sample::ascending;
use nalgebra::{Cholesky, DMatrix};
use serde::{Deserialize, Serialize};

/// The names of the observed numbers of a frame, in the order of [`Observation::y`]: for a model of n
/// amplitudes the first 2n.
pub(crate) const NAMES: [&str; 2 * MOST_MODES] =
    ["x", "y", "Re z2", "Im z2", "Re z3", "Im z3", "Re z4", "Im z4"];

/// Fewest frames of a cell.
pub const LEAST_FRAMES: usize = 8;

/// One frame: the centre of the outline and its modes `R = R0 + sum 2 Re(z_n exp(i n theta))`.
///
/// The centre is the point about which the outline has no first harmonic; that of the area biases the fit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Observation {
    /// Time; a missing frame is one whose time does not occur.
    pub t: f64,
    /// `(x, y, Re z2, Im z2, Re z3, Im z3)` and more modes, if they are known. A model of three amplitudes is
    /// fitted to these six, one of four to eight; the others are not looked at.
    pub y: Vec<f64>,
    /// Covariance of the errors of `y`. The fit multiplies it by one factor `s^2` for all frames.
    pub covariance: Vec<Vec<f64>>,
}

impl Observation {
    /// Lower triangle `L` with `L L^T` the covariance of the first `numbers` of `y`; `None` unless that is positive definite.
    pub fn covariance_root(&self, numbers: usize) -> Option<Vec<Vec<f64>>> {
        let own = DMatrix::from_fn(numbers, numbers, |i, j| self.covariance[i][j]);
        let root = Cholesky::new(own)?.unpack();
        Some(root.row_iter().map(|row| row.iter().copied().collect()).collect())
    }
}

/// The track of one cell: its frames in the order of time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Track(pub Vec<Observation>);

impl Track {
    /// The interval between frames that occurs most: their median.
    pub fn interval(&self) -> f64 {
        let mut gaps: Vec<f64> = self.0.windows(2).map(|pair| pair[1].t - pair[0].t).collect();
        ascending(&mut gaps);
        gaps.get(gaps.len() / 2).copied().unwrap_or(0.0)
    }

    /// Every `n`-th of its frames.
    pub fn thinned(&self, n: usize) -> Self {
        Self(self.0.iter().step_by(n.max(1)).cloned().collect())
    }

    /// The same motion seen in a mirror: `y -> -y`, `z -> conj(z)`.
    pub fn mirrored(&self) -> Self {
        let sign = |i: usize| if i.is_multiple_of(2) { 1.0 } else { -1.0 };
        let mirrored = |row: &Vec<f64>| row.iter().enumerate().map(|(i, x)| sign(i) * x).collect();
        let mirror = |frame: &Observation| Observation {
            t: frame.t,
            y: mirrored(&frame.y),
            covariance: (frame.covariance.iter().enumerate())
                .map(|(i, row)| row.iter().enumerate().map(|(j, x)| sign(i) * sign(j) * x).collect())
                .collect(),
        };
        Self(self.0.iter().map(mirror).collect())
    }
}

/// Checks what the other functions rely on, of the numbers that a model of so many amplitudes is fitted to.
pub(crate) fn check(tracks: &[Track], modes: usize) -> Result<()> {
    if tracks.is_empty() {
        return Err(Error::NoCell);
    }
    for (cell, track) in tracks.iter().enumerate() {
        if track.0.len() < LEAST_FRAMES {
            return Err(Error::TooShort { cell, frames: track.0.len(), least: LEAST_FRAMES });
        }
        for (frame, observation) in track.0.iter().enumerate() {
            check_frame(cell, frame, observation, 2 * modes)?;
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

fn check_frame(cell: usize, frame: usize, observation: &Observation, numbers: usize) -> Result<()> {
    let c = &observation.covariance;
    let given = observation.y.len().min(c.len()).min(c.iter().map(Vec::len).min().unwrap_or(0));
    if given < numbers {
        return Err(Error::Modes { cell, frame, given, numbers });
    }
    let own = &observation.y[..numbers];
    let named = NAMES.into_iter().zip(own.iter().copied()).chain([("the time", observation.t)]);
    for (what, value) in named {
        if !value.is_finite() {
            return Err(Error::NotFinite { cell, frame, what, value });
        }
    }
    let size = (0..numbers).map(|i| c[i][i]).fold(0.0, f64::max);
    let symmetric = (0..numbers).all(|i| (0..i).all(|j| (c[i][j] - c[j][i]).abs() <= 1e-9 * size));
    if !symmetric || !size.is_finite() || observation.covariance_root(numbers).is_none() {
        return Err(Error::Covariance { cell, frame });
    }
    Ok(())
}
