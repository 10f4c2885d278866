//! Studies run in memory, and what is read off their trajectories.
#![allow(dead_code, unreachable_pub, reason = "each test binary uses its own part")]
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_lab::simulate::simulate;
use motiform_models::ModelInfo;
use motiform_study::{Dataset, RunPlan, Study, presets};

pub fn tensor() -> &'static ModelInfo {
    ModelInfo::find("tensor").unwrap()
}

/// A preset, changed.
pub fn preset(name: &str, change: impl FnOnce(&mut Study)) -> Study {
    let mut study = presets::find_any(name, "tensor").unwrap();
    change(&mut study);
    study
}

pub fn run(study: &Study) -> Dataset {
    simulate(&RunPlan::new(study).unwrap(), &()).unwrap()
}

/// A column of the trajectory.
pub fn column<'d>(dataset: &'d Dataset, name: &str) -> &'d [f64] {
    dataset.trajectory.get(name).unwrap()
}

/// The heading at each row (rad), without jumps.
pub fn headings(dataset: &Dataset) -> Vec<f64> {
    let mut last = 0.0_f64;
    let velocities = column(dataset, "v1").iter().zip(column(dataset, "v2"));
    velocities
        .map(|(vx, vy)| {
            let turn = (vy.atan2(*vx) - last).rem_euclid(std::f64::consts::TAU);
            last += if turn > std::f64::consts::PI { turn - std::f64::consts::TAU } else { turn };
            last
        })
        .collect()
}

/// The polar state of the reduced model at the end: `(r1, r2, psi)` with `z1 = v1 - i v2 = r1 e^(i p1)`,
/// `z2 = (S11 - i S12)/2 = r2 e^(i p2)`, `psi = p2 - 2 p1` in -pi..pi (physics.md 1.1).
pub fn polar(dataset: &Dataset) -> (f64, f64, f64) {
    let state = &dataset.manifest.state;
    let of = |name: &str| state.get(name).unwrap();
    let (r1, p1) = (of("v1").hypot(of("v2")), (-of("v2")).atan2(of("v1")));
    let (r2, p2) = (0.5 * of("s11").hypot(of("s12")), (-of("s12")).atan2(of("s11")));
    let psi = (p2 - 2.0 * p1).rem_euclid(std::f64::consts::TAU);
    (r1, r2, if psi > std::f64::consts::PI { psi - std::f64::consts::TAU } else { psi })
}
