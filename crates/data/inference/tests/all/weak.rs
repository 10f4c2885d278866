//! The weak form on exact tracks.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{Experiment, FULL, full};
use motiform_dynamics::Complex;
use motiform_inference::{Library, Observation, Track, weak};

/// Equations without terms are no matter: the others are estimated.
#[test]
fn equations_without_terms() {
    let mut experiment = Experiment::new(full(0.5, 0.1), 0.0, 1);
    (experiment.interval, experiment.errors) = (0.1, [1e-6; 2]);
    let library = Library::tensor().select(&FULL[..6]).unwrap();
    let found = weak(&[experiment.track()], &library, [0.0; 2]).unwrap();
    assert!((found.coefficients[0].unwrap() - 1.0).abs() < 0.1);
}

#[test]
fn exact_tracks() {
    let mut experiment = Experiment::new(full(0.5, 0.1), 0.0, 1);
    experiment.interval = 0.1;
    experiment.errors = [0.0; 2];
    let found = weak(&[experiment.track()], &Library::tensor(), [0.0; 2]).unwrap();
    let c: Vec<f64> = found.coefficients.iter().copied().collect::<Option<_>>().unwrap();
    for (name, (_, truth, _)) in FULL.iter().zip(&experiment.equations) {
        let place = found.names.iter().position(|known| known == name).unwrap();
        println!("{name} {} {}", truth.re, c[place]);
        assert!((c[place] - truth.re).abs() < 0.05 * truth.re.abs().max(0.02), "{name}");
    }
}

/// A frame moved along x.
fn frame_at(frame: &Observation, by: f64) -> Observation {
    let mut moved = frame.clone();
    moved.y[0] += by;
    moved
}

/// Velocity and modes that noise sustains, `dz = -c z dt + eta dW`: over a window `eta int phi dW` has more variance than the left side,
/// whose expected product with `int phi z` is 0 whatever c. Without the noise being told the estimates of modes that forget within a window
/// are about 0.
#[test]
fn what_noise_sustains_has_none() {
    let term = |equation, c: f64, factors: &[i32]| (equation, Complex::new(c, 0.0), factors.to_vec());
    let equations = vec![term(1, -0.1, &[1]), term(2, -0.5, &[2]), term(3, -0.7, &[3])];
    let mut experiment = Experiment::new(equations, 0.2, 7);
    (experiment.frames, experiment.errors) = (4000, [1e-6; 2]);
    let library = Library::tensor().select(&["z1: z1", "z2: z2", "z3: z3"]).unwrap();
    let tracks = [experiment.track()];
    let moved = |by: f64| Track(tracks[0].0.iter().map(|frame| frame_at(frame, by)).collect());
    let far = weak(&[moved(1e4)], &library, [0.0; 2]).unwrap().coefficients;
    let blind = weak(&tracks, &library, [0.0; 2]).unwrap();
    for (c, truth) in blind.coefficients.iter().zip([0.1, 0.5, 0.7]) {
        println!("{:.3} for -{truth}", c.unwrap());
        assert!(c.unwrap().abs() < 0.3 * truth, "{c:?} {truth}");
    }
    for (near, far) in blind.coefficients.iter().zip(far) {
        assert!((near.unwrap() - far.unwrap()).abs() < 1e-6, "the place is no matter: {near:?} {far:?}");
    }
    let found = weak(&tracks, &library, [0.2, 0.1]).unwrap();
    println!("{:?}", found.reasons);
    assert_eq!((found.coefficients, found.reasons.len()), (vec![None; 3], 3));
    assert!(found.reasons[0].starts_with("equation of z1: noise makes "), "{}", found.reasons[0]);
    // zigzag: noise of a fortieth of that
    let mut zigzag = Experiment::new(full(0.9, 0.5), 0.005, 7);
    zigzag.frames = 1000;
    let found = weak(&[zigzag.track()], &Library::tensor().select(&FULL).unwrap(), [0.005, 0.0025]).unwrap();
    assert!(found.coefficients.iter().all(Option::is_some), "{:?}", found.reasons);
}

/// A speed of its own and a heading that noise alone turns, `dz1 = (g - g |z1|^2) z1 dt + eta dW`: on the circle of its speed the law has
/// no rate, and what the windows see is noise and errors of the places. No sign is stated, whatever the sampling.
#[test]
fn a_velocity_that_noise_alone_turns_has_none() {
    let term = |equation, c: f64, factors: &[i32]| (equation, Complex::new(c, 0.0), factors.to_vec());
    for (interval, seed) in [(0.25, 3), (0.5, 4), (1.0, 5)] {
        let equations =
            vec![term(1, 1.0, &[1]), term(1, -1.0, &[1, 1, -1]), term(2, -0.5, &[2]), term(3, -0.7, &[3])];
        let mut experiment = Experiment::new(equations, 0.08, seed);
        (experiment.frames, experiment.interval, experiment.errors) = (300, interval, [0.02; 2]);
        let library = Library::tensor().select(&["z1: z1", "z1: |z1|^2 z1", "z2: z2", "z3: z3"]).unwrap();
        let found = weak(&[experiment.track()], &library, [0.08, 0.04]).unwrap();
        assert_eq!(found.coefficients[..2], [None; 2], "{interval}: {found:?}");
    }
}
