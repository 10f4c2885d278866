//! Samples that are too far apart, against motions whose times are known.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{active_brownian, known, many};
use motiform_dynamics::Normal;
use motiform_statistics::{Quantity, Settings, Track, Tracks, autocorrelation, diffusion, statistics};
use std::f64::consts::TAU;

/// z' = -(g + i omega) z + noise of the variance 1 per component, exactly at any dt, with its rate; one turning rate or the other.
fn turning((g, omega): (f64, f64), dt: f64, samples: usize, normal: &mut Normal) -> Track {
    let omega = omega.copysign(normal.next());
    let a = (-g * dt).exp();
    let (sin, cos) = (omega * dt).sin_cos();
    let mut z = [normal.next(), normal.next()];
    let (mut mode, mut rate) = (Vec::new(), Vec::new());
    for _ in 0..samples {
        mode.push(z);
        rate.push([-g * z[0] + omega * z[1], -g * z[1] - omega * z[0]]);
        let kick = [0, 1].map(|_| (1.0 - a * a).sqrt() * normal.next());
        z = [a * (cos * z[0] + sin * z[1]) + kick[0], a * (cos * z[1] - sin * z[0]) + kick[1]];
    }
    let still = vec![[0.0; 2]; samples];
    Track { position: still.clone(), velocity: still.clone(), modes: vec![mode], rates: vec![still, rate] }
}

/// The mode of 24 bodies that turn, seen every dt.
fn seen(process: (f64, f64), dt: f64) -> motiform_statistics::Autocorrelation {
    let bodies = (0..24).map(|body| turning(process, dt, 2000, &mut Normal::new(3, body))).collect();
    let tracks = Tracks::new(dt, vec!["s".into()], bodies).unwrap();
    autocorrelation(&tracks, &tracks.sized("s").unwrap()).unwrap()
}

/// A mode that turns with the period 1 and forgets in 20: seen one to three times a period it looks slow, or fast the other way.
#[test]
fn what_turns_between_samples_has_no_times() {
    for dt in [0.26, 0.34, 0.5, 0.97, 1.0, 1.03, 1.43, 2.0, 2.459, 7.99] {
        let found = seen((0.05, TAU), dt);
        let told = found.time.reason().unwrap();
        assert!(told.starts_with("sampled too coarsely") && told.contains("every 0.07"), "{dt}: {told}");
        let frequency = found.oscillation.map(|found| found.frequency);
        assert!(frequency.is_none_or(|frequency| frequency.known().is_none()), "{dt}");
    }
    let found = seen((0.05, TAU), 0.07);
    let frequency = known(&found.oscillation.unwrap().frequency);
    assert!((frequency.value - 1.0).abs() < 2.0 * frequency.half_width(), "{frequency:?}");
}

/// A relaxing mode is seen at any sampling that the integral is right for: noise between samples does not count.
#[test]
fn noise_between_samples_is_no_motion() {
    for dt in [0.05, 0.5, 1.0] {
        let time = known(&seen((1.0, 0.0), dt).time);
        assert!((time.value - 1.0).abs() < 2.0 * time.half_width(), "{dt}: {time:?}");
    }
    assert!(seen((1.0, 0.0), 3.0).time.reason().unwrap().contains("too coarsely"));
}

/// Without rates, displacements say that the velocity turned between samples: a chiral particle seen once a period.
#[test]
fn displacements_hold_velocities_to_account() {
    let tracks = |dt: f64| many(dt, 40, |n| active_brownian((0.05, TAU, 0.01), dt, 2000, n), 5);
    let found = tracks(1.02);
    for quantity in [Quantity::Velocity, Quantity::Heading] {
        let told = autocorrelation(&found, &quantity).unwrap().time;
        assert!(told.reason().unwrap().contains("changes otherwise than its rate"), "{told:?}");
    }
    assert!(diffusion(&found).unwrap().green_kubo.known().is_none());
    let all = statistics(&found, &Settings::default()).unwrap();
    assert!(all.passages.iter().all(|passage| passage.time.mean.known().is_none()), "{:?}", all.passages);
    let fine = autocorrelation(&tracks(0.05), &Quantity::Velocity).unwrap();
    assert!((known(&fine.oscillation.unwrap().frequency).value - 1.0).abs() < 0.01);
}
