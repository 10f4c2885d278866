//! Subsets against all of them.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{Experiment, full};
use motiform_inference::{Library, Settings, TIE, fit, subsets};
use nalgebra::{DMatrix, DVector};

/// Every set of 12 coefficients, scored with a matrix inverse of its own.
#[test]
fn all_sets() {
    let names = [
        "z1: z1",
        "z1: z1* z2",
        "z1: |z1|^2 z1",
        "z1: |z2|^2 z1",
        "z2: z2",
        "z2: z1^2",
        "z2: z1* z3",
        "z2: |z1|^2 z2",
        "z3: z3",
        "z3: z1 z2",
        "z3: z1^3",
        "z3: |z1|^2 z3",
    ];
    let library = Library::tensor().select(&names).unwrap();
    let track = Experiment { frames: 150, ..Experiment::new(full(0.9, 0.1), 0.02, 3) }.track();
    let found = fit(&[track], &Settings { library, ..Settings::default() }, &()).unwrap();
    let result = subsets(&found);
    assert!(result.complete);
    let score = |kept: u32| {
        let dropped: Vec<usize> = (0..12).filter(|i| kept >> i & 1 == 0).collect();
        let n = dropped.len();
        let c = DMatrix::from_fn(n, n, |i, j| found.natural.covariance[dropped[i]][dropped[j]]);
        let theta = DVector::from_fn(n, |i, _| found.natural.coefficients[dropped[i]]);
        let cost = if n == 0 { 0.0 } else { theta.dot(&(c.try_inverse().unwrap() * &theta)) };
        cost + result.penalty * f64::from(kept.count_ones())
    };
    let mut all: Vec<(f64, u32)> = (0..1 << 12).map(|kept| (score(kept), kept)).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let ties: Vec<_> = all.iter().take_while(|(score, _)| score - all[0].0 <= TIE).collect();
    println!("{} ties", ties.len());
    assert_eq!(result.ties.len(), ties.len());
    for (set, (score, kept)) in result.ties.iter().zip(ties) {
        let bits: u32 = set.kept.iter().map(|i| 1 << i).sum();
        assert_eq!(bits, *kept);
        assert!((set.excess - (score - all[0].0)).abs() < 1e-6);
    }
    assert!(result.certain().iter().all(|name| result.best().unwrap().names.contains(name)));
}
