//! Points of the paper's Fig. 1 end in the state that the formulas of the reduced model predict (physics.md 1.1).

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common;

use common::{column, polar, preset, run};
use motiform_study::Dataset;
use std::f64::consts::PI;

const A1: f64 = 1.0;
const B1: f64 = 0.5;
const B3: f64 = 1.0;

/// Three small random starts, run until rates of 0.01 have decayed by e^-30.
fn ends(kappa2: f64, gamma: f64) -> Vec<Dataset> {
    let end = |seed| {
        run(&preset("fig1", |study| {
            study.set("kappa2", kappa2).unwrap();
            study.set("gamma", gamma).unwrap();
            (study.run.seed, study.run.rtol) = (seed, 1e-11);
            (study.run.transient, study.run.t_end) = (3000.0, 1.0);
        }))
    };
    [1, 2, 3].map(end).into()
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-6
}

#[test]
fn motionless_circle() {
    for (kappa2, gamma) in [(0.02, -0.0125), (0.1, -0.0375), (0.22, -0.1)] {
        for end in ends(kappa2, gamma) {
            let (r1, r2, _) = polar(&end);
            assert!(close(r1, 0.0) && close(r2, 0.0), "{kappa2} {gamma}: {r1} {r2}");
        }
    }
}

/// `r2^2 = -kappa2/(8 b3)`, stable where `gamma < -2 a1 r2`.
#[test]
fn motionless_ellipse() {
    for (kappa2, gamma) in [(-0.01, -0.1), (-0.02, -0.16)] {
        let exact = f64::sqrt(-kappa2 / (8.0 * B3));
        assert!(gamma < -2.0 * A1 * exact);
        for end in ends(kappa2, gamma) {
            let (r1, r2, _) = polar(&end);
            assert!(close(r1, 0.0) && close(r2, exact), "{kappa2} {gamma}: {r1} {r2} {exact}");
        }
    }
}

/// The signed ellipse `s` of straight motion: `kappa2 s + 8 b3 s^3 = (b1/4)(gamma - 2 a1 s)`, by bisection. For these
/// points the left side minus the right one grows with `s`, so there is one root.
fn straight(kappa2: f64, gamma: f64) -> f64 {
    assert!(kappa2 + B1 * A1 / 2.0 > 0.0, "more than one root");
    let excess = |s: f64| kappa2 * s + 8.0 * B3 * s * s * s - B1 / 4.0 * (gamma - 2.0 * A1 * s);
    let (mut low, mut high) = (-1.0, 1.0);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if excess(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// `r1^2 = gamma - 2 a1 s`, `r2 = |s|`; `psi = 0` for `s > 0` (long along the path) and `pi` for `s < 0`.
#[test]
fn straight_motion() {
    for (kappa2, gamma) in [(0.18, 0.05), (0.22, 0.1), (0.1, 0.025), (-0.1, -0.1), (-0.18, -0.1)] {
        let s = straight(kappa2, gamma);
        for end in ends(kappa2, gamma) {
            let (r1, r2, psi) = polar(&end);
            let exact = (gamma - 2.0 * A1 * s).sqrt();
            assert!(close(r1, exact) && close(r2, s.abs()), "{kappa2} {gamma}: {r1} {r2}, {exact} {s}");
            let aside = if s > 0.0 { psi } else { PI - psi.abs() };
            assert!(close(aside, 0.0), "{kappa2} {gamma}: psi = {psi}");
            assert!(column(&end, "turning_rate").iter().all(|&rate| close(rate, 0.0)));
        }
    }
}

#[test]
fn circular_motion() {
    for (kappa2, gamma) in [(-0.1, 0.1), (0.02, 0.025), (0.06, 0.1), (-0.1, 0.05)] {
        let r2_exact = f64::sqrt((2.0 * gamma - kappa2) / (32.0 * A1 / B1 + 8.0 * B3));
        let r1_exact = f64::sqrt(16.0 * A1 / B1) * r2_exact;
        let cos = (gamma - r1_exact * r1_exact) / (2.0 * A1 * r2_exact);
        for end in ends(kappa2, gamma) {
            let (r1, r2, psi) = polar(&end);
            let what = format!("{kappa2} {gamma}: {r1} {r2} {psi}, {r1_exact} {r2_exact}");
            assert!(close(r1, r1_exact) && close(r2, r2_exact), "{what}");
            assert!(close(psi.cos(), cos), "{what}");
            let rate = 2.0 * A1 * r2 * psi.sin(); // the heading is -p1
            assert!(column(&end, "turning_rate").iter().all(|&turning| close(turning, rate)), "{what}");
        }
    }
}
