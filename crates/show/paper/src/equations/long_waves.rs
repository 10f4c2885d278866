//! The linear terms: the effect of g2 and g3 on the circle, and whether g1 matters.

use super::super::claims::claim;
use super::super::context::Context;
use super::super::fig6;
use motiform_analysis::Regime;
use motiform_figures::report::Claim;
use motiform_study::{Error, Study};

/// Damping of long waves, against g2 = g3 = 1. From 1/4 on nothing grows at all.
const G1: f64 = 0.02;

/// Lengths where motions are clear, and what they are without g1.
const PLACES: [(f64, Regime); 7] = [
    (9.0, Regime::Straight),
    (12.6, Regime::Circular),
    (13.6, Regime::Rectangular),
    (16.0, Regime::Motionless),
    (21.6, Regime::Chaotic),
    (22.1, Regime::Circular),
    (25.0, Regime::Motionless),
];

pub(super) fn claims(context: &Context<'_>) -> Result<Vec<Claim>, Error> {
    Ok(vec![circle(context)?, irrelevant(context)?])
}

fn body(length: f64, changes: &[(&str, f64)]) -> Result<Study, Error> {
    let mut study = fig6::study(length, fig6::modes_for(length))?;
    changes.iter().try_for_each(|(name, value)| study.set(name, *value))?;
    Ok(study)
}

/// Growth of small modes in runs: long waves grow for g2 > 0, short ones decay for g3 > 0.
fn circle(context: &Context<'_>) -> Result<Claim, Error> {
    const LENGTH: f64 = 31.0;
    let growth = |g2: f64| -> Result<Vec<f64>, Error> {
        let mut study = body(LENGTH, &[("g2", g2)])?;
        for n in 1..=8 {
            study.set_initial(&format!("c{n}"), 1e-9)?;
        }
        (study.run.transient, study.run.t_end, study.run.dt_out) = (0.0, 0.5, 0.5);
        (study.run.rtol, study.run.atol) = (1e-10, Some(1e-18));
        let end = context.simulate(&study)?.manifest.state;
        Ok((1..=8)
            .map(|n| context.number((end.get(&format!("c{n}")).unwrap_or(f64::NAN) / 1e-9).ln() / 0.5))
            .collect())
    };
    let (with, without) = (growth(1.0)?, growth(-1.0)?);
    let growing = |rates: &[f64]| rates.iter().filter(|rate| **rate > 0.0).count();
    Ok(claim(
        &[54],
        "To make the circular shape unstable we impose that *g*_2 is positive, and *g*_3 is also positive \
        to recover the stability at short waves.",
        format!(
            "at *L* = {LENGTH} with *g*_2 = *g*_3 = 1 modes 1 to {} grow and the shorter ones up to 8 \
            decay; with *g*_2 = -1 {} of them grow",
            growing(&with),
            growing(&without)
        ),
        "small modes in a run of 0.5 time units: the growing ones are the longest waves, *k* < 1",
        growing(&with) == 4 && with[..4].iter().all(|rate| *rate > 0.0) && growing(&without) == 0,
    ))
}

/// The same motions at lengths scaled by the shift of the onset.
fn irrelevant(context: &Context<'_>) -> Result<Claim, Error> {
    // k^2 - k^4 = g1 at the onset: the lengths stretch like 1/k
    let stretch = (0.5 * (1.0 + (1.0 - 4.0 * G1).sqrt())).sqrt().recip();
    let places = &PLACES[..context.choose(7, 5)];
    let regime = |(length, _): &(f64, Regime)| -> Result<Regime, Error> {
        Ok(context.classify(&body(stretch * length, &[("g1", G1)])?)?.regime)
    };
    let found = context.each(places, regime)?;
    let words = places.iter().zip(&found).map(|((length, without), with)| {
        let same = if with == without { String::new() } else { format!(" (without *g*_1: {without})") };
        format!("{with} at {:.2}{same}", stretch * length)
    });
    let same = places.iter().zip(&found).filter(|((_, without), with)| without == *with).count();
    Ok(claim(
        &[55],
        "Under this condition the term with *g*_1 is expected to be irrelevant and can be ignored.",
        format!(
            "with *g*_1 = {G1} {same} of {} motions are those without it, at lengths longer by {:.2} %: {}",
            places.len(),
            100.0 * (stretch - 1.0),
            words.collect::<Vec<_>>().join(", ")
        ),
        "random starts at lengths stretched as the onsets of the modes are; small *g*_1 (from *g*_1 = 1/4 \
        on no mode grows); all but one the same, as the windows may shift against each other",
        same + 1 >= places.len(),
    ))
}
