//! Warnings that are deserved, and none that is not.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{Experiment, FULL, VERTEX_NOISE, full};
use crate::samples::draws;
use motiform_inference::{
    DriftPoint, Library, Observation, Settings, Track, Warning, drift, fit, warnings, whiteness,
};

fn settings() -> Settings {
    Settings { library: Library::tensor().select(&FULL).unwrap(), ..Settings::default() }
}

#[test]
fn none() {
    let tracks = [Experiment::new(full(0.5, 0.1), 0.02, 31).track()];
    let found = fit(&tracks, &settings(), &()).unwrap();
    let drift = drift(&tracks, &found, &()).unwrap();
    println!("{:?}", drift.changes);
    assert_eq!(drift.points.len(), 2);
    let found = warnings(&tracks, &found, Some(&drift)).unwrap();
    assert_eq!(found, [], "{found:?}");
}

#[test]
fn coarse_sampling() {
    let mut experiment = Experiment::new(full(0.5, 0.1), 0.02, 31);
    experiment.interval = 3.0;
    experiment.frames = 300;
    let tracks = [experiment.track()];
    let found = fit(&tracks, &settings(), &()).unwrap();
    let found = warnings(&tracks, &found, None).unwrap();
    println!("{found:?}");
    assert!(found.iter().any(|warning| matches!(warning, Warning::CoarseSampling { .. })));
    assert!(found[0].to_string().contains("sample more often") || found.len() > 1);
}

/// Outlines without any error, whose stated errors are those of vertices: the factor of these is 0, at the lower bound of the search, and
/// that is no fault. Stated errors that are 1000 times too small are one.
#[test]
fn errors_that_are_not_there_are_no_fault() {
    let stated = |errors: [f64; 2], factor: f64| {
        let mut track =
            Experiment { frames: 300, errors, ..Experiment::new(full(0.5, 0.1), 0.02, 31) }.track();
        let variances = [0, 0, 1, 1, 1, 1].map(|i: usize| (factor * VERTEX_NOISE[i]).powi(2));
        for frame in &mut track.0 {
            let of = |i: usize, j: usize| if i == j { variances[i] } else { 0.0 };
            frame.covariance = (0..6).map(|i| (0..6).map(|j| of(i, j)).collect()).collect();
        }
        let found = fit(std::slice::from_ref(&track), &settings(), &()).unwrap();
        (found.noise.at_bound[0], warnings(&[track], &found, None).unwrap())
    };
    let (at_bound, found) = stated([0.0; 2], 1.0);
    println!("{at_bound} {found:?}");
    assert!(at_bound && found.iter().all(|one| !matches!(one, Warning::NoiseAtBound { .. })), "{found:?}");
    let (at_bound, found) = stated(VERTEX_NOISE, 1e-3);
    println!("{at_bound} {found:?}");
    let said = found.iter().find(|one| matches!(one, Warning::NoiseAtBound { .. })).unwrap().to_string();
    assert!(
        at_bound && said.contains("upper bound") && said.contains("factor of the stated errors"),
        "{said}"
    );
}

/// Errors of observation with a memory of some frames.
#[test]
fn coloured_noise() {
    let mut track = Experiment::new(full(0.5, 0.1), 0.01, 31).track();
    let mut normal = motiform_dynamics::Normal::new(4, 9);
    let mut slips = [0.0; 6];
    for frame in &mut track.0 {
        for (i, slip) in slips.iter_mut().enumerate() {
            *slip = 0.9 * *slip + 2.0 * frame.covariance[i][i].sqrt() * normal.next();
            frame.y[i] += *slip;
        }
    }
    let tracks = [track];
    let found = fit(&tracks, &settings(), &()).unwrap();
    assert_eq!(whiteness(&found).len(), 6);
    let drift = drift(&tracks, &found, &()).unwrap();
    let found = warnings(&tracks, &found, Some(&drift)).unwrap();
    println!("{found:?} {:?}", drift.changes);
    assert!(found.iter().any(|warning| matches!(warning, Warning::Coloured { .. })));
}

#[test]
fn missing_terms() {
    let tracks = [Experiment::new(full(0.5, 0.1), 0.02, 31).track()];
    let library = Library::tensor().select(&FULL[..8]).unwrap();
    let library =
        library.select(&["z1: z1", "z1: |z1|^2 z1", "z2: z2", "z2: z1^2", "z3: z3", "z3: z1 z2"]).unwrap();
    let found = fit(&tracks, &Settings { library, ..Settings::default() }, &()).unwrap();
    let found = warnings(&tracks, &found, None).unwrap();
    assert!(found.iter().any(|warning| matches!(warning, Warning::Coloured { .. })), "{found:?}");
}

#[test]
fn bad_input() {
    let good = Experiment { frames: 20, ..Experiment::new(full(0.5, 0.1), 0.02, 1) }.track();
    let refused = |change: &dyn Fn(&mut Track)| {
        let mut track = good.clone();
        change(&mut track);
        fit(&[track], &Settings::default(), &()).unwrap_err().to_string()
    };
    assert!(refused(&|track| track.0.truncate(5)).contains("cell 0 has 5 frames, fewer than 8"));
    assert!(
        refused(&|track| track.0[3].y[2] = f64::NAN).contains("frame 3: Re z2 is NaN; leave such frames out")
    );
    assert!(refused(&|track| track.0[3].t = 0.0).contains("frame 3: the time 0 does not follow 1;"));
    assert!(
        refused(&|track| track.0[3].covariance[1][1] = 0.0).contains("not symmetric and positive definite")
    );
    assert!(fit(&[], &Settings::default(), &()).unwrap_err().to_string().contains("there is no cell"));
    let four = Settings { library: Library::new(4, 3).unwrap(), ..Settings::default() };
    let refused = fit(&[good], &four, &()).unwrap_err().to_string();
    assert!(
        refused.contains("6 numbers with their covariance are given, and the model is fitted to 8"),
        "{refused}"
    );
    let library = Library { modes: 5, ..Library::tensor() };
    let refused = fit(&[], &Settings { library, ..Settings::default() }, &()).unwrap_err().to_string();
    assert_eq!(refused, "modes = 5: give 2, 3 or 4");
}

/// A walker whose modes fluctuate by themselves, with a rate of 0.5 and these amplitudes of their noise; errors of observation are a tenth
/// of the fluctuations.
fn fluctuating(noises: [f64; 2], seed: u64) -> Track {
    let mut normal = motiform_dynamics::Normal::new(seed, 3);
    let (keep, mut y) = (libm::exp(-0.5), [0.0; 6]);
    let mut v = [0.0; 2];
    let errors = [0.05, 0.05, 0.1 * noises[0], 0.1 * noises[0], 0.1 * noises[1], 0.1 * noises[1]];
    let frame = |k: u32| {
        for c in 0..2 {
            v[c] = 0.8 * v[c] + 0.3 * normal.next();
            y[c] += v[c];
        }
        for c in 2..6 {
            y[c] = keep * y[c] + noises[c / 2 - 1] * (1.0 - keep * keep).sqrt() * normal.next();
        }
        let seen = (0..6).map(|c| y[c] + errors[c] * normal.next()).collect();
        let squares = |c: usize| (0..6).map(|d| if c == d { errors[c] * errors[c] } else { 0.0 }).collect();
        Observation { t: f64::from(k), y: seen, covariance: (0..6).map(squares).collect() }
    };
    Track((0..400).map(frame).collect())
}

/// Noise of z3 of three quarters of that of z2 is seen in most records of 400 frames, and equal noise is not taken for unequal.
#[test]
fn unequal_noise() {
    let library = Library::tensor().select(&["z1: z1", "z2: z2", "z3: z3"]).unwrap();
    let settings = Settings { library, ..Settings::default() };
    let seen = |noises: [f64; 2], seed: u64| {
        let tracks = [fluctuating(noises, seed)];
        let found = fit(&tracks, &settings, &()).unwrap();
        let all = warnings(&tracks, &found, None).unwrap();
        all.into_iter()
            .any(|warning| matches!(warning, Warning::UnequalNoise(found) if found.modes == [2, 3]))
    };
    let count = |noises| (0..draws(8, 20)).filter(|&seed| seen(noises, seed)).count();
    let counts = [count([0.3, 0.3]), count([0.3, 0.22])];
    println!("{counts:?}");
    assert!(counts[0] == 0 && counts[1] >= draws(4, 15), "{counts:?}");
}

/// Fits of fewer frames that do not count change nothing and say why: a change of 0 would read as agreement.
#[test]
fn what_is_not_counted_is_no_agreement() {
    let mut experiment = Experiment::new(full(0.5, 0.1), 0.02, 31);
    experiment.frames = 60;
    let tracks = [experiment.track()];
    let found = drift(&tracks, &fit(&tracks, &Settings::default(), &()).unwrap(), &()).unwrap();
    assert_eq!(found.changes, vec![None; 22]);
    let why: Vec<_> = found.points.iter().map(|point| point.estimates.clone().unwrap_err()).collect();
    assert_eq!(why[0], "30 frames are left, and 22 coefficients need 66: track longer");
    // every fourth frame is twelve natural times apart: no law is found from there
    (experiment.frames, experiment.interval) = (400, 3.0);
    let tracks = [experiment.track()];
    let found = drift(&tracks, &fit(&tracks, &settings(), &()).unwrap(), &()).unwrap();
    let counted = found.points.iter().filter(|point| point.estimates.is_ok()).count();
    assert!(found.changes.iter().all(|change| change.is_some() == (counted > 0)));
    let reason =
        |point: &DriftPoint| point.estimates.as_ref().is_err_and(|why| why.contains("did not converge"));
    println!("{:?}", found.points);
    assert!(counted < found.points.len() && found.points.iter().any(reason), "{:?}", found.points);
    let stated = |point: &DriftPoint| {
        point.estimates.is_ok() != point.estimates.as_ref().is_err_and(|why| !why.is_empty())
    };
    assert!(found.points.iter().all(stated), "each has estimates or a reason: {:?}", found.points);
}
