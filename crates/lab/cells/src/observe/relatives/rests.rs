//! Rests: stretches in which the speed is small.

use super::super::measures::{Measures, Series};
use super::Finding;
use motiform_analysis::{Rests, rests};
use motiform_dynamics::sample::{ascending, median, quantile};
use motiform_inference::Observation;
use serde::Serialize;

/// A rest is below this part of the fast speed (the 95 % quantile).
const SLOW: f64 = 0.25;
/// The same, at most, where errors of the speed ask for more; and how many errors that is.
const SLOWEST: f64 = 0.5;
const CLEAR: f64 = 3.0;

/// The rests of a record.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ObservedRests {
    /// The speed below which it rests.
    pub threshold: f64,
    /// Time over which displacements are taken: the least over which their 95 % quantile is 12 errors; at most a twentieth of the record.
    pub step: f64,
    /// Complete rests that last a step at least.
    pub count: usize,
    /// Median of their durations; `None` without any.
    pub duration: Option<f64>,
    /// Share of all samples in which the speed is below the threshold.
    pub share: f64,
    /// Median of each duration over that of the rest before: above 1 where rests grow, as near a heteroclinic cycle without noise. `None`
    /// below four rests.
    pub growth: Option<f64>,
}

pub(super) fn of(measures: &Measures) -> Finding<ObservedRests> {
    let series = &measures.series;
    let error = measures.displacement_error / std::f64::consts::SQRT_2;
    let most = (series.frames.len() / 20).max(1);
    let enough = |lag: &usize| SLOW * fast(&displacements(series, *lag)) > CLEAR * error;
    let lag = (1..=most).find(enough).unwrap_or(most);
    let moved = displacements(series, lag);
    let fast = fast(&moved);
    let fraction = SLOW.max(CLEAR * error / fast.max(f64::MIN_POSITIVE));
    if fraction > SLOWEST {
        return Finding::missing(
            "the largest displacements are within six of their errors: rests are not told from motion",
        );
    }
    let step = lag as f64 * series.dt;
    let times: Vec<f64> = (0..moved.len()).map(|k| k as f64 * series.dt).collect();
    let speeds: Vec<f64> = moved.iter().map(|size| size.min(fast) / step).collect();
    match rests(&times, &speeds, fraction) {
        Ok(found) => Finding::Found(summary(&found, &speeds, step)),
        Err(error) => Finding::missing(error.to_string()),
    }
}

fn summary(found: &Rests, speeds: &[f64], step: f64) -> ObservedRests {
    let slow = speeds.iter().filter(|speed| **speed < found.threshold).count();
    let mut durations: Vec<f64> = found.rests.iter().map(|rest| rest.duration).collect();
    durations.retain(|duration| *duration >= step);
    let ratios: Vec<f64> = durations.windows(2).map(|pair| pair[1] / pair[0]).collect();
    ObservedRests {
        threshold: found.threshold,
        step,
        count: durations.len(),
        duration: median(durations),
        share: slow as f64 / speeds.len() as f64,
        growth: if ratios.len() < 3 { None } else { median(ratios) },
    }
}

/// Lengths of the displacements over some frames.
pub(super) fn displacements(series: &Series, lag: usize) -> Vec<f64> {
    let length =
        |pair: &[Observation]| libm::hypot(pair[lag].y[0] - pair[0].y[0], pair[lag].y[1] - pair[0].y[1]);
    series.frames.windows(lag + 1).map(length).collect()
}

/// The 95 % quantile.
pub(super) fn fast(sizes: &[f64]) -> f64 {
    let mut sorted = sizes.to_vec();
    ascending(&mut sorted);
    quantile(&sorted, 0.95).unwrap_or(0.0)
}
