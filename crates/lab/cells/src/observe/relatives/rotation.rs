//! Angles by which the heading and the shape turn.

use super::super::measures::Series;
use motiform_analysis::symmetry::wrap;
use motiform_inference::Observation;
use serde::Serialize;
use std::f64::consts::TAU;

/// The axis of a shape is clear where |z2| is this many times its error, in this share of the frames.
const CLEAR: f64 = 3.0;
const MOST: f64 = 0.95;

/// Net rotations over the record, anticlockwise.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Rotation {
    /// Full turns of the heading, net.
    pub heading: f64,
    /// Largest minus smallest value of the unwrapped heading (rad).
    pub swing: f64,
    /// Full turns of the long axis, net: minus half the unwrapped argument of z2. `None` where z2 is not clear of its errors in 95 % of the
    /// frames.
    pub shape: Option<f64>,
}

pub(super) fn of(series: &Series) -> Rotation {
    let headings = &series.headings;
    let ends = headings.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |e, h| (e.0.min(*h), e.1.max(*h)));
    let net = headings.last().zip(headings.first()).map_or(0.0, |(last, first)| last - first);
    Rotation { heading: net / TAU, swing: ends.1 - ends.0, shape: shape(&series.frames) }
}

fn shape(frames: &[Observation]) -> Option<f64> {
    let clear = |frame: &&Observation| {
        let error = (0.5 * (frame.covariance[2][2] + frame.covariance[3][3])).sqrt();
        libm::hypot(frame.y[2], frame.y[3]) > CLEAR * error
    };
    let seen: Vec<&Observation> = frames.iter().filter(clear).collect();
    if (seen.len() as f64) < MOST * frames.len() as f64 {
        return None;
    }
    let argument = |frame: &Observation| libm::atan2(frame.y[3], frame.y[2]);
    let turned: f64 = seen.windows(2).map(|pair| wrap(argument(pair[1]) - argument(pair[0]))).sum();
    Some(-0.5 * turned / TAU)
}
