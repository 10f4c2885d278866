//! Rates at which the motion of a fitted cell is the true one: `cargo test --release -p motiform-cells -- --ignored --nocapture rates::`.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use super::bodies::{RADIUS, cell_of, preset, sampled};
use motiform_analysis::regime::Regime;
use motiform_cells::{CellTrack, FitOptions, fit_cells};
use motiform_lab::analyse;
use motiform_study::{RunPlan, Study};

/// A motion: a preset with its parameters, its name, and the radius of the circle that it deforms.
type Case = (&'static str, &'static [(&'static str, f64)], Regime, f64);

const CASES: [Case; 5] = [
    ("fig5b", &[], Regime::Chaotic, 2.0),
    ("fig5a", &[], Regime::Zigzag, 1.2),
    ("fig3", &[], Regime::QuasiPeriodic, 0.35), // its deformations are small
    ("fig4", &[("kappa2", 0.5), ("kappa3", 0.5)], Regime::Circular, 0.6),
    ("fig4", &[("kappa2", 1.5), ("kappa3", 0.9)], Regime::Straight, 0.6),
];

fn study(case: &Case, noise: f64, sampling: (f64, usize), seed: u64) -> Study {
    let mut study = preset(case.0, noise, sampling);
    for (name, value) in case.1 {
        study.set(name, *value).unwrap();
    }
    study.run.seed = seed;
    study
}

/// Names of fits: true ones, none, wrong ones; and how many were called handed.
fn named(studies: &[Study], (radius, vertex_noise): (f64, f64), truth: Regime) -> ([usize; 3], usize) {
    let cells: Vec<CellTrack> =
        studies.iter().flat_map(|study| cell_of(study, radius, vertex_noise).cells).collect();
    let cells: Vec<&CellTrack> = cells.iter().collect();
    let options = FitOptions { drift: false, ..FitOptions::default() };
    let fits = fit_cells(&cells, &options, 2, &()).unwrap();
    let (mut counts, mut handed) = ([0; 3], 0);
    for (fit, study) in fits.iter().flatten().zip(studies) {
        let Ok(fitted) = &fit.fitted else {
            counts[1] += 1;
            println!("    seed {}: no fit", study.run.seed);
            continue;
        };
        handed += usize::from(fitted.is_handed());
        match fitted.regime.as_ref().and_then(|found| found.regime) {
            Some(regime) if regime == truth => counts[0] += 1,
            Some(_) => counts[2] += 1,
            None => counts[1] += 1,
        }
        if fitted.regime.as_ref().and_then(|found| found.regime) != Some(truth) {
            let why = motiform_cells::cell_json(fit)["why"].as_str().unwrap_or_default().to_owned();
            println!("    seed {}: {}", study.run.seed, why.chars().take(160).collect::<String>());
        }
    }
    (counts, handed)
}

/// The motion of the equations without noise.
fn true_motion(study: &Study) -> Regime {
    let mut quiet = study.clone();
    quiet.run.noise = 0.0;
    analyse::classify(&RunPlan::new(&quiet).unwrap(), 0.0, &()).unwrap().unwrap().regime
}

/// The motions that are measured: MOTIFORM_CASE picks those whose names contain it.
fn cases() -> impl Iterator<Item = &'static Case> {
    let wanted = std::env::var("MOTIFORM_CASE").unwrap_or_default();
    CASES.iter().filter(move |case| case.2.name().contains(&wanted))
}

fn runs() -> u64 {
    std::env::var("MOTIFORM_RUNS").ok().and_then(|text| text.parse().ok()).unwrap_or(20)
}

#[test]
#[ignore = "a measurement of many minutes; MOTIFORM_RUNS=N sets the number of runs of each case"]
fn true_regimes() {
    for (noise, dt, frames) in [(0.002, 1.0, 1000), (0.01, 0.5, 1000), (0.01, 1.0, 1000)] {
        for case in cases() {
            let studies: Vec<Study> =
                (0..runs()).map(|seed| study(case, noise, (dt, frames), 100 + seed)).collect();
            let ([right, none, wrong], handed) = named(&studies, (case.3, 0.01), case.2);
            println!(
                "noise {noise}, sampling {dt}, {:?}: {right} right, {none} undecided, {wrong} wrong, {handed} handed",
                case.2
            );
            assert_eq!(wrong, 0, "{:?}", case.2);
        }
    }
}

#[test]
#[ignore = "a measurement of many minutes; MOTIFORM_RUNS=N sets the number of runs of each case"]
fn short_and_noisy_cells_have_no_wrong_name() {
    for (noise, vertex_noise, dt, frames) in
        [(0.02, 0.03, 0.5, 80), (0.05, 0.02, 0.5, 150), (0.02, 0.05, 2.0, 60)]
    {
        for case in cases() {
            let studies: Vec<Study> =
                (0..runs()).map(|seed| study(case, noise, (dt, frames), 500 + seed)).collect();
            let ([right, none, wrong], _) = named(&studies, (case.3, vertex_noise), case.2);
            println!(
                "noise {noise}, vertices {vertex_noise}, sampling {dt}, {frames} frames, {:?}: {right} right, {none} \
                 undecided, {wrong} wrong",
                case.2
            );
        }
    }
}

#[test]
#[ignore = "a measurement of many minutes; MOTIFORM_RUNS=N sets the number of runs of each case"]
fn handed_cells_are_found_handed() {
    for omega in [0.02, 0.05, 0.1] {
        let one = |seed| {
            let mut study = preset("chiral", 0.01, (0.5, 600));
            study.set("omega", omega).unwrap();
            study.set("kappa2", 0.5).unwrap();
            sampled(&mut study, 0.01, (0.5, 600));
            study.run.seed = 900 + seed;
            study
        };
        let studies: Vec<Study> = (0..runs()).map(one).collect();
        let truth = true_motion(&studies[0]);
        let ([right, none, wrong], handed) = named(&studies, (RADIUS, 0.01), truth);
        println!(
            "omega {omega}: {handed} of {} handed; {truth:?}: {right} right, {none} undecided, {wrong} wrong",
            runs()
        );
    }
}
