//! Bodies held against each other: one motion, or several.

use crate::{Quantity, Tracks, four_digits};

/// Parts of equal length of each body's record.
const PARTS: usize = 10;

/// Mean square of the differences between bodies over that within their records, above which bodies are unlike: of independent parts it is
/// 1, and of a motion that forgets in a tenth, a quarter and all of the record about 3, 8 and 30.
const CLEAR: f64 = 25.0;

/// Smallest difference that matters, as a part of the quantity.
const LEAST: f64 = 1e-3;

/// Why the bodies are not of one motion: the mean speed, or the mean size of a mode, of each body over its record differs far more between
/// bodies than between the parts of one record (analysis of variance; each part with the weight of its samples). `None` where they do not.
///
/// # Checked by  tests/all/stationary.rs: circles of two sizes, one size, Ornstein-Uhlenbeck velocities
pub(crate) fn unlike(tracks: &Tracks) -> Option<String> {
    let sizes =
        tracks.quantities().into_iter().filter(|q| !matches!(q, Quantity::Velocity | Quantity::Heading));
    sizes.into_iter().find_map(|quantity| differing(tracks, &quantity))
}

fn differing(tracks: &Tracks, quantity: &Quantity) -> Option<String> {
    let records: Vec<Vec<[f64; 2]>> =
        tracks.bodies().iter().map(|track| parts(&quantity.size(track))).collect();
    let mean = |parts: &[[f64; 2]]| {
        let count: f64 = parts.iter().map(|part| part[1]).sum();
        [parts.iter().map(|part| part[0] * part[1]).sum::<f64>() / count, count]
    };
    let means: Vec<[f64; 2]> = records.iter().map(|parts| mean(parts)).filter(|mean| mean[1] > 0.0).collect();
    let [all, count] = mean(&means);
    let about = |[value, weight]: &[f64; 2], centre: f64| weight * (value - centre) * (value - centre);
    let between: f64 = means.iter().map(|body| about(body, all)).sum();
    let within: f64 =
        records.iter().map(|parts| parts.iter().map(|part| about(part, mean(parts)[0])).sum::<f64>()).sum();
    let freedom = [means.len().saturating_sub(1), (PARTS - 1) * means.len()].map(|n| n as f64);
    let is_clear = between * freedom[1] > CLEAR * within * freedom[0];
    let matters = (between / count).sqrt() > LEAST * all;
    let [least, most] = means.iter().fold([f64::INFINITY, 0.0], |[a, b], [x, _]| [x.min(a), x.max(b)]);
    (freedom[0] > 0.0 && is_clear && matters).then(|| {
        format!(
            "bodies differ over their whole records, far more than one body in the course of time (the mean {} is {} to {}): their motions \
             are different ones, or the records are shorter than their memory",
            match quantity {
                Quantity::Speed => "speed".to_owned(),
                other => format!("size of {}", other.name()),
            },
            four_digits(least),
            four_digits(most)
        )
    })
}

/// Mean and number of the values of each part.
fn parts(sizes: &[f64]) -> Vec<[f64; 2]> {
    let edge = |number: usize| number * sizes.len() / PARTS;
    let part = |number: usize| {
        let there = || sizes[edge(number)..edge(number + 1)].iter().filter(|size| !size.is_nan());
        let count = there().count() as f64;
        [there().sum::<f64>() / count.max(1.0), count]
    };
    (0..PARTS).map(part).collect()
}
