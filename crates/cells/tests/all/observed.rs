//! Motions named from samples alone, and records that do not decide.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use super::bodies::{cell, preset, sampled};
use motiform_analysis::regime::Regime;
use motiform_cells::{Observation, observe};
use motiform_study::Study;

fn observed(study: &Study) -> Observation {
    observe(&cell(study, 0.01).cells[0])
}

/// The plane of Fig. 4: (kappa2, kappa3).
fn full(kappa2: f64, kappa3: f64, noise: f64, sampling: (f64, usize)) -> Study {
    let mut study = preset("fig4", noise, sampling);
    study.set("kappa2", kappa2).unwrap();
    study.set("kappa3", kappa3).unwrap();
    study
}

#[test]
fn steady_motions_are_named() {
    let straight = observed(&full(1.5, 0.9, 0.005, (0.5, 400)));
    assert_eq!(straight.motion.regime, Some(Regime::Straight), "{}", straight.motion.why);
    let circular = observed(&full(0.5, 0.5, 0.005, (0.5, 600)));
    assert_eq!(circular.motion.regime, Some(Regime::Circular), "{}", circular.motion.why);
    let text = "[model.amplitudes]\nmodes = [1, 2]\n[model.amplitudes.equations]\nz1 = \"-z1\"\nz2 = \"-z2\"";
    let mut rest = Study::parse(text, "rest", "rest").unwrap();
    sampled(&mut rest, 0.0, (0.5, 200));
    let rest = observed(&rest);
    assert_eq!(rest.motion.regime, Some(Regime::Motionless), "{}", rest.motion.why);
}

#[test]
fn a_motion_that_repeats_without_turning_is_a_zigzag() {
    let zigzag = observed(&full(0.9, 0.1, 0.0, (0.5, 1000)));
    assert_eq!(zigzag.motion.regime, Some(Regime::Zigzag), "{}", zigzag.motion.why);
}

#[test]
fn what_the_record_does_not_decide_is_undecided() {
    for study in [
        preset("fig5b", 0.0, (0.5, 1000)), // chaos, which samples cannot tell from noise
        full(0.9, 0.1, 0.0, (0.5, 200)),   // two periods of a zigzag
        full(0.5, 0.5, 0.005, (0.5, 30)),  // too few frames
        full(1.5, 0.9, 0.3, (0.5, 400)),   // a straight swimmer that noise turns
    ] {
        let found = observed(&study);
        assert_eq!(found.motion.regime, None, "{:?}: {}", found.motion.regime, found.motion.why);
    }
}
