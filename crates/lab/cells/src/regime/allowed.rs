//! The models that the data allow, and the motions that they end in.

use super::natural_study;
use crate::Result;
use motiform_analysis::regime::Regime;
use motiform_dynamics::Watch;
use motiform_dynamics::sample::sort_by_number;
use motiform_inference::{Coefficient, Fit, Library, Selection, Subset, Track, draws, refit_tied};
use motiform_lab::many;
use motiform_study::RunPlan;

/// Sets of terms with less weight than this, relative to the best, have no draws.
const LEAST_WEIGHT: f64 = 0.05;
/// Most steps of the integration for one model: some draws are so stiff that their motion would take minutes. They count as undetermined.
const MOST_STEPS: u64 = 200_000;
/// Most sets of terms that have draws.
const MOST_SETS: usize = 20;

/// The models of the sets that the data do not tell apart, with their shares of the weight.
pub(super) fn sets(
    tracks: &[Track],
    whole: &Fit,
    selection: &Selection,
    watch: &dyn Watch,
) -> Result<Vec<(Fit, f64)>> {
    let weight = |set: &Subset| libm::exp(-0.5 * set.excess);
    let ties: Vec<&Subset> =
        selection.subsets.ties.iter().filter(|set| weight(set) >= LEAST_WEIGHT).take(MOST_SETS).collect();
    if whole.handed != selection.fit.handed || ties.len() < 2 {
        return Ok(vec![(selection.fit.clone(), 1.0)]);
    }
    let all: f64 = ties.iter().map(|set| weight(set)).sum();
    let fit = |(number, set): (usize, &&Subset)| {
        let first = number == 0;
        if first { Ok(selection.fit.clone()) } else { refit_tied(tracks, whole, &set.kept, watch) }
    };
    let with_share = |one: (usize, &&Subset)| Ok((fit(one)?, weight(one.1) / all));
    ties.iter().enumerate().map(with_share).collect()
}

/// A model that the data allow.
pub(super) struct Drawn<'f> {
    /// The fit of its set of terms.
    pub(super) fit: &'f Fit,
    /// Its coefficients, in natural units.
    pub(super) values: Vec<f64>,
}

/// Models drawn from these fits, in an order in which the sets have their shares from the beginning on: `count` altogether.
pub(super) fn drawn(sets: &[(Fit, f64)], count: usize, seed: u64) -> Vec<Drawn<'_>> {
    let mut all = Vec::new();
    for (number, (fit, share)) in sets.iter().enumerate() {
        let units: Vec<f64> = fit.coefficients.iter().map(|c| fit.scales.coefficient(&c.term)).collect();
        let here = (share * count as f64).ceil() as usize;
        for (k, drawn) in draws(fit, here, seed.wrapping_add(number as u64)).into_iter().enumerate() {
            let values = drawn.iter().zip(&units).map(|(value, unit)| value / unit).collect();
            all.push(((k as f64 + 0.5) / share, Drawn { fit, values }));
        }
    }
    sort_by_number(&mut all, |a| a.0);
    all.into_iter().map(|(_, model)| model).take(count).collect()
}

/// The motions in which the equations of these models end from this start. All are equations with the terms of any set, those that a set
/// leaves out with the coefficient 0, so that they are classified together.
pub(super) fn ends(
    whole: &Fit,
    sets: &[(Fit, f64)],
    models: &[Drawn<'_>],
    start: &[f64],
    watch: &dyn Watch,
) -> Result<Vec<Regime>> {
    let all = if sets.len() == 1 { &sets[0].0 } else { whole };
    let same = |a: &Coefficient, b: &Coefficient| a.term == b.term && a.imaginary == b.imaginary;
    let of = |fit: &Fit, c: &Coefficient| fit.coefficients.iter().position(|own| same(own, c));
    let common = |c: &&Coefficient| sets.iter().any(|(fit, _)| of(fit, c).is_some());
    let common: Vec<&Coefficient> = all.coefficients.iter().filter(common).collect();
    let terms = common.iter().filter(|c| !c.imaginary).map(|c| c.term.clone()).collect();
    let library = Library { modes: all.library.modes, terms };
    let plan = |Drawn { fit, values }: &Drawn<'_>| {
        let values: Vec<f64> = common.iter().map(|c| of(fit, c).map_or(0.0, |i| values[i])).collect();
        let mut study = natural_study(&library, all.handed, &values, start)?;
        study.run.max_steps = MOST_STEPS;
        RunPlan::new(&study)
    };
    let plans =
        models.iter().map(plan).collect::<std::result::Result<Vec<RunPlan>, motiform_study::Error>>()?;
    let verdicts = many::classify(&plans, 0.0, watch)?.ok_or(motiform_study::Error::Interrupted)?;
    Ok(verdicts.into_iter().map(|verdict| verdict.regime).collect())
}
