//! The boundary's field against time and arc length.

use super::body::Body;
use super::words;
use motiform_figures::SpaceTimeFigure;
use motiform_study::Dimension;
use motiform_study::quantity::state;

/// Points along the boundary.
const PLACES: usize = 128;

/// Most columns of the picture.
const COLUMNS: usize = 600;

/// `None` for models without a field on the boundary.
pub(super) fn figure(body: &Body<'_>) -> Option<SpaceTimeFigure> {
    let rows: Vec<usize> = body.rows().step_by(body.rows().len().div_ceil(COLUMNS)).collect();
    let profiles: Vec<Vec<f64>> = rows.iter().filter_map(|&row| body.profile(row, PLACES)).collect();
    if profiles.len() != rows.len() || rows.len() < 2 {
        return None;
    }
    let length = body.units().factor(Dimension::LENGTH);
    let places = (0..PLACES).rev(); // the first row of a picture is its top
    let values =
        places.flat_map(|place| profiles.iter().map(move |profile| profile[place] * length)).collect();
    let last = *rows.last()?;
    Some(SpaceTimeFigure {
        title: format!("{}: *φ*(*s*, *t*)", body.dataset.title()),
        caption: words::about(body),
        times: (body.time(rows[0]), body.time(last)),
        places: (0.0, body.arc_length() * length),
        columns: rows.len(),
        rows: PLACES,
        values,
        x_label: body.units().axis(&state::T),
        y_label: body.units().label("*s*", Dimension::LENGTH),
        value_label: body.units().label("*φ*", Dimension::LENGTH),
    })
}
