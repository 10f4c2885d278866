//! Places on the paper's planes.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use crate::common::{Experiment, FULL, full};
use motiform_inference::{
    Library, Observation, Placement, Plane, Settings, Track, fit, place, place_among, select,
};

/// The same motion in other units: lengths, modes and times multiplied (both modes alike, as they share one process noise).
fn in_units(track: &Track, (length, mode, time): (f64, f64, f64)) -> Track {
    let unit = [length, length, mode, mode, mode, mode];
    let frame = |frame: &Observation| Observation {
        t: frame.t * time,
        y: std::array::from_fn(|i| frame.y[i] * unit[i]),
        covariance: std::array::from_fn(|i| {
            std::array::from_fn(|j| frame.covariance[i][j] * unit[i] * unit[j])
        }),
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
        let found = fit(&[in_units(&track, units)], &settings).unwrap();
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

#[test]
fn refusals() {
    let mut circular = Experiment::new(full(0.5, 0.3), 0.0, 7);
    circular.frames = 300;
    let mut short = Experiment::new(full(0.5, 0.1), 0.02, 7);
    short.frames = 30;
    let mut still = Experiment::new(full(1.5, 1.0), 0.01, 7);
    still.frames = 300;
    still.equations[0].1.re = -0.5;
    for (name, experiment) in [("circular", circular), ("short", short), ("still", still)] {
        let tracks = [experiment.track()];
        let whole = fit(&tracks, &Settings::default()).unwrap();
        let selection = select(&tracks, &whole).unwrap();
        println!(
            "{name}: {} ties, {:?}",
            selection.subsets.ties.len(),
            selection.subsets.best().unwrap().names
        );
        for plane in [Plane::Full, Plane::Reduced] {
            let answer = place_among(&whole, &selection, plane);
            let Placement::Refused { reasons } = answer else { panic!("{name}: {answer:?}") };
            println!("  {reasons:?}");
        }
    }
}
