//! Fits of simulated cells.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{Experiment, FULL, full};
use motiform_inference::{Settings, fit};

#[test]
fn chaotic() {
    for seed in 0..5 {
        let experiment = Experiment::new(full(0.5, 0.1), 0.02, 100 + seed);
        let track = [experiment.track()];
        let start = std::time::Instant::now();
        let found = fit(&track, &Settings::default()).unwrap();
        println!("{:?} {:?} {:?} ll {}", start.elapsed(), found.ending, found.scales, found.log_likelihood);
        println!("{:?}", found.noise);
        for (name, (_, c, _)) in FULL.iter().zip(&experiment.equations) {
            let got = found.coefficient(name).unwrap().estimate;
            println!("{name:16} {:8.4} {:8.4} +- {:7.4} {:7.4}", c.re, got.value, got.error, got.robust);
        }
    }
}
