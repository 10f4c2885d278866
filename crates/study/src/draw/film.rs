//! The body in motion.

use super::body::Body;
use super::path;
use crate::figures::{Animation, Frame};

/// Frames of the film (8 seconds at 25 frames per second).
const FRAMES: usize = 200;

/// Points of an outline in the film.
const OUTLINE_POINTS: usize = 64;

/// Equal steps of time, so that the film shows the pace of the motion.
pub(super) fn animation(body: &Body<'_>) -> Animation {
    let rows = body.rows();
    let last = rows.len() - 1;
    let count = FRAMES.min(rows.len());
    let frame = |index: usize| {
        let row = rows.start + (index * last + (count - 1) / 2) / (count - 1);
        let outline = body.outline(row, OUTLINE_POINTS).unwrap_or_default();
        Frame { t: body.time(row), centre: body.position(row), outline }
    };
    Animation { frames: (0..count).map(frame).collect(), path: path::points(body), ..Animation::default() }
}
