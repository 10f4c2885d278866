//! The paper's own scheme and steps.

use super::super::claims::claim;
use super::super::context::Context;
use super::{at, power};
use motiform_analysis::Regime;
use motiform_figures::report::Section;
use motiform_study::{Error, Study};

/// A place in each region: kappa2, kappa3; and the paper's name of the motion there.
const PLACES: [(f64, f64); 5] = [(1.4, 0.6), (0.5, 0.6), (0.9, 0.1), (0.5, 0.1), (0.05, 0.1)];
const NAMES: [Regime; 5] =
    [Regime::Straight, Regime::Circular, Regime::Zigzag, Regime::Chaotic, Regime::BlowUp];

/// Modified Euler's steps in the paper.
const STEPS: [f64; 2] = [1e-3, 1e-4];

pub(super) fn add(context: &Context<'_>, section: &mut Section) -> Result<(), Error> {
    let steps: &[f64] = context.choose(&STEPS, &STEPS[..1]);
    let schemes: Vec<Option<f64>> = std::iter::once(None).chain(steps.iter().copied().map(Some)).collect();
    let tasks: Vec<_> = PLACES.iter().flat_map(|place| schemes.iter().map(move |s| (*place, *s))).collect();
    let regimes: Vec<Regime> = context.each(&tasks, |(place, step)| regime(context, *place, *step))?;
    let rows: Vec<&[Regime]> = regimes.chunks(schemes.len()).collect();
    let words = |((kappa2, kappa3), row): (&(f64, f64), &&[Regime])| {
        let same = row.iter().all(|regime| *regime == row[0]);
        let names: Vec<&str> = row.iter().map(|regime| regime.name()).collect();
        let found = if same { format!("{} by all", row[0]) } else { names.join(" / ") };
        format!("({kappa2}, {kappa3}): {found}")
    };
    let list: Vec<String> = PLACES.iter().zip(&rows).map(words).collect();
    let names: Vec<String> = steps.iter().map(|step| format!("dt = {}", power(*step))).collect();
    section.claims.push(claim(
        &[107],
        "The modified Euler method with dt = 10^{-3} or 10^{-4} has been employed.",
        format!("{}.", list.join("; ")),
        &format!(
            "classification at a place of each region, from the same start, by dop853 with error control and by modified \
             Euler (heun) with {}: straight, circular, zigzag, chaos and blow-up by all",
            names.join(" and ")
        ),
        rows.iter().zip(NAMES).all(|(row, name)| row.iter().all(|regime| *regime == name)),
    ));
    Ok(())
}

/// The motion at a place, by error control or by modified Euler with a fixed step.
fn regime(context: &Context<'_>, (kappa2, kappa3): (f64, f64), step: Option<f64>) -> Result<Regime, Error> {
    let mut study: Study = at(context, kappa2, kappa3)?;
    if let Some(step) = step {
        "heun".clone_into(&mut study.run.stepper);
        study.run.step = Some(step);
    }
    Ok(context.classify(&study)?.regime)
}
