//! Results as tables: modes frame by frame, coefficients cell by cell.

use crate::{CellFit, CellTrack};
use motiform_store::columns::{Column, Values};
use motiform_tracks::modes::FrameModes;

/// The modes of all frames: cell, frame, time, centre, mean radius, z2 to z5 with the standard errors of z2 and z3, area, and what is wrong.
#[must_use]
pub fn mode_columns(cells: &[CellTrack]) -> Vec<Column> {
    let rows: Vec<(&CellTrack, &FrameModes)> =
        cells.iter().flat_map(|cell| cell.modes.frames.iter().map(move |frame| (cell, frame))).collect();
    let number = |read: &dyn Fn(&CellTrack, &FrameModes) -> Option<f64>| {
        Values::Number(rows.iter().map(|row| read(row.0, row.1).unwrap_or(f64::NAN)).collect())
    };
    let text = |read: &dyn Fn(&CellTrack, &FrameModes) -> String| {
        Values::Text(rows.iter().map(|row| read(row.0, row.1)).collect())
    };
    let flags =
        |frame: &FrameModes| frame.flags.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ");
    let mut columns = vec![
        Column::new("cell", "name of the cell", text(&|cell, _| cell.name.clone())),
        Column::new(
            "frame",
            "number of the frame",
            Values::Whole(rows.iter().map(|row| row.1.frame).collect()),
        ),
        Column::new("t", "time", number(&|_, frame| Some(frame.t))),
        Column::new("x", "centre of the modes", number(&|_, frame| Some(frame.radius.as_ref()?.centre[0]))),
        Column::new("y", "centre of the modes", number(&|_, frame| Some(frame.radius.as_ref()?.centre[1]))),
        Column::new("r0", "mean radius", number(&|_, frame| Some(frame.radius.as_ref()?.r0))),
        Column::new("area", "area of the outline", number(&|_, frame| Some(frame.area))),
        Column::new("perimeter", "length of the outline", number(&|_, frame| Some(frame.perimeter))),
        Column::new(
            "aspect_ratio",
            "longer over shorter axis",
            number(&|_, frame| Some(frame.form?.aspect_ratio)),
        ),
        Column::new(
            "solidity",
            "area over that of the convex hull",
            number(&|_, frame| Some(frame.form?.solidity)),
        ),
        Column::new(
            "circularity",
            "4 pi area/perimeter^2",
            number(&|_, frame| Some(frame.form?.circularity)),
        ),
        Column::new("centroid_x", "centroid of the area", number(&|_, frame| Some(frame.centroid[0]))),
        Column::new("centroid_y", "centroid of the area", number(&|_, frame| Some(frame.centroid[1]))),
        Column::new("sigma", "noise of a vertex", number(&|_, frame| Some(frame.radius.as_ref()?.sigma))),
    ];
    for n in 2..=5_usize {
        for (part, name) in ["re", "im"].into_iter().enumerate() {
            let read =
                move |_: &CellTrack, frame: &FrameModes| frame.radius.as_ref()?.z.get(n - 2).map(|z| z[part]);
            columns.push(Column::new(&format!("z{n}_{name}"), "mode of the outline", number(&read)));
        }
    }
    for (place, name) in ["z2_error", "z3_error"].into_iter().enumerate() {
        let read = move |cell: &CellTrack, frame: &FrameModes| {
            let fit = frame.radius.as_ref()?;
            let at = 3 + 2 * place; // after X, Y, R0
            Some(fit.covariance(cell.modes.sigma.unwrap_or(fit.sigma), at, at).sqrt())
        };
        columns.push(Column::new(name, "standard error of the real part", number(&read)));
    }
    columns.push(Column::new("left_out", "1 where the frame does not count", {
        Values::Whole(
            rows.iter().map(|row| i64::from(row.1.is_left_out() || row.1.radius.is_none())).collect(),
        )
    }));
    columns.push(Column::new("seen", "1 where place and form of the outline count", {
        Values::Whole(rows.iter().map(|row| i64::from(row.1.is_seen())).collect())
    }));
    columns.push(Column::new("flags", "what is wrong with the frame", text(&|_, frame| flags(frame))));
    columns
}

/// The coefficients of all fits, in the units of the data.
#[must_use]
pub fn coefficient_columns(fits: &[CellFit]) -> Vec<Column> {
    let rows: Vec<_> = fits
        .iter()
        .filter_map(|fit| Some((fit, fit.fitted.as_ref().ok()?)))
        .flat_map(|(fit, fitted)| {
            let coefficients = fitted.model().coefficients.iter().enumerate();
            // where a search ended that did not converge is no maximum: it has no errors
            let sound = fitted.model().converged();
            coefficients.map(move |(place, coefficient)| (fit, coefficient, fitted.checks.weak(place), sound))
        })
        .collect();
    let number = |read: &dyn Fn(&motiform_inference::Estimate) -> f64| {
        Values::Number(rows.iter().map(|row| read(&row.1.estimate)).collect())
    };
    let error = |read: &dyn Fn(&motiform_inference::Estimate) -> f64| {
        let of = |row: &(_, &motiform_inference::Coefficient, _, bool)| {
            if row.3 { read(&row.1.estimate) } else { f64::NAN }
        };
        Values::Number(rows.iter().map(of).collect())
    };
    vec![
        Column::new(
            "cell",
            "name of the cell",
            Values::Text(rows.iter().map(|row| row.0.name.clone()).collect()),
        ),
        Column::new("term", "the term", Values::Text(rows.iter().map(|row| row.1.name.clone()).collect())),
        Column::new("imaginary", "1 for the imaginary part", {
            Values::Whole(rows.iter().map(|row| i64::from(row.1.imaginary)).collect())
        }),
        Column::new("value", "the coefficient", number(&|estimate| estimate.value)),
        Column::new(
            "error",
            "standard error from the expected information",
            error(&|estimate| estimate.error),
        ),
        Column::new(
            "robust_error",
            "standard error from the scatter of the scores",
            error(&|estimate| estimate.robust),
        ),
        Column::new("low", "lower end of the 95 % interval", error(&|estimate| estimate.interval[0])),
        Column::new("high", "upper end of the 95 % interval", error(&|estimate| estimate.interval[1])),
        Column::new(
            "weak_form",
            "the coefficient by the weak form, a check of sign and order of magnitude",
            Values::Number(rows.iter().map(|row| row.2.unwrap_or(f64::NAN)).collect()),
        ),
    ]
}
