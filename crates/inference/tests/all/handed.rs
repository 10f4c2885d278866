//! Handed cells and cells that are not.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{Experiment, full};
use motiform_dynamics::Complex;
use motiform_inference::{Handedness, Settings, Symmetry, fit, handedness, select};

fn look(experiment: &Experiment) -> Handedness {
    let tracks = [experiment.track()];
    let whole = fit(&tracks, &Settings::default()).unwrap();
    let selection = select(&tracks, &whole).unwrap();
    handedness(&tracks, &selection.fit).unwrap()
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

/// 30 mirror-symmetric cells of 200 frames: more than 3 alarms at a rate of 1 % have a probability of 2e-4.
#[test]
fn false_alarms() {
    let mut p_values = Vec::new();
    for seed in 0..30 {
        let mut experiment = Experiment::new(full(0.5, 0.1), 0.02, 900 + seed);
        experiment.frames = 200;
        p_values.push(look(&experiment).p_value);
    }
    p_values.sort_by(f64::total_cmp);
    println!("p-values {p_values:.3?}");
    assert!(p_values.iter().filter(|p| **p < 0.01).count() <= 3);
}

/// A circle that real coefficients explain: turning alone does not make a cell handed, and nothing says that it is not.
#[test]
fn turning_is_not_handedness() {
    let mut experiment = Experiment::new(full(0.5, 0.3), 0.0, 7);
    experiment.frames = 300;
    let tracks = [experiment.track()];
    let whole = fit(&tracks, &Settings::default()).unwrap();
    let found = handedness(&tracks, &whole).unwrap();
    println!("{:?} ratio {:.1} of {}, p {:.3}", found.symmetry, found.ratio, found.degrees, found.p_value);
    assert_eq!(found.symmetry, Symmetry::Undecided);
}
