//! The terms that the data ask for: best subsets, without fitting each.
//!
//! Near the maximum twice the log-likelihood falls by `theta_z^T (C_zz)^-1 theta_z` where the coefficients z
//! are set to 0 and all others are adapted; C is the covariance of all estimates. The score of a set is that
//! plus `ln(n N)` for each coefficient kept (Schwarz), N the number of frames and n that of the numbers
//! observed in each: 6, with z4 8.
//!
//! Each equation's sets are searched with the other equations at their best sets, in turn until nothing changes; then the good sets of all
//! equations are combined and scored jointly. Sets within [`TIE`] of the best are all kept: the data do not tell them apart.

mod average;
mod conditional;
mod mixture;
mod search;

use crate::filter::Theta;
use crate::fit::{MOST, refit, refit_within};
use crate::{Fit, Library, Result, Settings, Track, observation};
pub use average::{Averaged, averaged};
pub(crate) use conditional::Conditional;
pub(crate) use mixture::{Mixture, Scatter, over_sets};
use motiform_dynamics::Watch;
use motiform_dynamics::sample::sort_by_number;
use search::{Choice, search};
use serde::{Deserialize, Serialize};

/// Sets whose score is within this of the best are not told apart.
pub const TIE: f64 = 6.0;
/// Most sets of one equation that are combined with those of others.
const MOST_COMBINED: usize = 30;
/// Most joint sets that are reported.
const MOST_TIES: usize = 1000;
/// Promised gain of log-likelihood at which the fit of a tied set ends.
const NEAR: f64 = 0.05;

/// A set of coefficients.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Subset {
    /// The coefficients kept: numbers in the fit's list.
    pub kept: Vec<usize>,
    /// Their names; an imaginary part begins with `i`.
    pub names: Vec<String>,
    /// Score above that of the best set.
    pub excess: f64,
}

/// The sets that the data allow.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Subsets {
    /// Price of a coefficient: `ln(n N)`, n numbers in each of N frames.
    pub penalty: f64,
    /// All sets within [`TIE`] of the best, the best first.
    pub ties: Vec<Subset>,
    /// `true` if every set was considered; if not, a better one may exist.
    pub complete: bool,
}

impl Subsets {
    /// The best set.
    pub fn best(&self) -> Option<&Subset> {
        self.ties.first()
    }

    /// The number of the sets within [`TIE`] that have each coefficient which any of them has, the most
    /// frequent first.
    pub fn counts(&self) -> Vec<(String, usize)> {
        let mut counts: Vec<(String, usize)> = Vec::new();
        for name in self.ties.iter().flat_map(|set| &set.names) {
            match counts.iter_mut().find(|entry| entry.0 == *name) {
                Some(entry) => entry.1 += 1,
                None => counts.push((name.clone(), 1)),
            }
        }
        counts.sort_by_key(|entry| std::cmp::Reverse(entry.1));
        counts
    }

    /// Names that are in every set within [`TIE`].
    pub fn certain(&self) -> Vec<String> {
        let Some(best) = self.best() else { return Vec::new() };
        let in_all = |name: &&String| self.ties.iter().all(|set| set.names.contains(name));
        best.names.iter().filter(in_all).cloned().collect()
    }
}

/// A fit with the terms that the data ask for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Selection {
    /// The sets.
    pub subsets: Subsets,
    /// The model of the best set, fitted again.
    pub fit: Fit,
}

/// The best subsets of a fit's coefficients.
///
/// # Checked by  `tests/all/subsets.rs`: all sets by brute force; how often the exact set is found
pub fn subsets(fit: &Fit) -> Subsets {
    let penalty = libm::log((fit.observed() * fit.frames.max(1)) as f64);
    let whole = Conditional::new(&fit.natural.coefficients, fit.covariance());
    let equations: Vec<Vec<usize>> = (0..fit.library.modes)
        .map(|n| (0..fit.coefficients.len()).filter(|&i| fit.coefficients[i].term.equation == n).collect())
        .collect();
    let (choices, complete) = descend(&whole, &equations, penalty);
    Subsets { penalty, ties: joint(fit, &whole, &choices, penalty), complete }
}

/// The good sets of each equation with the others at their best ones, in turn until nothing changes; whether all sets were considered.
fn descend(whole: &Conditional, equations: &[Vec<usize>], penalty: f64) -> (Vec<Vec<Choice>>, bool) {
    let mut choices: Vec<Vec<Choice>> = vec![Vec::new(); equations.len()];
    let mut dropped: Vec<Vec<usize>> = vec![Vec::new(); equations.len()];
    let mut complete = true;
    for _round in 0..8 {
        let before = dropped.clone();
        for n in 0..equations.len() {
            let others: Vec<usize> =
                (0..equations.len()).filter(|&m| m != n).flat_map(|m| dropped[m].clone()).collect();
            let mut rest = whole.clone();
            others.iter().for_each(|&i| rest.drop(i));
            let found = search(&rest, &equations[n], penalty);
            complete &= found.complete;
            dropped[n] = found.choices.first().map(|choice| choice.dropped.clone()).unwrap_or_default();
            choices[n] = found.choices;
        }
        if dropped == before {
            break;
        }
    }
    (choices, complete)
}

/// Good sets of the equations, combined and scored together.
fn joint(fit: &Fit, whole: &Conditional, choices: &[Vec<Choice>], penalty: f64) -> Vec<Subset> {
    let mut partial: Vec<(Vec<usize>, f64)> = vec![(Vec::new(), 0.0)];
    for choices in choices {
        let best = choices.first().map_or(0.0, |choice| choice.score);
        let mut more = Vec::new();
        for (dropped, excess) in &partial {
            for choice in choices.iter().take(MOST_COMBINED) {
                let excess = excess + choice.score - best;
                if excess <= 1.5 * TIE {
                    more.push(([dropped.clone(), choice.dropped.clone()].concat(), excess));
                }
            }
        }
        partial = more;
    }
    let score = |dropped: &[usize]| {
        let mut rest = whole.clone();
        dropped.iter().for_each(|&i| rest.drop(i));
        rest.cost - penalty * dropped.len() as f64
    };
    let mut scored: Vec<(Vec<usize>, f64)> = partial
        .into_iter()
        .map(|(dropped, _)| {
            let s = score(&dropped);
            (dropped, s)
        })
        .collect();
    sort_by_number(&mut scored, |a| a.1);
    let best = scored.first().map_or(0.0, |(_, score)| *score);
    let ties = scored.into_iter().take_while(|(_, score)| score - best <= TIE).take(MOST_TIES);
    ties.map(|(dropped, score)| subset(fit, &dropped, score - best)).collect()
}

fn subset(fit: &Fit, dropped: &[usize], excess: f64) -> Subset {
    let kept: Vec<usize> = (0..fit.coefficients.len()).filter(|i| !dropped.contains(i)).collect();
    let name = |&i: &usize| {
        let c = &fit.coefficients[i];
        if c.imaginary { format!("i {}", c.name) } else { c.name.clone() }
    };
    Subset { names: kept.iter().map(name).collect(), kept, excess }
}

/// Finds the best set of a fit's terms and fits the model with these terms alone.
///
/// Of a handed fit, a term stays if its real or its imaginary part does.
///
/// # Errors    of the input, as [`crate::fit()`]
pub fn select(tracks: &[Track], fit: &Fit, watch: &dyn Watch) -> Result<Selection> {
    observation::check(tracks, fit.library.modes)?;
    let subsets = subsets(fit);
    let kept = subsets.best().map(|set| set.kept.clone()).unwrap_or_default();
    let fit = refit_with(tracks, fit, &kept, watch)?;
    Ok(Selection { subsets, fit })
}

/// The model of these coefficients alone (numbers in the fit's list), fitted from where the others leave them when set to 0.
///
/// Without any coefficient the fit itself is returned.
///
/// # Errors    [`crate::Error::Interrupted`] where the watch stops it
pub fn refit_with(tracks: &[Track], fit: &Fit, kept: &[usize], watch: &dyn Watch) -> Result<Fit> {
    match reduced(fit, kept) {
        Some((settings, start)) => refit(tracks, &settings, &fit.scales, &start, watch),
        None => Ok(fit.clone()),
    }
}

/// As [`refit_with`], for sets that the data do not tell from the best one: to 0.3 standard errors, less than the data know of them.
///
/// # Errors    as [`refit_with`]
pub fn refit_tied(tracks: &[Track], fit: &Fit, kept: &[usize], watch: &dyn Watch) -> Result<Fit> {
    match reduced(fit, kept) {
        Some((settings, start)) => refit_within(tracks, &settings, &fit.scales, &start, NEAR, MOST, watch),
        None => Ok(fit.clone()),
    }
}

/// The settings of a fit of these coefficients alone, and where the others leave them when set to 0; `None` without any coefficient.
pub(crate) fn reduced(fit: &Fit, kept: &[usize]) -> Option<(Settings, Theta)> {
    let terms = fit.library.terms.len();
    let stays = |term: usize| kept.iter().any(|&i| i % terms == term);
    let stays: Vec<bool> = (0..terms).map(stays).collect();
    if !stays.contains(&true) {
        return None;
    }
    let mut rest = Conditional::new(&fit.natural.coefficients, fit.covariance());
    for i in (0..fit.coefficients.len()).filter(|&i| !stays[i % terms]) {
        rest.drop(i);
    }
    let of = |i: &usize| stays[*i % terms];
    let coefficients = (0..fit.coefficients.len()).filter(of).map(|i| rest.estimates[i]).collect();
    let kept_terms = fit.library.terms.iter().zip(&stays).filter(|(_, stays)| **stays);
    let library =
        Library { modes: fit.library.modes, terms: kept_terms.map(|(term, _)| term.clone()).collect() };
    let settings = Settings { library, handed: fit.handed, starts: Vec::new() };
    Some((settings, Theta { coefficients, logs: fit.natural.logs }))
}
