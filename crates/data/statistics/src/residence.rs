//! Residence times above and below a threshold.

use crate::survival::{Duration, MeanTime, mean_time};
use crate::{Quantity, Tracks};
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
}

/// Times for which the size of a quantity stays above and below a threshold (its median, if none is given).
///
/// A stay begins with a crossing of the threshold, located by linear interpolation, so the first one of a
/// unit (and after a gap) is left out; the last one is censored ([`mean_time`]). A quantity that does not vary has none. Under noise, stays
/// shorter than the time between samples are not seen, and the mean time depends on that time.
///
/// # Checked by  tests/all/passage.rs: a sine, whose stays are known
#[must_use]
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
        return Residence { quantity, threshold, above: side(is_above), below: side(!is_above) };
    }
    let (mut above, mut below) = (Vec::new(), Vec::new());
    for (unit, series) in sizes.iter().enumerate() {
        for (is_above, steps, ended) in stays(series, threshold) {
            let duration = Duration { time: steps * tracks.dt(), ended, group: tracks.group(unit) };
            if is_above { above.push(duration) } else { below.push(duration) }
        }
    }
    let share = all().filter(|&x| x >= threshold).count() as f64 / all().count() as f64;
    let side = |share, durations: &[Duration]| Side { share, time: mean_time(durations, tracks.groups()) };
    let quantity = quantity.name().to_owned();
    Residence { quantity, threshold, above: side(share, &above), below: side(1.0 - share, &below) }
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
