//! Fits of cells whose noise is not as the model has it: they end at a maximum, or say why there is none.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use super::common::{Experiment, VERTEX_NOISE, full};
use motiform_dynamics::{Normal, Watch};
use motiform_inference::{Ending, Error, Observation, Settings, Track, fit, identifiability};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// A chaotic cell whose position jumps in some frames, by several times its usual path between frames: velocities with heavy tails.
fn jumping(seed: u64, share: f64) -> Track {
    let mut track = Experiment { frames: 300, ..Experiment::new(full(0.5, 0.1), 0.02, seed) }.track();
    let mut random = Normal::new(seed, 7);
    let mut slip = [0.0; 2];
    for frame in &mut track.0 {
        if random.uniform() < share {
            slip.iter_mut().for_each(|x| *x += random.next());
        }
        (frame.y[0], frame.y[1]) = (frame.y[0] + slip[0], frame.y[1] + slip[1]);
    }
    track
}

#[test]
fn noise_with_heavy_tails_ends_at_a_maximum_or_with_a_reason() {
    for (seed, share) in [(1, 0.02), (2, 0.1), (3, 0.3)] {
        let found = fit(&[jumping(seed, share)], &Settings::default(), &()).unwrap();
        match &found.ending {
            Ending::Converged { evaluations } => assert!(*evaluations <= 400),
            Ending::Stopped { reason } => {
                assert!(!reason.contains("not enough"), "seed {seed}: {reason}");
                assert!(!identifiability(&found).identifiable);
            }
        }
    }
}

/// Integrated too coarsely, the covariance of fast modes is no longer positive definite, and the likelihood has maxima that are errors.
#[test]
fn a_velocity_that_forgets_within_a_frame_converges() {
    let mut equations = full(0.5, 0.1);
    equations[0].1.re = -12.0; // the velocity is forgotten in 1/12 of a natural time, six times within a frame
    let experiment = Experiment {
        frames: 400,
        eta: [3.0, 0.05],
        errors: VERTEX_NOISE,
        ..Experiment::new(equations, 0.1, 5)
    };
    let found = fit(&[experiment.track()], &Settings::default(), &()).unwrap();
    assert!(found.converged(), "{:?}", found.ending);
}

/// Outlines of a steady circle with errors of 0.004: no equations follow from them. The search for them ends where they are too fast
/// for the frames, and not after a million steps; 200 frames lead there as 400 do.
#[test]
fn a_steady_circle_leads_to_no_long_search() {
    let mut random = Normal::new(4, 0);
    let frame = |k: i32| {
        let angle = 0.1 * f64::from(k);
        let [[s1, c1], [s2, c2], [s3, c3]] =
            [1.0, 2.0, 3.0].map(|n| [libm::sin(n * angle), libm::cos(n * angle)]);
        let exact = [5.0 * s1, -5.0 * c1, 0.6 * c2, -0.6 * s2, 0.15 * c3, -0.15 * s3];
        let y = exact.map(|x| x + 0.004 * random.next()).to_vec();
        let row = |i: usize| (0..6).map(|j| if i == j { 1.6e-5 } else { 0.0 }).collect();
        Observation { t: f64::from(k), y, covariance: (0..6).map(row).collect() }
    };
    let found = fit(&[Track((0..200).map(frame).collect())], &Settings::default(), &()).unwrap();
    let Ending::Stopped { reason } = &found.ending else { panic!("{:?}", found.ending) };
    assert!(reason.contains("too fast for the interval between frames"), "{reason}");
    assert!(!identifiability(&found).identifiable);
}

/// Stops after some questions.
struct Patience(AtomicUsize);

impl Watch for Patience {
    fn stopped(&self) -> bool {
        self.0.fetch_add(1, Ordering::Relaxed) >= 3
    }
}

#[test]
fn a_watch_stops_a_search() {
    let track = Experiment { frames: 100, ..Experiment::new(full(0.5, 0.1), 0.02, 1) }.track();
    let tracks = [track];
    let stopped = fit(&tracks, &Settings::default(), &AtomicBool::new(true));
    assert_eq!(stopped.unwrap_err(), Error::Interrupted);
    let patience = Patience(AtomicUsize::new(0));
    assert_eq!(fit(&tracks, &Settings::default(), &patience).unwrap_err(), Error::Interrupted);
    assert!(patience.0.into_inner() < 20, "it goes on after a stop");
}
