//! Speed, turning rate and the sizes of the deformations against time.

use super::body::Body;
use super::words;
use crate::readings::turns;
use motiform_dynamics::model::Observable;
use motiform_figures::palette::CATEGORIES;
use motiform_figures::{Curve, Panel, SeriesFigure};
use motiform_study::quantity::state::{SPEED, T, TURNING_RATE};
use motiform_study::{Dimension, Quantity};

pub(super) fn figure(body: &Body<'_>) -> SeriesFigure {
    let mut notes: Vec<String> = words::rest(body).into_iter().collect();
    let mut panels = vec![panel(body, &SPEED, 0)];
    turning(body, &mut panels, &mut notes);
    for (index, observable) in body.model.observables().iter().enumerate() {
        let quantity = declared(observable);
        let largest = largest(body, &quantity);
        if largest < body.accuracy.least(0.0) {
            notes.push(format!("{} {}.", observable.symbol, below(body, &quantity, largest)));
        } else {
            panels.push(panel(body, &quantity, 2 + index));
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

/// The panel of the turning rate, and a note where it is undefined; the note alone where it is undefined throughout.
fn turning(body: &Body<'_>, panels: &mut Vec<Panel>, notes: &mut Vec<String>) {
    let why = if body.rests.is_some() {
        "The turning rate is undefined: the centre rests."
    } else if !turns(body.model.as_ref(), &body.dataset.manifest.plan.computation) {
        "The turning rate is undefined: noise leaves the velocity no derivative."
    } else {
        let turning = without_rounding(panel(body, &TURNING_RATE, 1), body);
        let undefined = turning.curves[0].values.iter().any(Option::is_none);
        panels.push(turning);
        if !undefined {
            return;
        }
        "The turning rate is undefined where the body is at rest."
    };
    notes.push(why.to_owned());
}

/// The rates as 0 where all together turn by less than the error of the heading (rad) in the time that is shown: a straight way, whose
/// rates are errors alone.
fn without_rounding(mut panel: Panel, body: &Body<'_>) -> Panel {
    let shown = body.rows();
    let times = &body.column(T.name)[shown];
    let time = times.last().zip(times.first()).map_or(0.0, |(last, first)| last - first);
    if largest(body, &TURNING_RATE) * time < body.known_velocity() {
        let values = panel.curves.iter_mut().flat_map(|curve| &mut curve.values);
        values.flatten().for_each(|rate| *rate = 0.0);
    }
    panel
}

/// `stays below 10^-9`: the size from which it is known not to be 0; or that it is 0.
fn below(body: &Body<'_>, quantity: &Quantity, largest: f64) -> String {
    if largest == 0.0 {
        return "is 0 throughout".to_owned();
    }
    format!("stays below {}", body.units().words(body.accuracy.least(0.0), quantity.dimension, ""))
}

/// The largest size of a quantity while it is shown (model units).
fn largest(body: &Body<'_>, quantity: &Quantity) -> f64 {
    let shown = body.column(quantity.name)[body.rows()].iter();
    shown.filter(|x| x.is_finite()).fold(0.0, |most, x| most.max(x.abs()))
}

/// The measures of the boundary: those that vary as panels, constant ones as notes.
fn measures(body: &Body<'_>, panels: &mut Vec<Panel>, notes: &mut Vec<String>) {
    for measure in body.model.measures() {
        let shown = &body.column(measure.name)[body.rows()];
        let quantity = declared(measure);
        let high = shown.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if body.accuracy.varies(shown.iter().copied()) {
            panels.push(panel(body, &quantity, 2 + panels.len()));
        } else if high > body.accuracy.least(0.0) {
            notes.push(format!(
                "The {} stays at {}.",
                measure.symbol,
                body.units().words(high, quantity.dimension, "")
            ));
        } else {
            notes.push(format!(
                "The {} {}.",
                measure.symbol,
                below(body, &quantity, largest(body, &quantity))
            ));
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
    Panel {
        label: label.clone(),
        curves: vec![Curve { label, colour, values }],
        least: factor * least(body, quantity),
    }
}

/// The least difference of a quantity that is known (model units); those of the motion have that of the velocity.
fn least(body: &Body<'_>, quantity: &Quantity) -> f64 {
    let largest = largest(body, quantity);
    let of_motion = [&SPEED, &TURNING_RATE].contains(&quantity);
    if of_motion { body.known_velocity() * largest } else { body.accuracy.least(largest) }
}
