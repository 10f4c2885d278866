//! Records that are not stationary, and records that are.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{along, many, ornstein_uhlenbeck};
use motiform_dynamics::Normal;
use motiform_statistics::{Settings, Statistics, Track, Tracks, statistics};

fn found(tracks: &Tracks) -> Statistics {
    statistics(tracks, &Settings::default()).unwrap()
}

/// An Ornstein-Uhlenbeck velocity of the rate 0.1 and the size `s` that starts at `s + excess` times a normal deviate.
fn relaxing(unit: f64, excess: f64, bodies: usize, seed: u64) -> Tracks {
    let body = |normal: &mut Normal| {
        let mut track = ornstein_uhlenbeck(0.1, unit, 0.5, 4000, normal);
        let start = [normal.next(), normal.next()].map(|x| unit * excess * x);
        let left = |k: usize| (-0.05 * k as f64).exp();
        track.velocity.iter_mut().enumerate().for_each(|(k, v)| {
            *v = [v[0] + start[0] * left(k), v[1] + start[1] * left(k)];
        });
        track.position.iter_mut().enumerate().for_each(|(k, x)| {
            *x = [x[0] + 10.0 * start[0] * (1.0 - left(k)), x[1] + 10.0 * start[1] * (1.0 - left(k))];
        });
        track
    };
    many(0.5, bodies, body, seed)
}

/// The start is forgotten after a hundredth of the record, and yet makes its mean square: in any unit, for many bodies and few.
#[test]
fn a_start_that_is_still_there_is_seen() {
    for (unit, bodies) in [(1.0, 40), (1e-6, 40), (1e6, 40), (1.0, 8), (1.0, 2)] {
        let seen = found(&relaxing(unit, 100.0, bodies, 7));
        let told = seen.not_stationary.unwrap();
        assert!(told.starts_with("the mean speed is") && told.contains("(transient)"), "{told}");
        assert!(seen.diffusion.green_kubo.known().or(seen.walk.diffusion.known()).is_none());
        assert!(seen.autocorrelations.iter().all(|found| found.time.known().is_none()));
    }
}

/// Of 60 stationary records, of many bodies, of 8 and of one, none is refused.
#[test]
fn stationary_records_are_not_refused() {
    for bodies in [40, 8, 1] {
        for seed in 0..20 {
            let seen = found(&relaxing(1.0, 0.0, bodies, 100 + seed));
            assert_eq!(seen.not_stationary, None, "{bodies} {seed}");
        }
    }
}

/// Circles of two sizes, each body on its own: the velocity of all seems to forget in the time in which the two get out of step, and no
/// body forgets anything. One body and one size are one motion, and so are records of ten memories (`stationary_records_are_not_refused`).
#[test]
fn bodies_of_two_motions_are_told() {
    let circle = |rate: f64, phase: f64| {
        move |t: f64| {
            let (s, c) = (rate * t + phase).sin_cos();
            ([s, -c], [rate * c, rate * s])
        }
    };
    let circles = |rates: &[f64]| {
        let bodies = rates.iter().enumerate().map(|(k, rate)| along(0.2, 3000, circle(*rate, k as f64)));
        found(&Tracks::new(0.2, vec![], bodies.collect()).unwrap())
    };
    let two = circles(&[0.30, 0.30, 0.33, 0.30, 0.33, 0.30, 0.30, 0.33, 0.30, 0.33]);
    assert!(two.unlike_bodies.unwrap().contains("(the mean speed is 0.3 to 0.33)"));
    let known = |found: &motiform_statistics::Autocorrelation| {
        found.oscillation.as_ref().is_some_and(|one| one.decay.known().is_some())
    };
    assert!(!two.autocorrelations.iter().any(known) && two.not_stationary.is_none());
    assert!(circles(&[0.3; 10]).unlike_bodies.is_none() && circles(&[0.3]).unlike_bodies.is_none());
    for seed in 0..20 {
        assert_eq!(found(&relaxing(1.0, 0.0, 12, 300 + seed)).unlike_bodies, None);
    }
}

/// Bodies that beat together, in phase, are periodic: the first tenth holds no whole number of periods.
#[test]
fn what_is_periodic_is_stationary() {
    for period in [3.0, 17.3, 41.0] {
        let beat = |t: f64| ([t, 0.0], [1.0 + 0.4 * (std::f64::consts::TAU * t / period).sin(), 0.0]);
        let bodies: Vec<Track> = (0..10).map(|_| along(0.2, 5000, beat)).collect();
        let tracks = Tracks::new(0.2, vec![], bodies).unwrap();
        assert_eq!(found(&tracks).not_stationary, None, "{period}");
    }
}

/// A speed that grows over the whole record.
#[test]
fn a_trend_is_seen() {
    let grow = |t: f64| ([t, 0.0], [1.0 + 0.001 * t, 0.0]);
    let tracks = Tracks::new(0.2, vec![], (0..10).map(|_| along(0.2, 5000, grow)).collect()).unwrap();
    assert!(found(&tracks).not_stationary.is_some());
}
