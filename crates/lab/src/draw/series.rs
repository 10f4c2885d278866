//! Speed, turning rate and the sizes of the deformations against time.

use super::body::Body;
use super::words;
use motiform_figures::palette::CATEGORIES;
use motiform_figures::{Curve, Panel, SeriesFigure};

/// An observable below this throughout is not drawn but mentioned.
const NEGLIGIBLE: f64 = 1e-9;

/// A measure that varies by less than this fraction of itself is steady.
const STEADY: f64 = 1e-6;

pub(super) fn figure(body: &Body<'_>) -> SeriesFigure {
    let mut notes = Vec::new();
    let mut panels = vec![panel(body, "speed", "speed |***v***|", 0)];
    let turning = panel(body, "turning_rate", "turning rate", 1);
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
            panels.push(panel(body, observable.name, observable.symbol, 2 + index));
        }
    }
    measures(body, &mut panels, &mut notes);
    SeriesFigure {
        title: body.dataset.title(),
        times: body.column("t")[body.rows()].to_vec(),
        panels,
        notes,
        caption: vec![words::parameters(body), words::method(body)],
        ..SeriesFigure::default()
    }
}

/// The measures of the boundary: those that vary as panels, constant ones as notes.
fn measures(body: &Body<'_>, panels: &mut Vec<Panel>, notes: &mut Vec<String>) {
    for measure in body.model.measures() {
        let shown = &body.column(measure.name)[body.rows()];
        let defined = shown.iter().filter(|x| !x.is_nan());
        let (low, high) = defined.fold((f64::MAX, f64::MIN), |(low, high), &x| (low.min(x), high.max(x)));
        if high - low > STEADY * high.abs().max(1e-6) {
            panels.push(panel(body, measure.name, measure.symbol, 2 + panels.len()));
        } else if low == 0.0 && high == 0.0 {
            notes.push(format!("The {} is 0 throughout.", measure.symbol));
        } else if high > 1e-9 {
            notes.push(format!("The {} stays at {}.", measure.symbol, words::number(high)));
        } else {
            notes.push(format!("The {} stays below {}.", measure.symbol, words::number(NEGLIGIBLE)));
        }
    }
}

fn panel(body: &Body<'_>, name: &str, label: &str, colour: usize) -> Panel {
    let values = body.column(name)[body.rows()].iter().map(|&x| x.is_finite().then_some(x)).collect();
    let colour = CATEGORIES[colour % CATEGORIES.len()];
    Panel { label: label.to_owned(), curves: vec![Curve { label: label.to_owned(), colour, values }] }
}
