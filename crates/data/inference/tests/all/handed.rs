//! Handed cells and cells that are not.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{Equations, Experiment, circle, full, quasi_periodic, vertex_noise};
use crate::samples::draws;
use motiform_dynamics::Complex;
use motiform_inference::{
    Handedness, SEEN, Settings, Symmetry, drift, fit, handedness, identifiability, select,
};

fn look(experiment: &Experiment) -> Handedness {
    let tracks = [experiment.track()];
    let whole = fit(&tracks, &Settings::default(), &()).unwrap();
    let selection = select(&tracks, &whole, &()).unwrap();
    handedness(&tracks, &selection.fit, &()).unwrap()
}

#[test]
fn handed_cell() {
    let mut experiment = Experiment::new(full(0.5, 0.1), 0.02, 5);
    experiment.frames = 400;
    experiment.equations[0].1 = Complex::new(1.0, 0.15);
    let found = look(&experiment);
    println!("{:?} ratio {} of {}, p {}", found.symmetry, found.ratio, found.degrees, found.p_value);
    assert_eq!(found.symmetry, Symmetry::Handed);
    assert!(found.bic < 0.0);
    assert_eq!(found.parts[0].name, "z1: z1");
    let [low, high] = found.parts[0].estimate.interval;
    assert!((low..=high).contains(&0.15), "{low} {high}");
}

/// Coefficients at other sampling intervals are those of the model that is given, complex ones of a handed cell: they are the true ones.
#[test]
fn fewer_frames_of_a_handed_cell_have_its_imaginary_part() {
    let mut experiment = Experiment::new(full(0.5, 0.1), 0.02, 5);
    (experiment.frames, experiment.interval) = (1600, 0.25);
    experiment.equations[0].1 = Complex::new(1.0, 0.15);
    let found = look(&experiment);
    let drift = drift(&[experiment.track()], &found.fit, &()).unwrap();
    let place = drift.coefficients.iter().position(|name| name == "i z1: z1").unwrap();
    let counted: Vec<_> = drift.points.iter().filter(|point| point.estimates.is_ok()).collect();
    assert!(!counted.is_empty(), "{:?}", drift.points);
    for point in counted {
        let estimate = point.estimates.as_ref().unwrap()[place];
        println!("every {}: {} +- {}", point.every, estimate.value, estimate.error);
        assert!((estimate.value - 0.15).abs() < 4.0 * estimate.error && estimate.error < 0.06);
    }
    assert_eq!(drift.changes.len(), found.fit.coefficients.len());
    assert!(drift.names().is_empty(), "{:?}", drift.names());
}

/// Mirror-symmetric cells of 200 frames: more than 3 alarms of 30 at a rate of 1 % have a probability of 2e-4, more than 2 of 10 one of
/// 1e-4.
#[test]
fn false_alarms() {
    let mut p_values = Vec::new();
    for seed in 0..draws(10, 30) {
        let mut experiment = Experiment::new(full(0.5, 0.1), 0.02, 900 + seed);
        experiment.frames = 200;
        let found = look(&experiment);
        assert_ne!(found.symmetry, Symmetry::Handed, "p {}", found.p_value);
        assert_eq!(
            found.symmetry == Symmetry::Mirror,
            !found.is_doubted() && identifiability(&found.fit).identifiable && found.excluded < SEEN
        );
        p_values.push(found.p_value);
    }
    p_values.sort_by(f64::total_cmp);
    println!("p-values {p_values:.3?}");
    assert!(p_values.iter().filter(|p| **p < 0.01).count() <= draws(2, 3));
}

/// A circle that real coefficients explain: turning alone does not make a cell handed, and nothing says that it is not.
#[test]
fn turning_is_not_handedness() {
    let (tracks, whole) = circle();
    let found = handedness(tracks, whole, &()).unwrap();
    println!("{:?} ratio {:.1} of {}, p {:.3}", found.symmetry, found.ratio, found.degrees, found.p_value);
    assert_eq!(found.symmetry, Symmetry::Undecided);
}

/// Symmetry is said where it could have been refuted: of long chaotic records, whose imaginary parts are
/// known to a few per cent, and not of short ones. What is excluded falls as the record grows.
#[test]
fn symmetry_needs_power() {
    let excluded = |frames: usize| {
        let mut experiment = Experiment::new(full(0.5, 0.1), 0.01, 77);
        experiment.frames = frames;
        let found = look(&experiment);
        println!(
            "{frames} frames: {:?}, excluded {:.3}, p {:.2}",
            found.symmetry, found.excluded, found.p_value
        );
        assert!(found.symmetry != Symmetry::Mirror || found.excluded < SEEN);
        found.excluded
    };
    let [short, long] = [150, 1500].map(excluded);
    assert!(long < 0.6 * short && long < 2.0 * SEEN, "{short} {long}");
}

/// A mirror-symmetric motion: its equations, radius, process noise, sampling and frames.
type Case = (&'static str, Equations, f64, f64, f64, usize);

fn symmetric_cases() -> Vec<Case> {
    vec![
        ("chaotic", full(0.5, 0.1), 2.0, 0.02, 0.5, 200),
        ("chaotic", full(0.5, 0.1), 2.0, 0.02, 0.5, 1000),
        ("chaotic, coarse", full(0.5, 0.1), 2.0, 0.01, 1.0, 1000),
        ("zigzag", full(0.9, 0.1), 1.2, 0.01, 1.0, 300),
        ("zigzag", full(0.9, 0.1), 1.2, 0.01, 0.5, 1000),
        ("circular", full(0.5, 0.5), 0.6, 0.01, 0.5, 300),
        ("straight", full(1.5, 0.9), 0.6, 0.01, 0.5, 300),
        ("quasi-periodic", quasi_periodic(), 0.35, 0.002, 1.0, 1000),
        ("quasi-periodic", quasi_periodic(), 0.35, 0.002, 2.0, 400),
        ("quasi-periodic, noisy", quasi_periodic(), 0.35, 0.01, 1.0, 1000),
        ("quasi-periodic, small", quasi_periodic(), 2.0, 0.002, 1.0, 1000),
    ]
}

/// The frequency with which mirror-symmetric cells are called handed, motion by motion; MOTIFORM_RUNS sets
/// the number of cells, MOTIFORM_CASE picks a motion.
#[test]
#[ignore = "a measurement of many minutes: figures in docs/inference.md"]
fn rates_of_false_alarms() {
    let runs: u64 = std::env::var("MOTIFORM_RUNS").map_or(100, |text| text.parse().unwrap());
    let wanted = std::env::var("MOTIFORM_CASE").unwrap_or_default();
    for (name, equations, radius, eta, interval, frames) in symmetric_cases() {
        if !name.contains(&wanted) {
            continue;
        }
        let one = |seed| {
            let errors = vertex_noise(radius);
            look(&Experiment { errors, interval, frames, ..Experiment::new(equations.clone(), eta, seed) })
        };
        let found: Vec<Handedness> = (0..runs).map(|run| one(7000 + run)).collect();
        let below = |level: f64| found.iter().filter(|one| one.p_value < level).count();
        let handed = found.iter().filter(|one| one.symmetry == Symmetry::Handed).count();
        println!(
            "{name}, noise {eta}, sampling {interval}, {frames} frames: {handed} of {runs} handed; p below 0.01: {}, 0.05: {}, 0.5: {}",
            below(0.01),
            below(0.05),
            below(0.5)
        );
        for one in found.iter().filter(|one| one.p_value < 0.01) {
            println!(
                "    ratio {:.1} of {}, {:?}, converged {}, parts {:?}",
                one.ratio,
                one.degrees,
                one.symmetry,
                one.fit.converged(),
                one.parts
                    .iter()
                    .map(|c| format!(
                        "{} {:.3} +- {:.3} ({:.3})",
                        c.name, c.estimate.value, c.estimate.error, c.estimate.robust
                    ))
                    .collect::<Vec<_>>()
            );
        }
    }
}
