//! Places on the paper's planes.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common::{Experiment, FULL, circle, full};
use motiform_dynamics::Complex;
use motiform_inference::{
    Library, Observation, Placement, Plane, Settings, Track, fit, place, place_among, select,
};

/// The same motion in other units: lengths, modes and times multiplied (both modes alike, as they share one process noise).
fn in_units(track: &Track, (length, mode, time): (f64, f64, f64)) -> Track {
    let unit = [length, length, mode, mode, mode, mode];
    let frame = |frame: &Observation| Observation {
        t: frame.t * time,
        y: (0..6).map(|i| frame.y[i] * unit[i]).collect(),
        covariance: (0..6)
            .map(|i| (0..6).map(|j| frame.covariance[i][j] * unit[i] * unit[j]).collect())
            .collect(),
    };
    Track(track.0.iter().map(frame).collect())
}

#[test]
fn in_any_units() {
    let mut experiment = Experiment::new(full(0.5, 0.1), 0.005, 21);
    experiment.frames = 500;
    let track = experiment.track();
    let settings = Settings { library: Library::tensor().select(&FULL).unwrap(), ..Settings::default() };
    let mut before: Option<[f64; 2]> = None;
    for units in [(1.0, 1.0, 1.0), (3.0, 5.0, 20.0)] {
        let found = fit(&[in_units(&track, units)], &settings, &()).unwrap();
        let Placement::Placed(placed) = place(&found, Plane::Full) else {
            panic!("{:?}", place(&found, Plane::Full))
        };
        let at = [0, 1].map(|i| placed.coordinates[i].estimate);
        println!(
            "{at:.4?} units {:.3?} distance {:.3} {:.1}",
            placed.units, placed.distance, placed.deviation
        );
        for (estimate, truth) in at.iter().zip([0.5, 0.1]) {
            assert!((estimate.value - truth).abs() < 3.5 * estimate.error, "{estimate:?}");
            assert!(estimate.error < 0.1);
        }
        assert!((placed.units[0] / units.2 - 1.0).abs() < 0.05, "T = 1/gamma");
        assert!((placed.units[2] / units.1 - 1.0).abs() < 0.05, "L2");
        assert!(placed.deviation < 3.5 && placed.distance < 0.1);
        let values = at.map(|estimate| estimate.value);
        if let Some(before) = before {
            assert!(
                (0..2).all(|i| (values[i] - before[i]).abs() < 0.02 * at[i].error),
                "{values:?} {before:?}"
            );
        }
        before = Some(values);
    }
}

/// Fig. 3 of the paper (quasi-periodic), reduced model; and its mirror image in z2, which is the same motion.
#[test]
fn reduced_plane() {
    let term = |equation, c: f64, factors: &[i32]| (equation, Complex::new(c, 0.0), factors.to_vec());
    for sign in [1.0, -1.0] {
        let equations = vec![
            term(1, 0.02, &[1]),
            term(1, -2.0 * sign, &[-1, 2]),
            term(1, -1.0, &[1, 1, -1]),
            term(2, 0.06, &[2]),
            term(2, 0.125 * sign, &[1, 1]),
            term(2, -8.0, &[2, 2, -2]),
            term(3, -1.0, &[3]),
        ];
        let mut experiment = Experiment::new(equations, 0.002, 3);
        experiment.start = [0.1, 0.05, 0.0, 0.0].map(|x| Complex::new(x, 0.3 * x));
        experiment.interval = 1.0;
        experiment.frames = 600;
        experiment.errors = [0.001, 0.0005];
        let tracks = [experiment.track()];
        let whole = fit(&tracks, &Settings::default(), &()).unwrap();
        let selection = select(&tracks, &whole, &()).unwrap();
        let answer = place_among(&whole, &selection, Plane::Reduced);
        let Placement::Placed(placed) = answer else { panic!("{answer:?}") };
        for (coordinate, truth) in placed.coordinates.iter().zip([-0.06, 0.02]) {
            println!("{coordinate:?}");
            let estimate = coordinate.estimate;
            assert!((estimate.value - truth).abs() < 3.5 * estimate.error, "{coordinate:?}");
        }
        assert!(placed.units[2] * sign > 0.0 && placed.deviation < 3.5, "{placed:?}");
        assert!(matches!(place_among(&whole, &selection, Plane::Full), Placement::Refused { .. }));
    }
}

#[test]
fn refusals() {
    let mut short = Experiment::new(full(0.5, 0.1), 0.02, 7);
    short.frames = 30;
    let mut still = Experiment::new(full(1.5, 1.0), 0.01, 7);
    still.frames = 300;
    still.equations[0].1.re = -0.5;
    let fitted = |experiment: Experiment| {
        let tracks = [experiment.track()];
        let whole = fit(&tracks, &Settings::default(), &()).unwrap();
        (tracks, whole)
    };
    for (name, body) in [("circular", circle()), ("short", &fitted(short)), ("still", &fitted(still))] {
        let (tracks, whole) = body;
        let selection = select(tracks, whole, &()).unwrap();
        println!(
            "{name}: {} ties, {:?}",
            selection.subsets.ties.len(),
            selection.subsets.best().unwrap().names
        );
        for plane in [Plane::Full, Plane::Reduced] {
            let answer = place_among(whole, &selection, plane);
            let Placement::Refused { reasons } = answer else { panic!("{name}: {answer:?}") };
            println!("  {reasons:?}");
        }
    }
}
