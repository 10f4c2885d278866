//! Simulated cells for `bench/inference`, and what this crate finds in them: `cells FOLDER COUNT`.
//!
//! Writes `CELL.csv` (time, the six observed numbers) and `fits.csv` (cell, term, truth, value, standard error, seconds).

#![allow(clippy::unwrap_used, reason = "a measurement may fail")]

#[path = "../tests/all/common.rs"]
#[allow(dead_code, reason = "shared with the tests")]
mod common;

use common::{Experiment, FULL, full};
use motiform_inference::{Fit, Settings, fit, weak};
use std::fmt::Write;
use std::time::Instant;

fn main() {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().unwrap();
    let count: u64 = arguments.next().unwrap().parse().unwrap();
    let mut fits = "method,cell,term,truth,value,error,seconds\n".to_owned();
    for cell in 0..count {
        let experiment = Experiment::new(full(0.5, 0.1), 0.02, 100 + cell);
        let tracks = [experiment.track()];
        let mut text = "t,x,y,z2_re,z2_im,z3_re,z3_im\n".to_owned();
        for frame in &tracks[0].0 {
            _ = write!(text, "{}", frame.t);
            frame.y.iter().for_each(|y| _ = write!(text, ",{y}"));
            text.push('\n');
        }
        std::fs::write(format!("{folder}/{cell}.csv"), text).unwrap();
        let start = Instant::now();
        let found: Fit = fit(&tracks, &Settings::default(), &()).unwrap();
        let seconds = start.elapsed().as_secs_f64();
        let start = Instant::now();
        let witness = weak(&tracks, &Settings::default().library, [0.0; 2]).unwrap();
        let quick = start.elapsed().as_secs_f64();
        for (i, c) in found.coefficients.iter().enumerate() {
            let known = FULL.iter().position(|name| *name == c.name);
            let truth = known.map_or(0.0, |place| experiment.equations[place].1.re);
            let (name, e) = (&c.name, c.estimate);
            _ = writeln!(fits, "likelihood,{cell},{name},{truth},{},{},{seconds}", e.value, e.error);
            let value = witness.coefficients[i].unwrap_or(f64::NAN);
            _ = writeln!(fits, "weak,{cell},{name},{truth},{value},,{quick}");
        }
    }
    std::fs::write(format!("{folder}/fits.csv"), fits).unwrap();
}
