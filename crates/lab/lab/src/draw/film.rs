//! The animation of the body.

use super::body::Body;
use super::{path, words};
use motiform_figures::{Animation, Camera, Frame};
use motiform_study::Dimension;
use motiform_study::quantity::state;

/// Frames of the film (8 seconds at 25 frames per second).
const FRAMES: usize = 200;

/// Points of an outline in the film.
const OUTLINE_POINTS: usize = 64;

/// The body's radius R0 relative to the longer side of the path: large enough to show the shape in a small picture.
const TARGET: f64 = 0.045;

/// The size of the body on the sheet above which the camera follows it instead.
const LARGEST: f64 = 4.0;

/// Equal steps of time, so that the film shows the speed of the motion.
pub(super) fn animation(body: &Body<'_>) -> Animation {
    let rows = body.rows();
    let last = rows.len() - 1;
    let count = FRAMES.min(rows.len());
    let (scale, camera) = scale(body);
    let frame = |index: usize| {
        let row = rows.start + (index * last + (count - 1) / 2) / (count - 1);
        let outline = body.outline(row, scale, OUTLINE_POINTS).unwrap_or_default();
        Frame { t: body.time(row), centre: body.position(row), outline }
    };
    let size = if scale == 1.0 {
        "true size".to_owned()
    } else {
        format!("{} times true size", words::number(scale))
    };
    Animation {
        frames: (0..count).map(frame).collect(),
        path: path::points(body),
        camera,
        note: match body.model.radius() {
            Some(_) => size,
            None => format!("*R*_0 = {}, {size}", body.units().words(body.radius, Dimension::LENGTH, "")),
        },
        x_label: body.units().axis(&state::X),
        y_label: body.units().axis(&state::Y),
        unit: body.units().name(Dimension::LENGTH, "model length"),
        ..Animation::default()
    }
}

/// The size of the body in the film, and the camera for it.
fn scale(body: &Body<'_>) -> (f64, Camera) {
    match body.dataset.manifest.plan.figure.scale {
        given if given > 0.0 => (given, Camera::Auto),
        _ => match body.readable_scale(TARGET) {
            scale if scale > LARGEST => (1.0, Camera::Follow),
            scale => (scale, Camera::Fixed),
        },
    }
}
