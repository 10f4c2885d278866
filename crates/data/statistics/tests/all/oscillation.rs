//! Correlations that oscillate: frequency and decay.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{active_brownian, agrees, along, known, many, ornstein_uhlenbeck};
use motiform_dynamics::Normal;
use motiform_statistics::{Quantity, Track, Tracks, autocorrelation};
use std::f64::consts::TAU;

/// A damped harmonic oscillator driven by noise, from independent exponentials: the complex number z' = -(l +
/// i w) z + noise, whose real part correlates as e^{-l t} cos w t; exact at any dt.
fn oscillator((l, w): (f64, f64), dt: f64, samples: usize, normal: &mut Normal) -> Vec<[f64; 2]> {
    let size = (-l * dt).exp();
    let (c, s, kick) = (size * (w * dt).cos(), size * (w * dt).sin(), (1.0 - size * size).sqrt());
    let mut z = [[normal.next(), normal.next()], [normal.next(), normal.next()]];
    let mut found = Vec::new();
    for _ in 0..samples {
        found.push([z[0][0], z[1][0]]); // two independent ones: the real parts are a vector without a sense of turning
        for [x, y] in &mut z {
            (*x, *y) = (c * *x - s * *y + kick * normal.next(), c * *y + s * *x + kick * normal.next());
        }
    }
    found
}

#[test]
fn a_damped_oscillator_has_its_frequency_decay_and_integral() {
    let (l, w) = (0.05, 0.4);
    for dt in [0.5, 1.0, 2.0] {
        let samples = (2000.0 / dt) as usize;
        let body = |normal: &mut Normal| {
            let mode = oscillator((l, w), dt, samples, normal);
            Track { modes: vec![mode], ..along(dt, samples, |t| ([t, 0.0], [1.0, 0.0])) }
        };
        let bodies = (0..30).map(|k| body(&mut Normal::new(21, k))).collect();
        let tracks = Tracks::new(dt, vec!["s".into()], bodies).unwrap();
        let found = autocorrelation(&tracks, &tracks.sized("s").unwrap()).unwrap();
        let oscillation = found.oscillation.unwrap();
        assert!(agrees(known(&oscillation.frequency), w / TAU, 1.5), "{dt}: {oscillation:?}");
        assert!(agrees(known(&oscillation.decay), 1.0 / l, 1.5), "{dt}: {oscillation:?}");
        // 0.308: a fiftieth of the decay time
        assert!(agrees(known(&found.time), l / (l * l + w * w), 1.5), "{dt}: {:?}", found.time);
        assert!(known(&found.time).half_width() < 0.1);
    }
}

#[test]
fn a_chiral_particle_oscillates_and_an_unhanded_one_does_not() {
    let tracks = many(0.5, 40, |normal| active_brownian((0.1, 0.3, 0.0), 0.5, 800, normal), 22);
    let found = autocorrelation(&tracks, &Quantity::Velocity).unwrap().oscillation.unwrap();
    assert!(
        agrees(known(&found.frequency), 0.3 / TAU, 1.5) && agrees(known(&found.decay), 10.0, 1.5),
        "{found:?}"
    );
    let tracks = many(0.5, 40, |normal| ornstein_uhlenbeck(0.2, 1.0, 0.5, 800, normal), 23);
    assert_eq!(autocorrelation(&tracks, &Quantity::Velocity).unwrap().oscillation, None);
}

#[test]
fn a_circle_has_a_frequency_and_no_decay() {
    let turn = |t: f64| ([t.cos(), t.sin()], [-t.sin(), t.cos()]);
    let tracks = Tracks::new(0.1, vec![], vec![along(0.1, 8000, turn)]).unwrap();
    let found = autocorrelation(&tracks, &Quantity::Velocity).unwrap().oscillation.unwrap();
    assert!((known(&found.frequency).value * TAU - 1.0).abs() < 1e-6, "{found:?}");
    assert!(found.decay.reason().unwrap().starts_with("not reached"), "{found:?}");
}

/// Two frequencies are not one.
#[test]
fn a_sum_of_oscillations_is_not_one() {
    let body = |normal: &mut Normal| {
        let one = oscillator((0.05, 0.4), 0.5, 2000, normal);
        let other = oscillator((0.05, 1.1), 0.5, 2000, normal);
        let mode = one.iter().zip(&other).map(|(a, b)| [a[0] + b[0], a[1] + b[1]]).collect();
        Track { modes: vec![mode], ..along(0.5, 2000, |t| ([t, 0.0], [1.0, 0.0])) }
    };
    let bodies = (0..20).map(|k| body(&mut Normal::new(24, k))).collect();
    let tracks = Tracks::new(0.5, vec!["s".into()], bodies).unwrap();
    let found = autocorrelation(&tracks, &tracks.sized("s").unwrap()).unwrap().oscillation.unwrap();
    assert!(found.frequency.reason().unwrap().starts_with("not as one damped cosine"), "{found:?}");
}
