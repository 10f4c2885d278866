//! Motions that fix only some combinations of coefficients.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{Equations, Experiment, circle, full};
use motiform_inference::{
    EquationKnowledge, Identifiability, Knowledge, Settings, fit, identifiability, select,
};

fn look(equations: Equations, (eta, frames): (f64, usize)) -> Identifiability {
    let mut experiment = Experiment::new(equations, eta, 7);
    experiment.frames = frames;
    shown(identifiability(&fit(&[experiment.track()], &Settings::default(), &()).unwrap()))
}

fn shown(found: Identifiability) -> Identifiability {
    for of in &found.equations {
        println!("{:.3} {}", of.condition, of.text);
    }
    println!("{:?}", found.reasons);
    found
}

fn still() -> Equations {
    let mut equations = full(1.5, 1.0);
    equations[0].1.re = -0.5;
    equations
}

/// One complex equation for each amplitude.
#[test]
fn a_circle_without_noise_fixes_two_combinations() {
    let found = shown(identifiability(&circle().1));
    assert!(!found.identifiable);
    assert_eq!(found.equations.iter().map(EquationKnowledge::fixed).collect::<Vec<_>>(), [2, 2, 2]);
}

/// One real equation for each amplitude.
#[test]
fn a_straight_motion_without_noise_fixes_one_combination() {
    let found = look(full(1.5, 1.0), (0.0, 120));
    assert!(!found.identifiable);
    for of in &found.equations {
        assert_eq!(of.fixed(), 1, "{}", of.text);
        assert!(of.text.starts_with("of "), "{}", of.text);
    }
}

/// Without noise nothing is seen; with noise the relaxation about the resting shape.
#[test]
fn a_motionless_cell_fixes_relaxation_rates() {
    assert!(!look(still(), (0.0, 120)).identifiable);
    let mut experiment = Experiment::new(still(), 0.02, 7);
    experiment.frames = 300;
    let tracks = [experiment.track()];
    let whole = fit(&tracks, &Settings::default(), &()).unwrap();
    let selection = select(&tracks, &whole, &()).unwrap();
    assert_eq!(selection.subsets.best().unwrap().names, ["z1: z1", "z2: z2", "z3: z3"]);
    for (name, truth) in [("z1: z1", -0.5), ("z2: z2", -1.5), ("z3: z3", -1.0)] {
        let found = selection.fit.coefficient(name).unwrap().estimate;
        assert!((found.value - truth).abs() < 3.5 * found.error, "{name} {found:?}");
    }
}

#[test]
fn a_chaotic_motion_fixes_everything() {
    let found = look(full(0.5, 0.1), (0.01, 1000));
    assert!(found.identifiable, "{:?}", found.reasons);
    assert!(found.equations.iter().all(|of| of.count(Knowledge::Free) == 0));
}

#[test]
fn short_or_noisy_is_not_identifiable() {
    let short = look(full(0.5, 0.1), (0.02, 30));
    assert!(!short.identifiable);
    assert!(short.reasons.iter().any(|reason| reason.contains("are too few for 26 parameters")));
    let mut noisy = Experiment::new(full(0.9, 0.1), 0.02, 7);
    noisy.frames = 150;
    noisy.errors = noisy.errors.map(|error| 60.0 * error);
    let noisy = identifiability(&fit(&[noisy.track()], &Settings::default(), &()).unwrap());
    assert!(!noisy.identifiable, "{:?}", noisy.equations);
    assert!(
        noisy.reasons.iter().any(|reason| reason.contains("z3 does not exceed its errors")),
        "{:?}",
        noisy.reasons
    );
}
