//! Results as tables: modes frame by frame, coefficients cell by cell.

use crate::{CellFit, CellTrack};
use motiform_inference::Estimate;
use motiform_store::columns::Column;
use motiform_study::Quantity;
use motiform_study::quantity::{coefficient, frame};
use motiform_tracks::Form;
use motiform_tracks::modes::{FrameModes, RadiusFit};

/// Real and imaginary parts of z2 to z5.
const MODES: [&Quantity; 8] = [
    &frame::Z2_RE,
    &frame::Z2_IM,
    &frame::Z3_RE,
    &frame::Z3_IM,
    &frame::Z4_RE,
    &frame::Z4_IM,
    &frame::Z5_RE,
    &frame::Z5_IM,
];

/// The modes of all frames: cell, frame, time, centre, mean radius, z2 to z5 with the standard errors of z2 and z3, area, and what is
/// wrong.
pub fn mode_columns(cells: &[CellTrack]) -> Vec<Column> {
    let rows: Vec<(&CellTrack, &FrameModes)> =
        cells.iter().flat_map(|cell| cell.modes.frames.iter().map(move |frame| (cell, frame))).collect();
    let frames = || rows.iter().map(|row| row.1);
    let flags =
        |frame: &FrameModes| frame.flags.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
    let radius =
        |read: fn(&RadiusFit) -> f64| frames().map(|frame| frame.radius.as_ref().map(read)).collect();
    let form = |read: fn(Form) -> f64| frames().map(|frame| frame.form.map(read)).collect();
    let of_frame = |read: fn(&FrameModes) -> f64| frames().map(read).collect();
    let mode = |place: usize| {
        frames().map(|frame| frame.radius.as_ref()?.z.get(place / 2).map(|z| z[place % 2])).collect()
    };
    // after X, Y, R0
    let error_of = |(cell, frame): &(&CellTrack, &FrameModes), at: usize| {
        let fit = frame.radius.as_ref()?;
        Some(fit.covariance(cell.modes.sigma.unwrap_or(fit.sigma), at, at).sqrt())
    };
    let error = |at: usize| rows.iter().map(|row| error_of(row, at)).collect();
    let mut columns = vec![
        Column::of_data(&frame::CELL, rows.iter().map(|row| row.0.name.clone()).collect()),
        Column::of_data(&frame::FRAME, frames().map(|frame| frame.frame).collect()),
        Column::of_data(&frame::T, of_frame(|frame| frame.t)),
        Column::of_data(&frame::X, radius(|fit| fit.centre[0])),
        Column::of_data(&frame::Y, radius(|fit| fit.centre[1])),
        Column::of_data(&frame::R0, radius(|fit| fit.r0)),
        Column::of_data(&frame::AREA, of_frame(|frame| frame.area)),
        Column::of_data(&frame::PERIMETER, of_frame(|frame| frame.perimeter)),
        Column::of_data(&frame::ASPECT_RATIO, form(|form| form.aspect_ratio)),
        Column::of_data(&frame::SOLIDITY, form(|form| form.solidity)),
        Column::of_data(&frame::CIRCULARITY, form(|form| form.circularity)),
        Column::of_data(&frame::CENTROID_X, of_frame(|frame| frame.centroid[0])),
        Column::of_data(&frame::CENTROID_Y, of_frame(|frame| frame.centroid[1])),
        Column::of_data(&frame::SIGMA, radius(|fit| fit.sigma)),
    ];
    let modes = MODES.into_iter().enumerate();
    columns.extend(modes.map(|(place, quantity)| Column::of_data(quantity, mode(place))));
    columns.extend([
        Column::of_data(&frame::Z2_ERROR, error(3)),
        Column::of_data(&frame::Z3_ERROR, error(5)),
        Column::of_data(
            &frame::LEFT_OUT,
            frames().map(|frame| frame.is_left_out() || frame.radius.is_none()).collect(),
        ),
        Column::of_data(&frame::SEEN, frames().map(FrameModes::is_seen).collect()),
        Column::of_data(&frame::FLAGS, frames().map(flags).collect()),
    ]);
    columns
}

/// The coefficients of all fits, in the units of the data.
pub fn coefficient_columns(fits: &[CellFit]) -> Vec<Column> {
    let rows: Vec<_> = fits
        .iter()
        .filter_map(|fit| Some((fit, fit.fitted.as_ref().ok()?)))
        .flat_map(|(fit, fitted)| {
            let coefficients = fitted.model().coefficients.iter().enumerate();
            let known = fitted.has_errors();
            coefficients.map(move |(place, coefficient)| (fit, coefficient, fitted.checks.weak(place), known))
        })
        .collect();
    let error =
        |read: fn(&Estimate) -> f64| rows.iter().map(|row| row.3.then(|| read(&row.1.estimate))).collect();
    vec![
        Column::of_data(&coefficient::CELL, rows.iter().map(|row| row.0.name.clone()).collect()),
        Column::of_data(&coefficient::TERM, rows.iter().map(|row| row.1.name.clone()).collect()),
        Column::of_data(&coefficient::IMAGINARY, rows.iter().map(|row| row.1.imaginary).collect()),
        Column::of_data(&coefficient::VALUE, rows.iter().map(|row| row.1.estimate.value).collect()),
        Column::of_data(&coefficient::ERROR, error(|estimate| estimate.error)),
        Column::of_data(&coefficient::ROBUST_ERROR, error(|estimate| estimate.robust)),
        Column::of_data(&coefficient::LOW, error(|estimate| estimate.interval[0])),
        Column::of_data(&coefficient::HIGH, error(|estimate| estimate.interval[1])),
        Column::of_data(&coefficient::WEAK_FORM, rows.iter().map(|row| row.2).collect()),
    ]
}
