//! Warnings that are deserved, and none that is not.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{Experiment, FULL, full};
use motiform_inference::{Library, Settings, Track, Warning, drift, fit, warnings, whiteness};

fn settings() -> Settings {
    Settings { library: Library::tensor().select(&FULL).unwrap(), ..Settings::default() }
}

#[test]
fn none() {
    let tracks = [Experiment::new(full(0.5, 0.1), 0.02, 31).track()];
    let found = fit(&tracks, &settings(), &()).unwrap();
    let drift = drift(&tracks, &found, &()).unwrap();
    println!("{:?}", drift.changes);
    assert_eq!(drift.points.len(), 3);
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
