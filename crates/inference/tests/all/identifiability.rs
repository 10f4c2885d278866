//! Motions that fix only some combinations of coefficients.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{Equations, Experiment, full};
use motiform_inference::{Settings, fit, identifiability};

fn look(name: &str, equations: Equations, eta: f64, frames: usize) {
    let mut experiment = Experiment::new(equations, eta, 7);
    experiment.frames = frames;
    let found = fit(&[experiment.track()], &Settings::default()).unwrap();
    println!("{name} {:?} {:?} T {:.3}", found.ending, found.natural.logs, found.scales.time);
    for of in identifiability(&found).equations {
        let errors: Vec<f64> = of.combinations.iter().map(|c| c.error).collect();
        println!("  {errors:.3?} {}", of.text);
    }
}

#[test]
fn scratch() {
    for eta in [0.0, 0.002, 0.02] {
        println!("eta {eta}");
        look("chaotic", full(0.5, 0.1), eta, 1000);
        look("zigzag", full(0.9, 0.1), eta, 1000);
        look("circular", full(0.5, 0.3), eta, 300);
        look("straight", full(1.5, 1.0), eta, 300);
        let mut still = full(1.5, 1.0);
        still[0].1.re = -0.5;
        look("still", still, eta, 300);
    }
    look("short chaotic", full(0.5, 0.1), 0.02, 30);
    look("100 chaotic", full(0.5, 0.1), 0.02, 100);
}
