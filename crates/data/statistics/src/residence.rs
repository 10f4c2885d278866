//! Residence times above and below a threshold.

use crate::resolution::too_far_apart;
use crate::survival::{Duration, MeanTime, mean_time};
use crate::{Quantity, Track, Tracks};
use motiform_dynamics::sample::{mean, median};
use serde::Serialize;

/// The residence of a quantity on one side of a threshold.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Side {
    /// Share of the time on this side.
    pub share: f64,
    /// The mean time of a stay; `None` if none began within the tracks.
    pub time: Option<MeanTime>,
}

/// Residence times on both sides of a threshold.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Residence {
    /// The quantity: the speed, or the size of a mode.
    pub quantity: String,
    /// The threshold.
    pub threshold: f64,
    /// At the threshold or above.
    pub above: Side,
    /// Below it.
    pub below: Side,
    /// The time between samples, where the stays depend on it: a path under noise crosses the threshold as often as it is looked at.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seen_every: Option<f64>,
}

/// Times for which the size of a quantity stays above and below a threshold (its median, if none is given).
///
/// A stay begins with a crossing of the threshold, so the first one of a unit (and after a gap) is left out; the last one is censored
/// ([`mean_time`]). Between samples the quantity is a cubic where its rates are known ([`Track::rates`]) and there is no noise
/// ([`Tracks::with_noise`]), else a line. A quantity that does not vary has none, and one that is sampled too coarsely has no mean times.
/// Under noise, stays shorter than the time between samples are not seen, and the mean time depends on that time.
///
/// # Checked by  tests/all/passage.rs: a sine, whose stays are known, seen 4 to 600 times a period
pub fn residence(tracks: &Tracks, quantity: &Quantity, threshold: Option<f64>) -> Residence {
    let sizes: Vec<Vec<f64>> = tracks.units().iter().map(|track| quantity.size(track)).collect();
    let threshold = threshold.unwrap_or_else(|| {
        median(sizes.iter().flatten().copied().filter(|x| !x.is_nan())).unwrap_or(f64::NAN)
    });
    let all = || sizes.iter().flatten().copied().filter(|x| !x.is_nan());
    let centre = mean(all()).unwrap_or(f64::NAN);
    let variance = mean(all().map(|x| (x - centre) * (x - centre))).unwrap_or(f64::NAN);
    if quantity.is_steady(tracks, variance) {
        let side = |is_here| Side { share: f64::from(u8::from(is_here)), time: None };
        let is_above = all().any(|x| x >= threshold);
        let quantity = quantity.name().to_owned();
        return Residence {
            quantity,
            threshold,
            above: side(is_above),
            below: side(!is_above),
            seen_every: None,
        };
    }
    let (mut above, mut below) = (Vec::new(), Vec::new());
    for (unit, track) in tracks.units().iter().enumerate() {
        let (series, between) = match tracks.is_smooth() {
            true => (cubics(track, quantity, tracks.dt()), tracks.dt() / POINTS as f64),
            false => (quantity.size(track), tracks.dt()),
        };
        for (is_above, steps, ended) in stays(&series, threshold) {
            let duration = Duration { time: steps * between, ended, group: tracks.group(unit) };
            if is_above { above.push(duration) } else { below.push(duration) }
        }
    }
    let share = all().filter(|&x| x >= threshold).count() as f64 / all().count() as f64;
    let coarse = too_far_apart(tracks, quantity);
    let side = |share, durations: &[Duration]| {
        let time = mean_time(durations, tracks.groups()).map(|time| time.unless(coarse.as_ref()));
        Side { share, time }
    };
    let quantity = quantity.name().to_owned();
    let seen_every = tracks.is_noisy().then(|| tracks.dt());
    Residence {
        quantity,
        threshold,
        above: side(share, &above),
        below: side(1.0 - share, &below),
        seen_every,
    }
}

/// Points of a cubic between two samples.
const POINTS: usize = 8;

/// The size of a quantity at samples and between them, by the cubics that have its rates at the samples.
fn cubics(track: &Track, quantity: &Quantity, dt: f64) -> Vec<f64> {
    let sizes = quantity.size(track);
    let (pairs, rates) = match quantity {
        Quantity::Mode(number, _) => (&track.modes[*number], &track.rates[number + 1]),
        _ => (&track.velocity, &track.rates[0]),
    };
    let slope = |k: usize| {
        let ([a, b], [f, g]) = (pairs[k], rates[k]);
        if sizes[k] == 0.0 { 0.0 } else { dt * (a * f + b * g) / sizes[k] }
    };
    let cubic = |k: usize| {
        let (rise, from, to) = (sizes[k + 1] - sizes[k], slope(k), slope(k + 1));
        let (two, three) = (3.0 * rise - 2.0 * from - to, from + to - 2.0 * rise);
        let at = move |x: f64| x * (from + x * (two + x * three));
        (0..POINTS).map(|point| sizes[k] + at(point as f64 / POINTS as f64)).collect::<Vec<_>>()
    };
    let last = sizes.len().saturating_sub(1);
    (0..last).flat_map(cubic).chain(sizes.get(last).copied()).collect()
}

/// Stays after the first crossing of each stretch without gaps: the side, the length in samples, and whether its end was seen.
fn stays(series: &[f64], threshold: f64) -> Vec<(bool, f64, bool)> {
    series.split(|x| x.is_nan()).flat_map(|stretch| stays_within(stretch, threshold)).collect()
}

fn stays_within(series: &[f64], threshold: f64) -> Vec<(bool, f64, bool)> {
    let mut found = Vec::new();
    let mut since: Option<f64> = None;
    for (place, pair) in series.windows(2).enumerate() {
        let (before, after) = (pair[0] >= threshold, pair[1] >= threshold);
        if before == after {
            continue;
        }
        let at = place as f64 + (threshold - pair[0]) / (pair[1] - pair[0]);
        if let Some(since) = since {
            found.push((before, at - since, true));
        }
        since = Some(at);
    }
    if let (Some(since), Some(&last)) = (since, series.last()) {
        found.push((last >= threshold, (series.len() - 1) as f64 - since, false));
    }
    found
}
