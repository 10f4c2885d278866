//! Coefficients over all sets of terms that the data do not tell apart.

use super::{Conditional, Subsets};
use crate::Fit;
use serde::{Deserialize, Serialize};

/// A coefficient over the tied sets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Averaged {
    /// The term's name; an imaginary part begins with `i`.
    pub name: String,
    /// The mean of the mixture, in the units of the data.
    pub value: f64,
    /// 2.5 % and 97.5 % quantiles of the mixture of the normal distributions of all sets, each with the term.
    pub interval: [f64; 2],
    /// Weight of the sets that have it, 0 to 1; 0: no set asks for it, and the interval says how large it may be.
    pub weight: f64,
}

/// Weight, mean and standard deviation of a set's coefficient.
type Part = [f64; 3];

/// The coefficients of all terms over the sets within [`super::TIE`] of the best, each set with the weight
/// `exp(-excess/2)`, the term itself, and the estimates and errors that these have from the fit with all
/// terms, the others set to 0 (no set is fitted again).
///
/// A set that is dropped by a hair still counts: errors of the best set alone leave its choice out, and are
/// too small. That a set does without the term is no evidence that it is 0: a term of two standard errors is
/// dropped, and may be what it is estimated to be. So its interval is what the data say of it beside the
/// others of the set.
///
/// Source: Schwarz's criterion as a weight: Raftery (1995), Sociol. Methodol. 25, 111; Hoeting et al. (1999),
/// Stat. Sci. 14, 382; without the part at 0: Burnham and Anderson (2002), sec. 4.2.
///
/// # Units   of the data
/// # Checked by  tests/all/average.rs: one set, sets that differ, zigzags whose best set lacks a term
#[must_use]
pub fn averaged(whole: &Fit, subsets: &Subsets) -> Vec<Averaged> {
    let all = whole.coefficients.len();
    let total: f64 = subsets.ties.iter().map(|set| libm::exp(-0.5 * set.excess)).sum();
    let full = Conditional::new(&whole.natural.coefficients, whole.covariance());
    let mut parts: Vec<Vec<Part>> = vec![Vec::new(); all];
    let mut weights = vec![0.0; all];
    for set in &subsets.ties {
        let weight = libm::exp(-0.5 * set.excess) / total;
        let without = full.without((0..all).filter(|i| !set.kept.contains(i)));
        for (i, parts) in parts.iter_mut().enumerate() {
            let kept = set.kept.contains(&i);
            weights[i] += if kept { weight } else { 0.0 };
            let own = if kept {
                without.of(&[i])
            } else {
                full.without((0..all).filter(|k| *k != i && !set.kept.contains(k))).of(&[i])
            };
            parts.push([weight, own.estimates[0], own.covariance[(0, 0)].max(0.0).sqrt()]);
        }
    }
    let one = |i: usize| {
        let (coefficient, parts) = (&whole.coefficients[i], &parts[i]);
        let unit = whole.scales.coefficient(&coefficient.term);
        let ends = [0.025, 0.975].map(|share| unit * quantile(parts, share));
        Averaged {
            name: format!("{}{}", if coefficient.imaginary { "i " } else { "" }, coefficient.name),
            value: unit * parts.iter().map(|[w, m, _]| w * m).sum::<f64>(),
            interval: [ends[0].min(ends[1]), ends[0].max(ends[1])],
            weight: weights[i],
        }
    };
    (0..all).map(one).collect()
}

/// Quantile of a mixture of normal distributions, by bisection.
fn quantile(parts: &[Part], share: f64) -> f64 {
    let below = |x: f64| -> f64 {
        let normal = |[w, m, s]: &Part| {
            let step = if x >= *m { 1.0 } else { 0.0 };
            w * if *s > 0.0 { 0.5 * libm::erfc((m - x) / (s * std::f64::consts::SQRT_2)) } else { step }
        };
        parts.iter().map(normal).sum()
    };
    let end = |sign: f64| parts.iter().map(|[_, m, s]| sign * m + 10.0 * s).fold(f64::NEG_INFINITY, f64::max);
    let (mut low, mut high) = (-end(-1.0), end(1.0));
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if below(middle) < share { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}
