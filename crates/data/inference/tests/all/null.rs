//! Persistent random walks against motions.

use crate::common::{Equations, Experiment, full};
use crate::samples::draws;
use motiform_dynamics::Complex;
use motiform_inference::{Fit, Selection, Settings, Track, WALK_RATE, fit, refit_with, select, walk_p_value};

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
    for seed in 0..draws(3, 8) {
        let (p, names) = p_value(walk.clone(), 0.2, 900 + seed);
        println!("walk {seed}: {p:.1e} {names:?}");
        assert!(p > WALK_RATE, "{seed}: {p:.1e} {names:?}");
    }
    let (p, names) = p_value(full(1.5, 0.9), 0.02, 5);
    println!("straight: {p:.1e} {names:?}");
    assert!(p < 1e-12, "{p:.1e} {names:?}");
}

/// `P(chi^2 > x)` with n degrees of freedom: `Q_n = Q_(n-2) + (x/2)^(n/2 - 1) exp(-x/2)/Gamma(n/2)`.
fn tail(x: f64, n: usize) -> f64 {
    let (mut q, mut k) = match n % 2 {
        0 => (libm::exp(-0.5 * x), 2),
        _ => (libm::erfc((0.5 * x).sqrt()), 1),
    };
    while k < n {
        k += 2;
        let half = 0.5 * k as f64;
        q += libm::exp((half - 1.0) * libm::log(0.5 * x) - 0.5 * x - libm::lgamma(half));
    }
    q
}

/// The p-value from the walk at its maximum, and its degrees of freedom.
fn at_the_maximum(tracks: &[Track], whole: &Fit, selection: &Selection) -> (f64, usize) {
    let kept = &selection.subsets.best().expect("a set").kept;
    let of_shape = |i: usize| whole.coefficients[i].term.equation > 0;
    let is_decay = |i: usize| whole.coefficients[i].name == "z1: z1";
    let stays = |i: &usize| is_decay(*i) || (of_shape(*i) && kept.contains(i));
    let null: Vec<usize> = (0..whole.coefficients.len()).filter(stays).collect();
    let more = kept.iter().filter(|i| !of_shape(**i) && !is_decay(**i)).count();
    let walk = refit_with(tracks, whole, &null, &()).expect("a fit");
    (tail(2.0 * (selection.fit.log_likelihood - walk.log_likelihood).max(0.0), more), more)
}

/// Where the search ends before the walk's maximum the value is a bound from above; elsewhere it is the same.
#[test]
fn values_far_from_a_walk_are_bounds() {
    let motions =
        [(full(0.5, 0.1), 0.02), (full(0.9, 0.1), 0.01), (full(1.5, 0.9), 0.03), (full(0.5, 0.5), 0.1)];
    for (number, (equations, eta)) in motions.into_iter().enumerate() {
        for seed in 3..draws(4, 5) {
            let frames = 200;
            let experiment = Experiment { frames, ..Experiment::new(equations.clone(), eta, seed) };
            let tracks = [experiment.track()];
            let whole = fit(&tracks, &Settings::default(), &()).expect("a fit");
            let selection = select(&tracks, &whole, &()).expect("a fit");
            let p = walk_p_value(&tracks, &whole, &selection, &()).expect("a fit");
            let (best, more) = at_the_maximum(&tracks, &whole, &selection);
            println!("{number} {seed}: {p:.2e} at the maximum {best:.2e}, {more} terms");
            assert!(p >= best * (1.0 - 1e-3), "{number} {seed}: {p:.2e} {best:.2e}");
            assert!(p < 1e-8 || (p - best).abs() < 0.02 * best, "{number} {seed}: {p:.2e} {best:.2e}");
        }
    }
}
