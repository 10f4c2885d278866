//! A velocity of the stage, beside the motion of one cell that turns.

use crate::{Observation, Track};
use motiform_dynamics::Complex;

/// Fewest frames.
const LEAST_FRAMES: usize = 60;
/// Share of the frames in which the axis must be clear, and by how many errors.
const MOST: f64 = 0.9;
const CLEAR: f64 = 3.0;
/// Largest modulus of the mean direction of the axis: above it the cell keeps a direction, and its own motion is not told from that of the stage.
const MOST_ORDER: f64 = 1.0 / 3.0;
/// Largest angle of the axis between two frames (rad): beyond, its turns are not followed.
const FOLLOWED: f64 = 0.8;

/// Direction of the long axis (unit modulus) and velocity between two frames.
type Row = (Complex<f64>, Complex<f64>);

/// The constant velocity u in v = u + a exp(i theta), theta the direction of the long axis of z2, followed from frame to frame; least squares.
///
/// Laws that keep their form under rotations have u = 0: what does not turn with the cell is the stage, or a flow. `None` with fewer than 60 frames, where the axis is not clear of its
/// errors or turns too far between frames to be followed, and where the cell keeps a direction.
///
/// # Units   length/time of the track
/// # Checked by  `tests/all/stage.rs`: circles with and without a drift
#[must_use]
pub fn stage_velocity(track: &Track) -> Option<[f64; 2]> {
    let axes = axes(&track.0)?;
    let mut rows: Vec<Row> = Vec::new();
    for (pair, axis) in track.0.windows(2).zip(axes.windows(2)) {
        let time = pair[1].t - pair[0].t;
        let [x, y] = [0, 1].map(|k| (pair[1].y[k] - pair[0].y[k]) / time);
        let (sin, cos) = libm::sincos(0.5 * (axis[0] + axis[1]));
        rows.push((Complex::new(cos, sin), Complex::new(x, y)));
    }
    let count = rows.len() as f64;
    let mean = |of: fn(&Row) -> Complex<f64>| {
        rows.iter().map(of).fold(Complex::new(0.0, 0.0), |sum, one| sum + one).scale(1.0 / count)
    };
    let (axis, velocity) = (mean(|row| row.0), mean(|row| row.1));
    if axis.norm_sqr().sqrt() > MOST_ORDER {
        return None;
    }
    let covariance = mean(|row| row.1 * row.0.conj()) + -(velocity * axis.conj());
    let a = covariance.scale(1.0 / (1.0 - axis.norm_sqr()));
    let u = velocity + -(a * axis);
    Some([u.re, u.im])
}

/// Directions of the long axis, -arg(z2)/2, followed from frame to frame.
fn axes(frames: &[Observation]) -> Option<Vec<f64>> {
    let clear = |frame: &&Observation| {
        let error = (0.5 * (frame.covariance[2][2] + frame.covariance[3][3])).sqrt();
        libm::hypot(frame.y[2], frame.y[3]) > CLEAR * error
    };
    let count = frames.iter().filter(clear).count();
    if frames.len() < LEAST_FRAMES || (count as f64) < MOST * frames.len() as f64 {
        return None;
    }
    let mut axes: Vec<f64> = Vec::with_capacity(frames.len());
    for frame in frames {
        let angle = -0.5 * libm::atan2(frame.y[3], frame.y[2]);
        // an axis has no head: directions are the same up to half a turn
        let half = std::f64::consts::PI;
        let turned = axes.last().map_or(angle, |last| angle - half * ((angle - last) / half).round());
        if axes.last().is_some_and(|last| (turned - last).abs() > FOLLOWED) {
            return None;
        }
        axes.push(turned);
    }
    Some(axes)
}

impl Track {
    /// The same track without a motion of the stage of this velocity.
    #[must_use]
    pub fn without_velocity(&self, velocity: [f64; 2]) -> Self {
        let mut frames = self.0.clone();
        let first = frames.first().map_or(0.0, |frame| frame.t);
        for frame in &mut frames {
            for k in 0..2 {
                frame.y[k] -= velocity[k] * (frame.t - first);
            }
        }
        Self(frames)
    }
}
