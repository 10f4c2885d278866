//! Persistent random walks against motions.

use crate::common::{Equations, Experiment, full};
use motiform_dynamics::Complex;
use motiform_inference::{Settings, WALK_RATE, fit, select, walk_p_value};

fn p_value(equations: Equations, eta: f64, seed: u64) -> (f64, Vec<String>) {
    let experiment = Experiment { frames: 300, ..Experiment::new(equations, eta, seed) };
    let tracks = [experiment.track()];
    let whole = fit(&tracks, &Settings::default(), &()).expect("a fit");
    let selection = select(&tracks, &whole, &()).expect("a fit");
    let p = walk_p_value(&tracks, &whole, &selection, &()).expect("a fit");
    (p, selection.subsets.best().map(|set| set.names.clone()).unwrap_or_default())
}

/// Velocities that decay in ten units of time, shapes that fluctuate by themselves: whatever terms are selected
/// by chance, the walk is not excluded. A cell that moves straight by its equations excludes it.
#[test]
fn walks_are_not_excluded_and_motions_exclude_them() {
    let term = |equation, c: f64, factors: &[i32]| (equation, Complex::new(c, 0.0), factors.to_vec());
    let walk = vec![term(1, -0.1, &[1]), term(2, -0.5, &[2]), term(3, -0.7, &[3])];
    for seed in 0..8 {
        let (p, names) = p_value(walk.clone(), 0.2, 900 + seed);
        println!("walk {seed}: {p:.1e} {names:?}");
        assert!(p > WALK_RATE, "{seed}: {p:.1e} {names:?}");
    }
    let (p, names) = p_value(full(1.5, 0.9), 0.02, 5);
    println!("straight: {p:.1e} {names:?}");
    assert!(p < 1e-12, "{p:.1e} {names:?}");
}
