//! Speed, turning rate and the sizes of the deformations against time.

use super::body::Body;
use super::words;
use crate::varying::varies;
use motiform_dynamics::model::Observable;
use motiform_figures::palette::CATEGORIES;
use motiform_figures::{Curve, Panel, SeriesFigure};
use motiform_study::quantity::state::{SPEED, T, TURNING_RATE};
use motiform_study::{Dimension, Quantity};

/// An observable below this throughout is not drawn but mentioned.
const NEGLIGIBLE: f64 = 1e-9;

pub(super) fn figure(body: &Body<'_>) -> SeriesFigure {
    let mut notes = Vec::new();
    let mut panels = vec![panel(body, &SPEED, 0)];
    let turning = without_rounding(panel(body, &TURNING_RATE, 1), body);
    if turning.curves[0].values.iter().any(Option::is_none) {
        notes.push(if body.dataset.manifest.plan.computation.noise.is_some() {
            "The turning rate is undefined at rest, and where noise leaves the velocity no derivative."
                .to_owned()
        } else {
            "The turning rate is undefined where the body is at rest.".to_owned()
        });
    }
    panels.push(turning);
    for (index, observable) in body.model.observables().iter().enumerate() {
        let largest = body.column(observable.name)[body.rows()].iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        if largest < NEGLIGIBLE {
            notes.push(format!("{} stays below {}.", observable.symbol, words::number(NEGLIGIBLE)));
        } else {
            panels.push(panel(body, &declared(observable), 2 + index));
        }
    }
    measures(body, &mut panels, &mut notes);
    SeriesFigure {
        title: body.dataset.title(),
        time_label: body.units().axis(&T),
        times: body.rows().map(|row| body.time(row)).collect(),
        panels,
        notes,
        caption: words::about(body),
    }
}

/// The rates as 0 where all together turn by less than what is negligible (rad) in the time that is shown: a straight way, whose rates are
/// rounding alone.
fn without_rounding(mut panel: Panel, body: &Body<'_>) -> Panel {
    let rates = &body.column(TURNING_RATE.name)[body.rows()];
    let largest =
        rates.iter().filter(|rate| rate.is_finite()).fold(0.0, |most: f64, rate| most.max(rate.abs()));
    let shown = body.rows();
    let times = &body.column(T.name)[shown];
    let time = times.last().zip(times.first()).map_or(0.0, |(last, first)| last - first);
    if largest * time < NEGLIGIBLE {
        let values = panel.curves.iter_mut().flat_map(|curve| &mut curve.values);
        values.flatten().for_each(|rate| *rate = 0.0);
    }
    panel
}

/// The measures of the boundary: those that vary as panels, constant ones as notes.
fn measures(body: &Body<'_>, panels: &mut Vec<Panel>, notes: &mut Vec<String>) {
    for measure in body.model.measures() {
        let shown = &body.column(measure.name)[body.rows()];
        let high = shown.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if varies(shown.iter().copied(), 1.0) {
            panels.push(panel(body, &declared(measure), 2 + panels.len()));
        } else if shown.iter().all(|x| x.is_nan() || *x == 0.0) {
            notes.push(format!("The {} is 0 throughout.", measure.symbol));
        } else if high > 1e-9 {
            notes.push(format!(
                "The {} stays at {}.",
                measure.symbol,
                body.units().words(high, declared(measure).dimension, "")
            ));
        } else {
            notes.push(format!("The {} stays below {}.", measure.symbol, words::number(NEGLIGIBLE)));
        }
    }
}

/// The quantity that a model declares.
const fn declared(observable: &Observable) -> Quantity {
    let Observable { name, symbol, meaning, length } = *observable;
    Quantity { name, symbol, dimension: Dimension::of(length, 0), meaning }
}

fn panel(body: &Body<'_>, quantity: &Quantity, colour: usize) -> Panel {
    let factor = body.units().factor(quantity.dimension);
    let values = body.column(quantity.name)[body.rows()].iter();
    let values = values.map(|&x| x.is_finite().then_some(x * factor)).collect();
    let label = body.units().axis(quantity);
    let colour = CATEGORIES[colour % CATEGORIES.len()];
    Panel { label: label.clone(), curves: vec![Curve { label, colour, values }] }
}
