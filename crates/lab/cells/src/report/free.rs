//! Numbers without a model: a table and the displacements; speed, area and aspect ratio over time, for beside the film strip.

use crate::report::motion::mean_square;
use crate::report::numbers::{answer, plain};
use crate::report::{Case, Setting};
use crate::{Numbers, Row, Units};
use motiform_dynamics::sample::ascending;
use motiform_figures::palette::INK;
use motiform_figures::report::{Cell, ReportFigure, Section, Table};
use motiform_figures::{Curve, Panel, SeriesFigure};
use motiform_statistics::Answer;
use motiform_study::quantity::frame;
use motiform_study::titles::capital;
use motiform_study::{Error, Quantity};
use motiform_tracks::modes::{Flag, FrameModes};

pub(crate) fn section(case: &Case<'_>, setting: &Setting<'_>) -> Result<Section, Error> {
    let numbers = &case.observation.numbers;
    let seen = numbers.seen;
    let figures = displacement(numbers, setting)?.into_iter().collect();
    let frames = case.cell.modes.frames.len();
    let source = match case.cell.has_no_outlines() {
        true => format!("From the positions in {seen} of {frames} frames."),
        false => format!(
            "From the centroids and polygons of the {seen} of {frames} frames whose outline is seen, whatever its radius."
        ),
    };
    let mut about = format!("{source} In brackets 95 % intervals, from 16 values on.");
    if numbers.pieces > 1 {
        about += &format!(
            " The record has {} pieces between which place or area step; no displacement is taken across.",
            numbers.pieces
        );
    }
    if let Some(remark) = numbers.remark(&setting.units.length) {
        about += &format!(" {}.", capital(&remark));
    }
    Ok(Section {
        title: "Numbers without a model".to_owned(),
        about,
        tables: vec![table(numbers, &setting.units)],
        figures,
        ..Section::default()
    })
}

/// Speed, area and aspect ratio over time; nothing where fewer than two frames are seen.
pub(crate) fn over_time(case: &Case<'_>, setting: &Setting<'_>) -> Result<Option<ReportFigure>, Error> {
    if case.observation.numbers.seen < 2 {
        return Ok(None);
    }
    let words = "Speed from each frame to the next, area and aspect ratio over time. Grey: frames that are missing, or \
     whose outline does not count; there is no speed across a jump of the stage.";
    setting.figure(series(&case.cell.modes.frames, &setting.units), words).map(Some)
}

fn table(numbers: &Numbers, units: &Units) -> Table {
    // a reason is said once
    let mut said: Vec<(String, &str)> = Vec::new();
    let row = |row: Row| {
        let (unit, symbol) = (units.behind(row.quantity.dimension), row.quantity.symbol);
        let words = match row.reason(&unit) {
            None => answer(&row.value, &unit),
            Some(reason) => match said.iter().find(|(other, _)| *other == reason) {
                Some((_, first)) => format!("not given, as {first}"),
                None => {
                    said.push((reason.clone(), symbol));
                    reason
                }
            },
        };
        vec![Cell::text(symbol), Cell::text(words)]
    };
    Table {
        caption: "Path, persistence and form.".to_owned(),
        head: ["quantity", "value"].map(str::to_owned).to_vec(),
        rows: numbers.rows().into_iter().map(row).collect(),
    }
}

/// A number of a cell as it stands in a table, or the bound that the record sets; the reason where there is neither.
pub(crate) fn value(numbers: &Numbers, quantity: &Quantity) -> Result<String, String> {
    let found = numbers.rows().into_iter().find(|row| row.quantity == quantity);
    let Some(row) = found else { return Err("not computed".to_owned()) };
    match (row.value, row.bounds) {
        (Answer::Known(found), _) => Ok(plain(found.value)),
        (_, [Some(low), None]) => Ok(format!("> {}", plain(low))),
        (_, [None, Some(high)]) => Ok(format!("< {}", plain(high))),
        (Answer::Unknown { reason }, _) => Err(reason),
    }
}

/// Speed to the next frame, area and aspect ratio, `None` where the outline is not seen or frames are missing.
fn series(frames: &[FrameModes], units: &Units) -> SeriesFigure {
    let mut gaps: Vec<f64> = frames.windows(2).map(|pair| pair[1].t - pair[0].t).collect();
    ascending(&mut gaps);
    let usual = gaps.get(gaps.len() / 2).copied().unwrap_or(0.0);
    let (mut times, mut rows): (Vec<f64>, Vec<[Option<f64>; 3]>) = (Vec::new(), Vec::new());
    for (k, frame) in frames.iter().enumerate() {
        let seen = frame.is_seen();
        let next = frames.get(k + 1).filter(|next| seen && next.is_seen() && next.t - frame.t < 1.5 * usual);
        let next = next.filter(|next| !next.flags.iter().any(Flag::parts));
        let speed = next.map(|next| {
            let [x, y] = [0, 1].map(|c| next.centroid[c] - frame.centroid[c]);
            libm::hypot(x, y) / (next.t - frame.t)
        });
        let form = frame.form.filter(|_| seen);
        times.push(frame.t);
        rows.push([speed, seen.then_some(frame.area), form.map(|form| form.aspect_ratio)]);
        if frames.get(k + 1).is_some_and(|next| next.t - frame.t > 1.5 * usual) {
            times.push(frame.t + usual);
            rows.push([None; 3]);
        }
    }
    let panel = |at: usize, label: String| Panel {
        label: label.clone(),
        curves: vec![Curve { label, colour: INK, values: rows.iter().map(|row| row[at]).collect() }],
        least: 0.0,
    };
    let panels = vec![
        panel(0, units.axis(&frame::SPEED)),
        panel(1, units.axis(&frame::AREA)),
        panel(2, units.axis(&frame::ASPECT_RATIO)),
    ];
    SeriesFigure { time_label: units.axis(&frame::T), times, panels, ..SeriesFigure::default() }
}

fn displacement(numbers: &Numbers, setting: &Setting<'_>) -> Result<Option<ReportFigure>, Error> {
    let long = numbers.displacement.len() >= 3;
    let Some(figure) = mean_square(&numbers.displacement, &setting.units).filter(|_| long) else {
        return Ok(None);
    };
    let words = "Mean-square displacement over all pairs of frames that are seen, gaps or not; errors of the places \
     are in it. The band ends at an eighth of the record.";
    setting.figure(figure, words).map(Some)
}
