//! Speed, turning rate and the sizes of the deformations against time.

use super::body::{Body, RATE, TIME};
use super::words;
use crate::varying::varies;
use motiform_figures::palette::CATEGORIES;
use motiform_figures::{Curve, Panel, SeriesFigure};
use motiform_study::Dimension;

/// An observable below this throughout is not drawn but mentioned.
const NEGLIGIBLE: f64 = 1e-9;

pub(super) fn figure(body: &Body<'_>) -> SeriesFigure {
    let mut notes = Vec::new();
    let mut panels = vec![panel(body, ("speed", "speed |***v***|", [1, -1]), 0)];
    let turning = panel(body, ("turning_rate", "turning rate", RATE), 1);
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
            panels.push(panel(body, (observable.name, observable.symbol, [observable.length, 0]), 2 + index));
        }
    }
    measures(body, &mut panels, &mut notes);
    SeriesFigure {
        title: body.dataset.title(),
        time_label: body.label("*t*", TIME),
        times: body.rows().map(|row| body.time(row)).collect(),
        panels,
        notes,
        caption: words::about(body),
    }
}

/// The measures of the boundary: those that vary as panels, constant ones as notes.
fn measures(body: &Body<'_>, panels: &mut Vec<Panel>, notes: &mut Vec<String>) {
    for measure in body.model.measures() {
        let shown = &body.column(measure.name)[body.rows()];
        let high = shown.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if varies(shown.iter().copied(), 1.0) {
            panels.push(panel(body, (measure.name, measure.symbol, [measure.length, 0]), 2 + panels.len()));
        } else if shown.iter().all(|x| x.is_nan() || *x == 0.0) {
            notes.push(format!("The {} is 0 throughout.", measure.symbol));
        } else if high > 1e-9 {
            notes.push(format!(
                "The {} stays at {}.",
                measure.symbol,
                body.words(high, [measure.length, 0], "")
            ));
        } else {
            notes.push(format!("The {} stays below {}.", measure.symbol, words::number(NEGLIGIBLE)));
        }
    }
}

fn panel(body: &Body<'_>, (name, symbol, dimension): (&str, &str, Dimension), colour: usize) -> Panel {
    let factor = body.factor(dimension);
    let values =
        body.column(name)[body.rows()].iter().map(|&x| x.is_finite().then_some(x * factor)).collect();
    let label = body.label(symbol, dimension);
    let colour = CATEGORIES[colour % CATEGORIES.len()];
    Panel { label: label.clone(), curves: vec![Curve { label, colour, values }] }
}
