//! A stable periodic orbit inside an unstable torus, beside a chaotic transient: names that no seed may change.
//!
//! The model (models/w63.toml: random coefficients, 5 modes) has a subcritical torus bifurcation at c1 =
//! 1.130844. Above it the periodic orbit is stable; outside the torus orbits are thrown about and come back,
//! and in the end shrink onto the orbit, at a rate of 8e-5 (runs of 200,000 with an independent Runge-Kutta
//! code).

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::samples::draws;
use motiform_analysis::Attractor;
use motiform_lab::analyse;
use motiform_study::{RunPlan, Study};

const MODEL: &str = include_str!("models/w63.toml");

/// The period of the stable orbit at c1 = 1.1312.
const PERIOD: f64 = 3.607909;

/// It is this orbit, or undetermined: near the unstable torus the returns lie on a closed curve for thousands of turns.
#[test]
fn an_unstable_torus_is_not_what_remains() {
    let mut found = 0;
    // the fourth start stays long on a closed curve, the sixth reaches the orbit
    for seed in draws(4, 1)..=draws(6, 8) {
        let mut study = Study::parse(MODEL, "text", "w63").unwrap();
        study.set("c1", 1.1312).unwrap();
        study.run.seed = seed;
        let verdict = analyse::classify(&RunPlan::new(&study).unwrap(), 0.0, &()).unwrap().unwrap();
        println!(
            "seed {seed}: {} ({:?}), margin {:?}: {}",
            verdict.regime, verdict.attractor, verdict.margin, verdict.why
        );
        match verdict.attractor {
            Attractor::Unknown => {}
            Attractor::Periodic => {
                found += 1;
                assert!((verdict.period.unwrap() - PERIOD).abs() < 1e-5, "seed {seed}: {:?}", verdict.period);
            }
            other => panic!("seed {seed}: {other:?}, {}", verdict.why),
        }
    }
    assert!(found > 0, "no start reached the orbit");
}
