//! The summary: one JSON object, and sentences.

use crate::statistics::Measurement;
use motiform_statistics::{
    Answer, Diffusion, Errors, MeanTime, Measured, Oscillation, Side, Walk, four_digits, with_interval,
};
use motiform_study::{Dimension, Shown};
use serde_json::{Value, json};

/// Everything that is not a curve, as one JSON object. A number that is not known is `{"reason": ...}`.
pub fn summary(measurement: &Measurement) -> Value {
    let found = &measurement.statistics;
    let times: serde_json::Map<String, Value> = found
        .autocorrelations
        .iter()
        .map(|entry| {
            let value = json!({ "correlation_time": entry.time, "oscillation": entry.oscillation, "variance": entry.variance });
            (entry.quantity.name().to_owned(), value)
        })
        .collect();
    let turning: Vec<Value> = found
        .turning
        .iter()
        .map(|entry| {
            json!({
                "lag": entry.lag,
                "pairs": entry.angles.samples,
                "independent": entry.angles.independent,
                "at_rest": entry.at_rest,
            })
        })
        .collect();
    json!({
        "title": measurement.title,
        "bodies": found.bodies,
        "samples": found.samples,
        "dt": found.dt,
        "errors": found.errors,
        "not_stationary": found.not_stationary,
        "unlike_bodies": found.unlike_bodies,
        "no_intervals": found.no_intervals,
        "complete": measurement.complete,
        "notes": measurement.notes,
        "mean_speed": found.mean_speed,
        "rms_speed": found.rms_speed,
        "persistent_walk": found.walk,
        "diffusion": found.diffusion,
        "exponents": { "shortest_lag": found.exponents[0], "last_octave": found.exponents[1] },
        "autocorrelations": times,
        "turning_angles": turning,
        "first_passage": found.passages,
        "residence": found.residence,
        "seeds": measurement.seeds,
        "source": measurement.source,
    })
}

/// Label and text of each result in these units, for people.
pub fn sentences(measurement: &Measurement, units: &Shown) -> Vec<(&'static str, String)> {
    let answer = |dimension, found: &Answer| answer_in(units, dimension, found);
    let value = |dimension, found: &Measured| value_in(units, dimension, found);
    let four = |dimension, number: f64| {
        format!("{}{}", four_digits(number * units.factor(dimension)), unit(units, dimension))
    };
    let found = &measurement.statistics;
    let [shortest, longest] = found.samples;
    let samples = if shortest == longest { longest.to_string() } else { format!("{shortest} to {longest}") };
    let bodies = if found.bodies == 1 { "body" } else { "bodies" };
    let mut all = vec![(
        "bodies",
        format!(
            "{} {bodies}, {samples} samples every {}; {}",
            found.bodies,
            if units.is_physical() { four(Dimension::TIME, found.dt) } else { found.dt.to_string() },
            found
                .no_intervals
                .as_ref()
                .map_or_else(|| over(found.errors), |why| format!("no intervals: {why}"))
        ),
    )];
    let of_model = if units.is_physical() { " (numbers in model units)" } else { "" };
    let doubt = |why: &String| {
        ("", format!("not stationary: {why}{of_model}. The numbers below are those of these records"))
    };
    all.extend(found.not_stationary.iter().map(doubt));
    all.extend(found.unlike_bodies.iter().map(|why| ("", format!("{why}{of_model}"))));
    let [mean, rms] = [&found.mean_speed, &found.rms_speed].map(|speed| value(Dimension::SPEED, speed));
    all.push(("speed", format!("mean {mean}, root mean square {rms}")));
    all.extend(walk(&found.walk, &answer));
    all.extend(diffusion(&found.diffusion, units));
    all.extend([
        ("exponent", format!("{} at the shortest lag", answer(Dimension::NUMBER, &found.exponents[0]))),
        ("", format!("{} over the last octave of lags", answer(Dimension::NUMBER, &found.exponents[1]))),
    ]);
    for (place, entry) in found.autocorrelations.iter().enumerate() {
        let (label, name) = (if place == 0 { "correlation" } else { "" }, entry.quantity.name());
        all.push((label, format!("time of {name}: {}", answer(Dimension::TIME, &entry.time))));
        all.extend(
            entry
                .oscillation
                .iter()
                .map(|found| ("", format!("{name} oscillates: {}", oscillation(found, units)))),
        );
    }
    for (place, passage) in found.passages.iter().enumerate() {
        let label = if place == 0 { "leaves" } else { "" };
        all.push((
            label,
            format!(
                "a disc of radius {} after {}",
                four(Dimension::LENGTH, passage.radius),
                mean_time(&passage.time, units)
            ),
        ));
    }
    let residence = &found.residence;
    let threshold = if residence.quantity == "speed" {
        four(Dimension::SPEED, residence.threshold)
    } else {
        format!(
            "{}{}",
            four_digits(residence.threshold),
            if units.is_physical() { " (model units)" } else { "" }
        )
    };
    let side = |words: &str, side: &Side| {
        let stays = side.time.as_ref().map_or_else(
            || "no stay: it does not vary, or crosses the threshold nowhere".to_owned(),
            |time| mean_time(time, units),
        );
        format!(
            "{} {words} {} for {stays} ({:.1} % of the time)",
            residence.quantity,
            threshold,
            100.0 * side.share
        )
    };
    all.push(("stays", side("at or above", &residence.above)));
    all.push(("", side("below", &residence.below)));
    let depends = |every: f64| {
        let every = four(Dimension::TIME, every);
        let why = "under noise a path crosses a threshold the more often the more often it is seen";
        ("", format!("of samples every {every}, on which stays depend: {why}"))
    };
    all.extend(residence.seen_every.map(depends));
    all
}

/// Half widths of a 95 % interval that are three standard errors.
const CHANCE: f64 = 1.5;

/// The persistent random walk; a reason that several of its numbers share is said once.
fn walk(found: &Walk, answer: &impl Fn(Dimension, &Answer) -> String) -> Vec<(&'static str, String)> {
    let shared = |other: &Answer| other.reason().is_some() && other.reason() == found.persistence.reason();
    let time = answer(Dimension::TIME, &found.persistence);
    let mut all = match shared(&found.speed) {
        true => vec![("persistence", format!("time and speed {time}"))],
        false => vec![
            ("persistence", format!("time {time}")),
            ("", format!("speed {}", answer(Dimension::SPEED, &found.speed))),
        ],
    };
    let deviation = 100.0 * found.deviation;
    let words = "the displacements deviate from a persistent random walk by";
    all.push(("", format!("{words} {deviation:.1} % (root mean square)")));
    let diffusion = match shared(&found.diffusion) {
        true => "unknown".to_owned(),
        false => answer(Dimension::DIFFUSION, &found.diffusion),
    };
    all.push(("diffusion", format!("by the persistent random walk: {diffusion}")));
    all
}

fn diffusion(found: &Diffusion, units: &Shown) -> Vec<(&'static str, String)> {
    let answer = |found: &Answer| answer_in(units, Dimension::DIFFUSION, found);
    let mut all = vec![
        ("", format!("by velocities (Green-Kubo): {}", answer(&found.green_kubo))),
        ("", format!("by displacements (slope): {}", answer(&found.displacements))),
    ];
    all.extend(found.difference.iter().map(|difference| {
        let agree = difference.value.abs() <= CHANCE * difference.half_width();
        let meaning = if agree {
            "they agree within three standard errors"
        } else {
            "sampled coarsely, or motion that is not in the velocity"
        };
        (
            "",
            format!(
                "velocities less displacements {}: {meaning}",
                value_in(units, Dimension::DIFFUSION, difference)
            ),
        )
    }));
    all.extend(found.doubt.iter().map(|doubt| ("", format!("in doubt: {doubt}"))));
    all
}

fn oscillation(found: &Oscillation, units: &Shown) -> String {
    match (&found.frequency, &found.decay) {
        (Answer::Unknown { reason }, _) => reason.clone(),
        (frequency, decay) => format!(
            "{} cycles per {}, decays in {} (damped cosine; deviation {:.0} %)",
            answer(&times(frequency, units.factor(Dimension::RATE))),
            plain(&units.name(Dimension::TIME, "time")),
            answer_in(units, Dimension::TIME, decay),
            100.0 * found.deviation
        ),
    }
}

fn over(errors: Errors) -> String {
    match errors {
        Errors::Bodies { .. } => "95 % intervals over bodies".to_owned(),
        Errors::Blocks { count, samples } => {
            format!("95 % intervals over {count} blocks of the tracks, of {samples} samples or more")
        }
    }
}

fn mean_time(time: &MeanTime, units: &Shown) -> String {
    let censored = format!("{:.1} % of {} not watched to the end", 100.0 * time.censored, time.count);
    format!("{}, {censored}", answer_in(units, Dimension::TIME, &time.mean))
}

/// A space and the name of the unit, as a terminal shows it; nothing in model units.
fn unit(units: &Shown, dimension: Dimension) -> String {
    let name = plain(&units.name(dimension, ""));
    if name.is_empty() { name } else { format!(" {name}") }
}

fn plain(markup: &str) -> String {
    motiform_figures::Label::parse(markup).terminal()
}

fn answer_in(units: &Shown, dimension: Dimension, found: &Answer) -> String {
    match found {
        Answer::Known(measured) => value_in(units, dimension, measured),
        Answer::Unknown { reason }
            if units.is_physical() && reason.contains(|c: char| c.is_ascii_digit()) =>
        {
            format!("{} (numbers in model units)", answer(found))
        }
        Answer::Unknown { .. } => answer(found),
    }
}

fn times(found: &Answer, factor: f64) -> Answer {
    match found {
        Answer::Known(measured) => Answer::Known(scaled(measured, factor)),
        Answer::Unknown { .. } => found.clone(),
    }
}

fn scaled(measured: &Measured, factor: f64) -> Measured {
    Measured {
        value: factor * measured.value,
        interval: measured.interval.map(|ends| ends.map(|end| factor * end)),
    }
}

/// [`value`] of a number of the model, in these units, with its unit.
pub(crate) fn value_in(units: &Shown, dimension: Dimension, measured: &Measured) -> String {
    format!("{}{}", value(&scaled(measured, units.factor(dimension))), unit(units, dimension))
}

fn answer(answer: &Answer) -> String {
    match answer {
        Answer::Known(measured) => value(measured),
        Answer::Unknown { reason } => format!("unknown: {reason}"),
    }
}

/// `2.013 (1.95 to 2.08)`: the digits that the interval leaves.
pub(crate) fn value(measured: &Measured) -> String {
    match measured.interval {
        Some(ends) => with_interval(measured.value, ends),
        None => format!("{} (no interval)", four_digits(measured.value)),
    }
}
