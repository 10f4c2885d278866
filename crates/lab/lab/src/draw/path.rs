//! The path with the body drawn along it.

use super::body::Body;
use super::words;
use motiform_figures::{OutlineStamp, PathFigure, PathPoint, SectionLine};
use motiform_study::Dimension;
use motiform_study::quantity::state;

/// Points of a drawn outline.
const OUTLINE_POINTS: usize = 96;

/// Number of outlines: their distance is about this many radii.
const SPACING_RADII: f64 = 3.2;

pub(super) fn figure(body: &Body<'_>) -> PathFigure {
    let (stamps, missing) = outlines(body);
    let mut caption = words::about(body);
    caption.extend(words::rest(body));
    caption.push(words::outlines(body));
    if missing > 0 {
        caption.push(format!("{missing} outlines are left out: the shape is no closed curve there."));
    }
    caption.extend(words::section(body));
    PathFigure {
        title: body.dataset.title(),
        caption,
        segments: vec![points(body)],
        outlines: stamps,
        section: section(body),
        x_label: body.units().axis(&state::X),
        y_label: body.units().axis(&state::Y),
        time_label: body.units().axis(&state::T),
    }
}

/// The shown path: a point at rest.
pub(super) fn points(body: &Body<'_>) -> Vec<PathPoint> {
    body.rows()
        .take(body.rests.map_or(usize::MAX, |_| 1))
        .map(|row| {
            let [x, y] = body.position(row);
            PathPoint { t: body.time(row), x, y }
        })
        .collect()
}

/// The outlines, and how many shapes are not curves.
fn outlines(body: &Body<'_>) -> (Vec<OutlineStamp>, usize) {
    let rows = body.rows_along(count(body));
    let stamp = |&row: &usize| {
        Some(OutlineStamp { t: body.time(row), points: body.outline(row, body.scale, OUTLINE_POINTS)? })
    };
    let stamps: Vec<OutlineStamp> = rows.iter().filter_map(stamp).collect();
    let missing = rows.len() - stamps.len();
    (stamps, missing)
}

fn count(body: &Body<'_>) -> usize {
    let wanted = body.dataset.manifest.plan.figure.outlines;
    if wanted > 0 {
        return usize::try_from(wanted).unwrap_or(usize::MAX);
    }
    let drawn = body.scale * body.radius * body.units().factor(Dimension::LENGTH);
    (body.length() / (SPACING_RADII * drawn)).clamp(2.0, 32.0) as usize
}

fn section(body: &Body<'_>) -> Option<SectionLine> {
    let map = body.dataset.manifest.plan.computation.return_map.as_ref()?;
    let all = body.column("t");
    let shown = all[body.rows().start]..=all[body.rows().end - 1];
    let length = body.units().factor(Dimension::LENGTH);
    let crossings = body.dataset.crossings.as_ref()?;
    let (times, xs) = (crossings.get("t")?, crossings.get("x")?);
    let points: Vec<[f64; 2]> = times
        .iter()
        .zip(xs)
        .filter(|(t, _)| shown.contains(t))
        .map(|(_, &x)| [x * length, map.y * length])
        .collect();
    let extent = body.extent();
    let left = map.x_min.max(-extent);
    let right = map.x_max.min(extent);
    Some(SectionLine {
        from: [left * length, map.y * length],
        to: [right * length, map.y * length],
        label: "section".to_owned(),
        crossings: points,
    })
}
