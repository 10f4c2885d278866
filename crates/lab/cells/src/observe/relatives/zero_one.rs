//! The 0-1 test of a record.

use super::super::measures::{Series, mean};
use super::{Finding, along_and_across};
use motiform_study::titles::number;
use serde::Serialize;

/// Fewest samples, and the seed of the frequencies.
const LEAST: usize = 200;
const SEED: u64 = 1;

/// Outcome of the 0-1 test on z2 across the motion.
///
/// K near 0: regular, with little noise. K near 1: chaos or noise; samples do not tell them apart.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ObservedChaos {
    /// K, the median over the frequencies.
    pub k: f64,
    /// A quarter lies below.
    pub lower: f64,
    /// A quarter lies above.
    pub upper: f64,
    /// Time between the samples used: the first lag at which the autocorrelation is not positive.
    pub interval: f64,
    /// Their number.
    pub samples: usize,
}

pub(super) fn of(series: &Series) -> Finding<ObservedChaos> {
    let values: Vec<f64> = along_and_across(series).iter().map(|z| z[1]).collect();
    let centre = mean(values.iter().copied());
    let product =
        |lag: usize| values.iter().zip(&values[lag..]).map(|(a, b)| (a - centre) * (b - centre)).sum::<f64>();
    let Some(lag) = (1..values.len() / 2).find(|&lag| product(lag) <= 0.0) else {
        return Finding::missing("the shape stays correlated over half of the record");
    };
    let samples: Vec<f64> = values.iter().copied().step_by(lag).collect();
    let interval = lag as f64 * series.dt;
    if samples.len() < LEAST {
        return Finding::missing(format!(
            "{} samples, {} {unit} apart, are too few: {LEAST} are needed, which a record of {} {unit} has",
            samples.len(),
            number(interval),
            number(interval * LEAST as f64),
            unit = series.unit
        ));
    }
    match motiform_analysis::zero_one(&samples, SEED) {
        Ok(found) => {
            let motiform_analysis::ZeroOne { k, lower, upper } = found;
            Finding::Found(ObservedChaos { k, lower, upper, interval, samples: samples.len() })
        }
        Err(error) => Finding::missing(error.to_string()),
    }
}
