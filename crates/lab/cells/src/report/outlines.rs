//! The outlines: a film strip, the path, and the modes of the shape over time.

use crate::Units;
use crate::report::{Case, Setting, free};
use crate::{CellTrack, Record};
use motiform_figures::geometry::Point;
use motiform_figures::palette::{BLUE, INK, VERMILION};
use motiform_figures::report::Section;
use motiform_figures::{Curve, Panel, SeriesFigure, TrackPanel, TrackPanels};
use motiform_inference::Observation;
use motiform_statistics::four_digits;
use motiform_study::quantity::frame::T;
use motiform_study::{Dimension, Error};
use motiform_tracks::Cell;
use motiform_tracks::modes::FrameModes;
use motiform_tracks::synthetic::Synthetic;

/// Pictures of the film strip.
const STRIP: usize = 8;
/// Outlines along a path.
const ALONG: usize = 14;
/// Length of the path in a picture of the film strip, in mean radii.
const TRAIL: f64 = 1.6;
/// Vertices of an outline that is drawn from modes.
const VERTICES: usize = 72;

/// Nothing for a cell without a frame that counts.
pub(crate) fn section(
    case: &Case<'_>,
    drawn: Option<&Cell>,
    setting: &Setting<'_>,
) -> Result<Option<Section>, Error> {
    let (cell, units) = (case.cell, &setting.units);
    if cell.track.0.len() < 2 {
        return polygons(case, drawn, setting);
    }
    let strip = TrackPanels {
        unit: units.length.clone(),
        columns: STRIP,
        panels: strip(cell, drawn, units),
        ..TrackPanels::default()
    };
    let path = TrackPanels {
        unit: units.length.clone(),
        columns: 1,
        panels: vec![observed(case, units)],
        ..TrackPanels::default()
    };
    let mut figures = vec![
        setting.figure(
            strip,
            "The outline at eight times, as it was read, with the path of the centre before, from the ring on.",
        )?,
        setting.figure(
            path,
            format!(
                "The path of the centre, from the ring on, with outlines at equal numbers of frames: dark first, \
                 bright last. They are drawn from R_0, *z*_2{}. Pieces of the path are not joined across frames that are missing.",
                if case.modes() > 3 { ", *z*_3 and *z*_4" } else { " and *z*_3" }
            ),
        )?,
        setting.figure(
            series(case, units),
            format!(
                "Modes of the shape over time: *z*_2 elongation, *z*_3 triangle{}. Grey: frames that are missing or left out.",
                if case.modes() > 3 { ", *z*_4 square" } else { "" }
            ),
        )?,
    ];
    if let Some(series) = free::over_time(case, setting)? {
        figures.insert(1, series);
    }
    Ok(Some(Section { title: "Outlines".to_owned(), about: String::new(), figures, ..Section::default() }))
}

/// The film strip of a cell without modes: its polygons as they were read, with the path of the centroid. Nothing where none is seen.
fn polygons(case: &Case<'_>, drawn: Option<&Cell>, setting: &Setting<'_>) -> Result<Option<Section>, Error> {
    let units = &setting.units;
    let seen: Vec<&FrameModes> = case.cell.modes.frames.iter().filter(|frame| frame.is_seen()).collect();
    let panel = |k: usize| {
        let frame = seen[k];
        let read = drawn?.frames.iter().find(|outline| outline.frame == frame.frame)?;
        Some(TrackPanel {
            name: format!("*t* = {}", units.of_time(&four_digits(frame.t))),
            path: vec![seen[..=k].iter().map(|frame| up(frame.centroid, units)).collect()],
            outlines: vec![read.points.iter().map(|p| up(*p, units)).collect()],
        })
    };
    let panels: Vec<TrackPanel> = chosen(seen.len(), STRIP).filter_map(panel).collect();
    if panels.is_empty() {
        return Ok(None);
    }
    let strip = TrackPanels { unit: units.length.clone(), columns: STRIP, panels, ..TrackPanels::default() };
    let (title, words) = if case.cell.has_no_outlines() {
        ("Path", "The path up to eight times, from the ring on.")
    } else {
        (
            "Outlines",
            "The outline at up to eight times, as it was read, with the path of the centroid before. There are no modes of the radius.",
        )
    };
    let mut figures = vec![setting.figure(strip, words)?];
    figures.extend(free::over_time(case, setting)?);
    Ok(Some(Section { title: title.to_owned(), figures, ..Section::default() }))
}

/// The outline of a frame.
fn outline(radius: f64, y: &[f64], units: &Units) -> Vec<Point> {
    let z = y[2..].chunks_exact(2).map(|part| [part[0], part[1]]).collect();
    let body = Synthetic { centre: [y[0], y[1]], r0: radius, z };
    body.vertices(VERTICES, 0.0).into_iter().map(|p| up(p, units)).collect()
}

/// A point with y upwards as in the images.
fn up(p: Point, units: &Units) -> Point {
    if units.y_down { [p[0], -p[1]] } else { p }
}

/// Places of `count` of `all` frames, at equal distances.
fn chosen(all: usize, count: usize) -> impl Iterator<Item = usize> {
    let count = count.min(all);
    (0..count).map(move |k| if count < 2 { 0 } else { k * (all - 1) / (count - 1) })
}

fn strip(cell: &CellTrack, drawn: Option<&Cell>, units: &Units) -> Vec<TrackPanel> {
    let frames = &cell.track.0;
    let panel = |k: usize| {
        let frame = &frames[k];
        let read = drawn.and_then(|cell| cell.frames.iter().find(|outline| outline.t == frame.t));
        let points = match read {
            Some(read) => read.points.iter().map(|p| up(*p, units)).collect(),
            None => outline(cell.radius, &frame.y, units),
        };
        TrackPanel {
            name: format!("*t* = {}", units.of_time(&four_digits(frame.t))),
            path: vec![before(frames, k, cell.radius).iter().map(|p| up(*p, units)).collect()],
            outlines: vec![points],
        }
    };
    chosen(frames.len(), STRIP).map(panel).collect()
}

/// The path of the centre up to a frame, as far back as it stays within [`TRAIL`] radii.
fn before(frames: &[Observation], k: usize, radius: f64) -> Vec<Point> {
    let [x, y] = [frames[k].y[0], frames[k].y[1]];
    let near = |frame: &&Observation| libm::hypot(frame.y[0] - x, frame.y[1] - y) < TRAIL * radius;
    let mut path: Vec<Point> =
        frames[..=k].iter().rev().take_while(near).map(|frame| [frame.y[0], frame.y[1]]).collect();
    path.reverse();
    path
}

/// The observed cell.
pub(crate) fn observed(case: &Case<'_>, units: &Units) -> TrackPanel {
    let (name, cell, numbers) = ("observed".to_owned(), case.cell, 2 * case.modes());
    match Record::of(&cell.track, case.modes()) {
        Some(record) => track(name, &record, cell.radius, units),
        None => TrackPanel {
            name,
            path: vec![cell.track.0.iter().map(|frame| up([frame.y[0], frame.y[1]], units)).collect()],
            outlines: (cell.track.0.iter())
                .map(|frame| outline(cell.radius, &frame.y[..numbers], units))
                .collect(),
        },
    }
}

/// A record with outlines along it.
pub(crate) fn track(name: String, record: &Record, radius: f64, units: &Units) -> TrackPanel {
    let there: Vec<&Vec<f64>> = record.frames.iter().flatten().collect();
    let pieces = record.frames.split(Option::is_none).filter(|piece| !piece.is_empty());
    let path =
        pieces.map(|piece| piece.iter().flatten().map(|y| up([y[0], y[1]], units)).collect()).collect();
    let outlines = chosen(there.len(), ALONG).map(|k| outline(radius, there[k], units)).collect();
    TrackPanel { name, path, outlines }
}

fn series(case: &Case<'_>, units: &Units) -> SeriesFigure {
    let cell = case.cell;
    let interval = cell.track.interval();
    let record = Record::of(&cell.track, case.modes());
    let frames: Vec<Option<Vec<f64>>> = match &record {
        Some(record) => record.frames.clone(),
        None => cell.track.0.iter().map(|frame| Some(frame.y.clone())).collect(),
    };
    let first = cell.track.0.first().map_or(0.0, |frame| frame.t);
    let times = match record {
        Some(_) => (0..frames.len()).map(|k| first + k as f64 * interval).collect(),
        None => cell.track.0.iter().map(|frame| frame.t).collect(),
    };
    let values =
        |of: &dyn Fn(&[f64]) -> f64| frames.iter().map(|y| y.as_ref().map(|y| of(y))).collect::<Vec<_>>();
    let mode = |n: usize| {
        let at = 2 * n - 2;
        let part = |label: &str, colour, k: usize| Curve {
            label: label.to_owned(),
            colour,
            values: values(&|y| y[k]),
        };
        let size = Curve {
            label: format!("|*z*_{n}|"),
            colour: INK,
            values: values(&|y| libm::hypot(y[at], y[at + 1])),
        };
        Panel {
            label: units.label(&format!("*z*_{n}"), Dimension::LENGTH),
            curves: vec![size, part("real part", BLUE, at), part("imaginary part", VERMILION, at + 1)],
            least: 0.0,
        }
    };
    SeriesFigure {
        time_label: units.axis(&T),
        times,
        panels: (2..=case.modes()).map(mode).collect(),
        ..SeriesFigure::default()
    }
}
