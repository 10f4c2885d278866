//! Coefficients over all sets of terms that the data do not tell apart.

use super::mixture::{Mixture, Scatter};
use super::{Conditional, Subsets};
use crate::Fit;
use serde::{Deserialize, Serialize};

/// Part of the distribution beyond one end of an interval of 95 %.
const TAIL: f64 = 0.025;
/// The price of a term that a set may do without, in twice the log-likelihood: Akaike's. With that of the sets, `ln(6 N)`, a term of two
/// errors that is dropped would have no part in the interval of the one that takes its place.
const PRICE: f64 = 2.0;

/// A coefficient over the tied sets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Averaged {
    /// The term's name; an imaginary part begins with `i`.
    pub name: String,
    /// The mean of the mixture, in the units of the data.
    pub value: f64,
    /// 2.5 % and 97.5 % quantiles of the mixture of the normal distributions of all sets, each with the term; reaching to 0 where sets
    /// without the term have more than 2.5 % of the weight.
    pub interval: [f64; 2],
    /// Weight of the sets that have it, 0 to 1; 0: no set asks for it, and the interval says how large it may be.
    pub weight: f64,
}

/// The coefficients of all terms over the sets within [`super::TIE`] of the best, each set with the weight
/// `exp(-excess/2)`, the term itself, and the estimates and errors that these have from the fit with all
/// terms, the others set to 0 (no set is fitted again).
///
/// A set that is dropped by a hair still counts: errors of the best set alone leave its choice out, and are
/// too small. That a set does without the term is no evidence that it is 0: a term of two standard errors is
/// dropped, and may be what it is estimated to be. So its interval is what the data say of it beside the
/// others of the set.
///
/// Nor is it evidence of what the others are: where two terms are nearly collinear, the error of one without the other is far too small
/// (in short zigzags `z3: z1 z2` without `z3: z1^3` is a quarter off). So each set counts beside its extensions by one more
/// term of the coefficient's equation, with the weight `exp((gain - 2)/2)` of Akaike's criterion relative to its own.
///
/// Where the sets without a term have more than a tail of the weight, 0 is among what the data allow, and the interval reaches to it. A
/// term is listed because its estimate is large beside its error: of terms that are 0, intervals which leave that selection out hold the
/// truth in 81 % of cases only, since each of them is listed from 1.2 errors on, and 0 is outside from 1.96 errors on.
///
/// The error of a set is the larger one of the expected and the robust one: errors with
/// heavy tails raise the robust one, and in short records either may be too small by chance. Of several cells that between them counts, too
/// ([`Fit::with_cells`]).
///
/// Source: Schwarz's criterion as a weight: Raftery (1995), Sociol. Methodol. 25, 111; Hoeting et al. (1999),
/// Stat. Sci. 14, 382; without the part at 0, and Akaike's weights: Burnham and Anderson (2002), sec. 2.9, 4.2.
///
/// # Units   of the data
/// # Checked by  tests/all/average.rs: one set, sets that differ, zigzags whose best set lacks a term
pub fn averaged(whole: &Fit, subsets: &Subsets) -> Vec<Averaged> {
    let scatter = Scatter::of(whole);
    let parts = parts(whole, subsets, |i, set| {
        let expected = set.covariance[(i, i)].max(0.0);
        let robust = scatter.error(&set.covariance.column(i).into_owned(), expected);
        [set.estimates[i], expected.sqrt().max(robust)]
    });
    let total: f64 = subsets.ties.iter().map(|set| libm::exp(-0.5 * set.excess)).sum();
    let one = |(i, parts): (usize, Vec<[f64; 3]>)| {
        let coefficient = &whole.coefficients[i];
        let unit = whole.scales.coefficient(&coefficient.term);
        let with = subsets.ties.iter().filter(|set| set.kept.contains(&i));
        let weight = with.fold(0.0, |sum, set| sum + libm::exp(-0.5 * set.excess) / total);
        let mixture = Mixture::new(parts);
        let [low, high] = mixture.interval();
        let [low, high] = if 1.0 - weight > TAIL { [low.min(0.0), high.max(0.0)] } else { [low, high] };
        let ends = [unit * low, unit * high];
        Averaged {
            name: format!("{}{}", if coefficient.imaginary { "i " } else { "" }, coefficient.name),
            value: unit * mixture.mean(),
            interval: [ends[0].min(ends[1]), ends[0].max(ends[1])],
            weight,
        }
    };
    parts.into_iter().enumerate().map(one).collect()
}

/// Of each tied set every coefficient, with the weight of the set; of those that the set has also beside one more term of their equation,
/// at [`PRICE`]. Coefficients that a set does not have are taken of the set with these added.
fn parts(
    whole: &Fit,
    subsets: &Subsets,
    value: impl Fn(usize, &Conditional) -> [f64; 2],
) -> Vec<Vec<[f64; 3]>> {
    let all = whole.coefficients.len();
    let full = Conditional::new(&whole.natural.coefficients, whole.covariance());
    let equation = |i: usize| whole.coefficients[i].term.equation;
    let mut parts: Vec<Vec<[f64; 3]>> = vec![Vec::new(); all];
    let mut put = |i: usize, weight: f64, set: &Conditional| {
        let [mean, deviation] = value(i, set);
        parts[i].push([weight, mean, deviation]);
    };
    for set in &subsets.ties {
        let weight = libm::exp(-0.5 * set.excess);
        let dropped: Vec<usize> = (0..all).filter(|i| !set.kept.contains(i)).collect();
        let own = full.without(dropped.iter().copied());
        set.kept.iter().for_each(|&i| put(i, weight, &own));
        for &more in &dropped {
            let extended = full.without(dropped.iter().copied().filter(|i| *i != more));
            put(more, weight, &extended);
            let weight = weight * libm::exp(0.5 * (own.cost - extended.cost - PRICE));
            let same = set.kept.iter().filter(|&&i| equation(i) == equation(more));
            same.for_each(|&i| put(i, weight, &extended));
        }
    }
    parts
}
