//! The combinations of coefficients that the motion fixes.
//!
//! The errors of an equation's coefficients have covariance C (of all other coefficients and the noise
//! whatever they are). Its eigenvectors are combinations with independent errors. In natural units, where
//! speed, modes and rates are about 1, coefficients are of order 1: a combination is fixed where its standard
//! error is below [`FIXED`], free where it is above [`FREE`].

use crate::Fit;
use crate::filter::NOISES;
use crate::names::paper;
use motiform_dynamics::digits::with_error;
use motiform_dynamics::sample::sort_by_number;
use nalgebra::{DMatrix, SymmetricEigen};
use serde::{Deserialize, Serialize};

/// Largest standard error of a combination that is fixed, natural units.
pub const FIXED: f64 = 0.1;
/// Smallest standard error of a combination that is free, natural units.
pub const FREE: f64 = 1.0;
/// Smallest part of a combination that is written.
const WRITTEN: f64 = 0.15;
/// Fewest observed numbers for each parameter.
const LEAST_NUMBERS: usize = 20;
/// Largest coefficient in natural units: a larger one is not bounded by the data.
pub(crate) const BOUNDED: f64 = 10.0;

/// The accuracy with which a combination is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Knowledge {
    /// Standard error below [`FIXED`].
    Fixed,
    /// Between.
    Weak,
    /// Above [`FREE`].
    Free,
}

/// A combination of the coefficients of one equation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Combination {
    /// Factors of the coefficients in natural units, in the order of [`EquationKnowledge::names`]; their squares sum to 1.
    pub factors: Vec<f64>,
    /// Its value, natural units.
    pub value: f64,
    /// Its standard error, natural units.
    pub error: f64,
    /// The accuracy with which it is known.
    pub knowledge: Knowledge,
    /// In the units of the data and with the paper's names: `kappa2 - 0.3 b1 = 0.52 ± 0.01`; of a free one
    /// `kappa2 + 3 b1 (standard error 2.1)`.
    pub text: String,
}

/// The combinations of one equation, with the accuracy of each.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EquationKnowledge {
    /// The equation, from 0.
    pub equation: usize,
    /// Names of its coefficients.
    pub names: Vec<String>,
    /// Independent combinations, the best known first.
    pub combinations: Vec<Combination>,
    /// Square root of the largest ratio of two variances.
    pub condition: f64,
    /// In a sentence: `all 7 are fixed`, or what alone is.
    pub text: String,
}

impl EquationKnowledge {
    /// Number of fixed combinations.
    pub fn fixed(&self) -> usize {
        self.count(Knowledge::Fixed)
    }

    /// Number of combinations that are known this well.
    pub fn count(&self, knowledge: Knowledge) -> usize {
        self.combinations.iter().filter(|combination| combination.knowledge == knowledge).count()
    }
}

/// The identifiability of a fit: the combinations of coefficients that it fixes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Identifiability {
    /// Each equation that has terms.
    pub equations: Vec<EquationKnowledge>,
    /// `true` if no combination is free and the search converged.
    pub identifiable: bool,
    /// The reasons why not, if not.
    pub reasons: Vec<String>,
}

/// The combinations of coefficients that a fit fixes.
///
/// # Checked by  `tests/all/identifiability.rs`: circular, straight and motionless cells
pub fn identifiability(fit: &Fit) -> Identifiability {
    let covariance = fit.covariance();
    let equations: Vec<EquationKnowledge> = (0..fit.library.modes)
        .filter_map(|n| {
            let own: Vec<usize> =
                (0..fit.coefficients.len()).filter(|&i| fit.coefficients[i].term.equation == n).collect();
            (!own.is_empty()).then(|| equation(fit, &covariance, n, &own))
        })
        .collect();
    let mut reasons: Vec<String> = equations
        .iter()
        .filter(|of| of.count(Knowledge::Free) > 0)
        .map(|of| format!("equation of z{}: {}", of.equation + 1, of.text))
        .collect();
    let (numbers, parameters) = (fit.observed() * fit.frames, fit.coefficients.len() + NOISES);
    if numbers < LEAST_NUMBERS * parameters {
        reasons.push(format!(
            "{numbers} observed numbers are too few for {parameters} parameters: track at least {} frames",
            (LEAST_NUMBERS * parameters).div_ceil(fit.observed())
        ));
    }
    for (what, signal) in ["the speed", "z2", "z3", "z4"].iter().zip(&fit.scales.signal) {
        if *signal < 1.0 {
            reasons.push(format!("{what} does not exceed its errors of observation"));
        }
    }
    let names = unbounded(fit);
    if !names.is_empty() {
        reasons.push(format!("the data do not bound {}", names.join(", ")));
    }
    if let crate::Ending::Stopped { reason } = &fit.ending {
        reasons.push(format!("the fit did not converge: {reason}"));
    }
    Identifiability { identifiable: reasons.is_empty(), equations, reasons }
}

/// Coefficients above [`BOUNDED`] in natural units.
pub(crate) fn unbounded(fit: &Fit) -> Vec<String> {
    let pairs = fit.coefficients.iter().zip(&fit.natural.coefficients);
    pairs.filter(|(_, c)| c.abs() > BOUNDED).map(|(c, _)| c.name.clone()).collect()
}

fn equation(fit: &Fit, covariance: &DMatrix<f64>, n: usize, own: &[usize]) -> EquationKnowledge {
    let size = own.len();
    let block = DMatrix::from_fn(size, size, |i, j| covariance[(own[i], own[j])]);
    let eigen = SymmetricEigen::new(block);
    let mut order: Vec<usize> = (0..size).collect();
    sort_by_number(&mut order, |&a| eigen.eigenvalues[a]);
    let combination = |&k: &usize| {
        let factors: Vec<f64> = eigen.eigenvectors.column(k).iter().copied().collect();
        combine(fit, own, factors, eigen.eigenvalues[k].max(0.0).sqrt())
    };
    let combinations: Vec<Combination> = order.iter().map(combination).collect();
    let ends = [combinations.first(), combinations.last()].map(|c| c.map_or(1.0, |c| c.error));
    let names = own.iter().map(|&i| fit.coefficients[i].name.clone()).collect();
    let text = sentence(&combinations);
    let condition = if ends[0] > 0.0 { ends[1] / ends[0] } else { f64::MAX };
    EquationKnowledge { equation: n, names, combinations, condition, text }
}

fn combine(fit: &Fit, own: &[usize], factors: Vec<f64>, error: f64) -> Combination {
    let value = own.iter().zip(&factors).map(|(&i, f)| f * fit.natural.coefficients[i]).sum();
    let knowledge = match error {
        error if error < FIXED => Knowledge::Fixed,
        error if error <= FREE => Knowledge::Weak,
        _ => Knowledge::Free,
    };
    let text = text(fit, own, &factors, (knowledge != Knowledge::Free).then_some(value), error);
    Combination { factors, value, error, knowledge, text }
}

/// The combination with the paper's names, divided by its largest factor. Of a free one the error alone.
fn text(fit: &Fit, own: &[usize], factors: &[f64], value: Option<f64>, error: f64) -> String {
    let in_data: Vec<(String, f64)> = own
        .iter()
        .zip(factors)
        .filter(|(_, factor)| factor.abs() >= WRITTEN)
        .map(|(&i, factor)| {
            let coefficient = &fit.coefficients[i];
            let (name, by) = paper(&coefficient.term, coefficient.imaginary);
            (name, factor / (fit.scales.coefficient(&coefficient.term) * by))
        })
        .collect();
    let by_factor = |a: &&(String, f64), b: &&(String, f64)| a.1.abs().total_cmp(&b.1.abs());
    let Some(unit) = in_data.iter().max_by(by_factor).map(|(_, factor)| *factor) else {
        return String::new();
    };
    let mut words = String::new();
    for (name, factor) in &in_data {
        let ratio = factor / unit;
        let sign = match (words.is_empty(), ratio < 0.0) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        };
        let size = if (ratio.abs() - 1.0).abs() < 5e-3 {
            String::new()
        } else {
            format!("{} ", digits(ratio.abs()))
        };
        words += &format!("{sign}{size}{name}");
    }
    let error = (error / unit).abs();
    match value {
        Some(value) => format!("{words} = {}", with_error(value / unit, error)),
        None => format!("{words} (standard error {})", digits(error)),
    }
}

/// Three digits.
fn digits(x: f64) -> String {
    let short: f64 = format!("{x:.2e}").parse().unwrap_or(x);
    if short == 0.0 || (1e-3..1e5).contains(&short.abs()) { short.to_string() } else { format!("{short:e}") }
}

fn sentence(combinations: &[Combination]) -> String {
    let all = combinations.len();
    let texts = |wanted: Knowledge| -> Vec<&str> {
        combinations.iter().filter(|c| c.knowledge == wanted).map(|c| c.text.as_str()).collect()
    };
    let (fixed, free) = (texts(Knowledge::Fixed), texts(Knowledge::Free));
    match (fixed.len(), free.len()) {
        (_, 0) if fixed.len() == all => format!("all {all} coefficients are fixed"),
        (_, 0) => {
            let weak = texts(Knowledge::Weak);
            let (shown, more) = (weak.len().min(3), weak.len().saturating_sub(3));
            let rest = if more > 0 { format!(" and {more} more") } else { String::new() };
            format!(
                "{} of {all} combinations of coefficients are well known; weakly known: {}{rest}",
                fixed.len(),
                weak[..shown].join("; ")
            )
        }
        (0, _) => "no combination of coefficients is fixed".to_owned(),
        (fixed, unknown) if unknown < fixed => {
            let are = if unknown == 1 { "is" } else { "are" };
            format!("{unknown} of {all} combinations of coefficients {are} free: {}", free.join("; "))
        }
        _ => format!("of {all} combinations of coefficients only these are fixed: {}", fixed.join("; ")),
    }
}
