//! Correlations that oscillate: frequency and decay.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{active_brownian, agrees, along, holds, known, many, ornstein_uhlenbeck};
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
    assert!(found.decay.reason().unwrap().contains("goes on undiminished"), "{found:?}");
    let time = autocorrelation(&tracks, &Quantity::Velocity).unwrap().time;
    assert!(time.reason().unwrap().ends_with("no longer record changes that"), "{time:?}");
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

/// The heading of a velocity whose components are damped oscillations has higher powers of the damped cosine in its correlation: those
/// decay sooner, and the time of what is left is that of the components, at any scale of time.
#[test]
fn the_slowest_of_several_parts_is_in_the_interval_of_the_decay() {
    for scale in [1.0, 40.0] {
        let (l, w, dt) = (0.15 / scale, 0.99 / scale, 0.1 * scale);
        let (mut count, mut frequencies, mut decays) = (0, 0, 0);
        for seed in 0..40 {
            let body = |normal: &mut Normal| {
                let velocity = oscillator((l, w), dt, 2000, normal);
                let mut x = [0.0; 2];
                let mut step = |pair: &[[f64; 2]]| {
                    x = [0, 1].map(|k| x[k] + 0.5 * dt * (pair[0][k] + pair[1][k]));
                    x
                };
                let position = std::iter::once([0.0; 2]).chain(velocity.windows(2).map(&mut step)).collect();
                Track { position, velocity, ..Track::default() }
            };
            let tracks = many(dt, 20, body, 300 + seed);
            let found = autocorrelation(&tracks, &Quantity::Heading).unwrap().oscillation.unwrap();
            let (Some(frequency), Some(decay)) = (found.frequency.known(), found.decay.known()) else {
                continue;
            };
            count += 1;
            frequencies += usize::from(holds(frequency, w / TAU));
            decays += usize::from(holds(decay, 1.0 / l));
        }
        println!("{frequencies} and {decays} of {count}");
        assert!(
            count >= 20 && frequencies + 4 >= count && decays + 4 >= count,
            "{frequencies} and {decays} of {count}"
        );
    }
}

/// A velocity that is the rate of change of a bounded oscillation has the integral 0, however it is sampled: that is no coarse sampling,
/// and its frequency and decay are known.
#[test]
fn an_integral_of_zero_is_bounded_and_the_oscillation_known() {
    let (friction, samples) = (0.3, 2000);
    for scale in [1.0, 30.0] {
        let dt = 0.1 * scale;
        let body = |normal: &mut Normal| {
            let (mut x, mut v, h) = ([0.0; 2], [0.7, -0.7], 0.01_f64);
            let mut track = Track::default();
            for step in 0..10 * (samples + 1000) {
                for k in 0..2 {
                    v[k] += h * (-friction * v[k] - x[k]) + 0.3 * h.sqrt() * normal.next();
                    x[k] += h * v[k];
                }
                if step >= 10_000 && step % 10 == 0 {
                    track.position.push(x.map(|x| x * scale));
                    track.velocity.push(v);
                }
            }
            track
        };
        for seed in 0..4 {
            let tracks = many(dt, 20, body, 400 + seed);
            let found = autocorrelation(&tracks, &Quantity::Velocity).unwrap();
            let oscillation = found.oscillation.unwrap();
            assert!(agrees(known(&oscillation.frequency), 0.988_7 / TAU / scale, 2.0), "{oscillation:?}");
            assert!(agrees(known(&oscillation.decay), 2.0 * scale / friction, 2.0), "{oscillation:?}");
            if let Some(reason) = found.time.reason() {
                assert!(reason.contains("it is 0 within its error (below"), "{reason}");
            }
        }
    }
}

/// A decay is above 0, and so is its interval, however little the record tells.
#[test]
fn the_interval_of_a_decay_is_above_0() {
    let (l, w) = (0.2, 0.3);
    let (mut known, mut held) = (0, 0);
    for seed in 0..60 {
        let body = |normal: &mut Normal| {
            let mode = oscillator((l, w), 0.5, 300, normal);
            Track { modes: vec![mode], ..along(0.5, 300, |t| ([t, 0.0], [1.0, 0.0])) }
        };
        let bodies = (0..8).map(|k| body(&mut Normal::new(500 + seed, k))).collect();
        let tracks = Tracks::new(0.5, vec!["s".into()], bodies).unwrap();
        let found = autocorrelation(&tracks, &tracks.sized("s").unwrap()).unwrap();
        let Some(decay) = found.oscillation.and_then(|found| found.decay.known()) else { continue };
        assert!(decay.lower() > 0.0, "{seed}: {decay:?}");
        known += 1;
        held += usize::from(holds(decay, 1.0 / l));
    }
    println!("{held} of {known}");
    assert!(known >= 30 && 100 * held >= 90 * known, "{held} of {known}");
}
