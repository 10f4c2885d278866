//! The independence of a steady motion's name from the way to the equilibrium and from the resolution of the
//! body.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{Random, cell, near, reduced, settings};
use motiform_analysis::regime::{Regime, classify};
use motiform_analysis::{RelativeEquilibrium, SteadyMotion};
use motiform_dynamics::{Equivariant, System};
use std::f64::consts::TAU;

/// The cell's drift pitchfork from straight to circular motion is at 12.278498 (bisection of the leading eigenvalue with 21 modes).
const TURNING: [(f64, f64); 2] = [(12.297, 0.012810), (12.6, 0.0454)];

/// The stable steady motion of a cell with so many modes, from a start that depends on `seed`.
fn settled(length: f64, modes: u32, seed: u64) -> (motiform_models::cell::Cell, RelativeEquilibrium) {
    let body = cell(length, modes);
    let mut random = Random(seed);
    let start: Vec<f64> =
        (0..body.dim()).map(|i| 0.05 * random.next() / f64::powi(1.0 + i as f64, 3)).collect();
    let verdict = motiform_analysis::regime::settle(&body, &start, &settings("cell"), &()).unwrap().unwrap();
    let found = RelativeEquilibrium::find(&body, &verdict.1).unwrap();
    (body, found)
}

#[test]
fn a_cell_that_turns_is_circular_with_any_number_of_modes() {
    for (length, rate) in TURNING {
        for (modes, seed) in [(8, 1), (14, 2), (21, 3), (42, 4), (64, 5)] {
            let (body, found) = settled(length, modes, seed);
            let steady = SteadyMotion::of(&body, &found);
            assert_eq!(steady.regime(), Regime::Circular, "{length} {modes}: {steady:?}");
            assert!(steady.margin() > 10.0 && found.is_stable(), "{length} {modes}: {steady:?} {found:?}");
            let known = if modes > 8 { 2e-3 } else { 0.1 };
            near(steady.turning_rate.value.abs() / rate, 1.0, known);
        }
    }
    for modes in [14, 42, 64] {
        let (body, found) = settled(12.2, modes, 6);
        let steady = SteadyMotion::of(&body, &found);
        assert_eq!((steady.regime(), steady.turning()), (Regime::Straight, Some(0.0)), "{modes}: {steady:?}");
        assert!(steady.margin() > 1.0 && found.is_stable(), "{modes}: {steady:?} {found:?}");
    }
}

/// The verdicts themselves, with margins above 1.
#[test]
fn the_classifier_names_what_the_equilibrium_does() {
    for (length, modes, seed) in [(12.297, 21, 307), (12.6, 42, 5), (12.9, 42, 5)] {
        let body = cell(length, modes);
        let mut random = Random(seed);
        let start: Vec<f64> = (0..body.dim()).map(|_| 0.01 * random.next()).collect();
        let verdict = classify(&body, &start, &settings("cell"), &()).unwrap().unwrap();
        assert_eq!(verdict.regime, Regime::Circular, "{length} {modes}: {verdict:?}");
        assert!(verdict.margin.unwrap() > 1.0 && verdict.turning_rate.unwrap().abs() > 0.01, "{verdict:?}");
    }
}

/// Every state of the reduced model that is known by formula, from starts anywhere on its group orbit.
#[test]
fn the_states_of_the_reduced_model_are_named_from_every_start() {
    let mut random = Random(3);
    // motionless circle, motionless ellipse (a saddle), straight, circular: section 1.1 of the lines of the model
    for (kappa2, gamma, size, regime) in [
        (0.1, -0.05, 0.0, Regime::Motionless),
        (0.15, 0.05, 0.2, Regime::Straight),
        (0.02, 0.05, 0.2, Regime::Circular),
    ] {
        let body = reduced(kappa2, gamma);
        for _ in 0..20 {
            let start: Vec<f64> = (0..6).map(|_| 0.2 * random.next()).collect();
            let (_, shape) =
                motiform_analysis::regime::settle(&body, &start, &settings("tensor"), &()).unwrap().unwrap();
            let found = RelativeEquilibrium::find(&body, &shape).unwrap();
            let mut turned = found.shape.clone();
            body.rotate(TAU * random.next(), &mut turned);
            let again = RelativeEquilibrium::find(&body, &turned).unwrap();
            for found in [&found, &again] {
                let steady = SteadyMotion::of(&body, found);
                assert_eq!(steady.regime(), regime, "{kappa2} {gamma} {size}: {steady:?}");
                assert!(steady.margin() > 10.0, "{steady:?}");
            }
        }
    }
}
