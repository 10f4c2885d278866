//! The summary: one JSON object, and sentences.

use crate::statistics::Measurement;
use motiform_statistics::{Answer, Diffusion, Errors, MeanTime, Measured, Oscillation, Side, four_digits};
use serde_json::{Value, json};

/// Everything that is not a curve, as one JSON object. A number that is not known is `{"reason": ...}`.
#[must_use]
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
        .map(|entry| json!({ "lag": entry.lag, "pairs": entry.angles.samples, "independent": entry.angles.independent, "at_rest": entry.at_rest }))
        .collect();
    json!({
        "title": measurement.title,
        "bodies": found.bodies,
        "samples": found.samples,
        "dt": found.dt,
        "errors": found.errors,
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

/// Label and text of each result, for people.
#[must_use]
pub fn sentences(measurement: &Measurement) -> Vec<(&'static str, String)> {
    let found = &measurement.statistics;
    let [shortest, longest] = found.samples;
    let samples = if shortest == longest { longest.to_string() } else { format!("{shortest} to {longest}") };
    let bodies = if found.bodies == 1 { "body" } else { "bodies" };
    let mut all = vec![
        (
            "bodies",
            format!(
                "{} {bodies}, {samples} samples every {}; {}",
                found.bodies,
                found.dt,
                over(found.errors)
            ),
        ),
        ("speed", format!("mean {}, root mean square {}", value(&found.mean_speed), value(&found.rms_speed))),
        ("persistence", format!("time {}", answer(&found.walk.persistence))),
        ("", format!("speed {}", answer(&found.walk.speed))),
        (
            "",
            format!(
                "the displacements deviate from a persistent random walk by {:.1} % (root mean square)",
                100.0 * found.walk.deviation
            ),
        ),
        ("diffusion", format!("coefficient {} (persistent random walk)", answer(&found.walk.diffusion))),
    ];
    all.extend(diffusion(&found.diffusion));
    all.extend([
        ("exponent", format!("{} at the shortest lag", answer(&found.exponents[0]))),
        ("", format!("{} over the last octave of lags", answer(&found.exponents[1]))),
    ]);
    for (place, entry) in found.autocorrelations.iter().enumerate() {
        let (label, name) = (if place == 0 { "correlation" } else { "" }, entry.quantity.name());
        all.push((label, format!("time of {name}: {}", answer(&entry.time))));
        all.extend(
            entry.oscillation.iter().map(|found| ("", format!("{name} oscillates: {}", oscillation(found)))),
        );
    }
    for (place, passage) in found.passages.iter().enumerate() {
        let label = if place == 0 { "leaves" } else { "" };
        all.push((
            label,
            format!("a disc of radius {} after {}", four_digits(passage.radius), mean_time(&passage.time)),
        ));
    }
    let residence = &found.residence;
    let side = |words: &str, side: &Side| {
        let stays = side.time.as_ref().map_or_else(|| "no stay was seen".to_owned(), mean_time);
        format!(
            "{} {words} {} for {stays} ({:.1} % of the time)",
            residence.quantity,
            four_digits(residence.threshold),
            100.0 * side.share
        )
    };
    all.push(("stays", side("at or above", &residence.above)));
    all.push(("", side("below", &residence.below)));
    all
}

/// Half widths of a 95 % interval that are three standard errors.
const CHANCE: f64 = 1.5;

fn diffusion(found: &Diffusion) -> Vec<(&'static str, String)> {
    let mut all = vec![
        ("", format!("coefficient {} (velocities: Green-Kubo)", answer(&found.green_kubo))),
        ("", format!("coefficient {} (displacements: slope)", answer(&found.displacements))),
    ];
    all.extend(found.difference.iter().map(|difference| {
        let agree = difference.value.abs() <= CHANCE * difference.half_width();
        let meaning =
            if agree { "they agree" } else { "sampled coarsely, or motion that is not in the velocity" };
        ("", format!("velocities less displacements {}: {meaning}", value(difference)))
    }));
    all
}

fn oscillation(found: &Oscillation) -> String {
    match (&found.frequency, &found.decay) {
        (Answer::Unknown { reason }, _) => reason.clone(),
        (frequency, decay) => format!(
            "{} cycles per time, decays in {} (damped cosine; deviation {:.0} %)",
            answer(frequency),
            answer(decay),
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

fn mean_time(time: &MeanTime) -> String {
    let censored = format!("{:.1} % of {} not watched to the end", 100.0 * time.censored, time.count);
    match &time.mean {
        Answer::Known(mean) => format!("{}, {censored}", value(mean)),
        Answer::Unknown { reason } => format!("unknown: {reason}, {censored}"),
    }
}

fn answer(answer: &Answer) -> String {
    match answer {
        Answer::Known(measured) => value(measured),
        Answer::Unknown { reason } => format!("unknown: {reason}"),
    }
}

/// `2.013 (1.95 to 2.08)`: the digits that the interval leaves.
pub(crate) fn value(measured: &Measured) -> String {
    let digits = |x: f64| {
        let width = measured.half_width().max(1e-6 * x.abs()).max(1e-300);
        let places = (1.0 - width.log10().floor()).clamp(0.0, 12.0) as usize;
        if x != 0.0 && !(1e-4..1e6).contains(&x.abs()) { format!("{x:.3e}") } else { format!("{x:.places$}") }
    };
    match measured.interval {
        Some([lower, upper]) => {
            format!("{} ({} to {})", digits(measured.value), digits(lower), digits(upper))
        }
        None => format!("{} (no interval)", digits(measured.value)),
    }
}
