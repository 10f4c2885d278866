//! Diffusion by two ways, and a persistent random walk held against them.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{active_brownian, agrees, along, holds, known, many, ornstein_uhlenbeck};
use motiform_dynamics::Normal;
use motiform_statistics::{
    Answer, Measured, Quantity, Seen, Settings, Track, Tracks, Walk, autocorrelation, diffusion, mean_square,
    persistent_walk, statistics,
};

#[test]
fn both_ways_give_the_exact_coefficient() {
    // rotational diffusion, rate of turning; D = v^2 d_r/(2 (d_r^2 + omega^2))
    for (d_r, omega, dt) in [(0.5, 0.0, 0.25), (0.1, 0.3, 0.5), (0.05, 0.3, 0.5)] {
        let tracks = many(dt, 40, |normal| active_brownian((d_r, omega, 0.0), dt, 1600, normal), 11);
        let found = diffusion(&tracks).unwrap();
        let exact = 0.5 * d_r / (d_r * d_r + omega * omega);
        assert!(agrees(known(&found.green_kubo), exact, 1.5), "{found:?}");
        assert!(agrees(known(&found.displacements), exact, 1.5), "{found:?}");
        let difference = found.difference.unwrap();
        // chance enters both alike: they differ by less than each is uncertain, as far as ends of tracks do not count
        let chance = difference.half_width() / known(&found.green_kubo).half_width();
        assert!(agrees(difference, 0.0, 2.0) && chance < 0.7, "{chance}: {found:?}");
    }
}

/// The trapezoidal sum would be a third too large.
#[test]
fn a_velocity_that_is_forgotten_between_samples_is_said_to_be() {
    let (g, s) = (4.0, 1.0);
    let tracks = |dt| many(dt, 40, |normal| ornstein_uhlenbeck(g, s, dt, 1000, normal), 12);
    let fine = diffusion(&tracks(0.2)).unwrap();
    assert!(agrees(known(&fine.green_kubo), s * s / g, 1.5), "{fine:?}"); // the trapezoidal rule: 5 % more
    let coarse = diffusion(&tracks(0.5)).unwrap();
    assert!(coarse.green_kubo.reason().unwrap().starts_with("sampled too coarsely"), "{coarse:?}");
    assert!(holds(known(&coarse.displacements), s * s / g), "{coarse:?}"); // positions need no velocity
}

#[test]
fn noise_on_the_positions_is_the_difference() {
    let (d_r, d) = (0.5, 0.2);
    let tracks = many(0.25, 40, |normal| active_brownian((d_r, 0.0, d), 0.25, 800, normal), 13);
    let found = diffusion(&tracks).unwrap();
    assert!(agrees(known(&found.green_kubo), 0.5 / d_r, 1.5), "{found:?}");
    assert!(agrees(known(&found.displacements), 0.5 / d_r + d, 1.5), "{found:?}");
    let difference = found.difference.unwrap();
    assert!(agrees(difference, -d, 2.0) && difference.upper() < 0.0, "{difference:?}");
}

#[test]
fn motion_that_never_forgets_does_not_diffuse() {
    let turn = |t: f64| ([t.cos(), t.sin()], [-t.sin(), t.cos()]);
    let line = |t: f64| ([t, 0.0], [1.0, 0.0]);
    for tracks in [along(0.1, 4000, turn), along(0.1, 4000, line)] {
        let found = diffusion(&Tracks::new(0.1, vec![], vec![tracks]).unwrap()).unwrap();
        for answer in [&found.green_kubo, &found.displacements] {
            assert!(answer.reason().unwrap().starts_with("not reached"), "{answer:?}");
        }
    }
    let rest = along(0.1, 400, |_| ([1.0, 2.0], [0.0, 0.0]));
    let found = diffusion(&Tracks::new(0.1, vec![], vec![rest]).unwrap()).unwrap();
    assert_eq!(found.displacements.reason(), Some("nothing moved"));
}

/// Translational noise raises the start of the displacements, which a persistent random walk takes for speed.
#[test]
fn a_walk_with_another_speed_than_the_body_is_none() {
    let dt = 1.0;
    let walk = |d| {
        let tracks = many(dt, 24, |normal| active_brownian((0.5, 0.0, d), dt, 100, normal), 14);
        let time = autocorrelation(&tracks, &Quantity::Velocity).unwrap().time;
        let found = statistics(&tracks, &Settings::default()).unwrap();
        let seen = Seen { speed: &found.rms_speed, diffusion: &found.diffusion.displacements, time: &time };
        let walk = persistent_walk(&mean_square(&tracks));
        assert!(walk.speed.known().is_some(), "{walk:?}"); // the form alone does not tell
        assert_eq!(walk.clone().held_against(&seen), found.walk);
        found.walk
    };
    assert!(agrees(known(&walk(0.0).persistence), 2.0, 1.5));
    let reason = walk(0.08).speed.reason().unwrap().to_owned();
    assert!(reason.contains("is not the root-mean-square speed 1"), "{reason}");
}

/// A drift that is too slow for the correlation of the velocity to tell it from chance shows in the displacements at long lags.
#[test]
fn displacements_that_do_not_grow_as_the_lag_put_the_coefficient_in_doubt() {
    let (g, s, dt) = (1.0, 1.0, 0.25);
    let drifting = |drift: f64| {
        let body = |normal: &mut Normal| {
            let mut track = ornstein_uhlenbeck(g, s, dt, 1600, normal);
            for (k, (at, velocity)) in track.position.iter_mut().zip(&mut track.velocity).enumerate() {
                at[0] += drift * dt * k as f64;
                velocity[0] += drift;
            }
            track
        };
        statistics(&many(dt, 12, body, 21), &Settings::default()).unwrap()
    };
    let none = drifting(0.0).diffusion;
    assert!(none.green_kubo.known().is_some() && none.doubt.is_none(), "{none:?}");
    let found = drifting(0.12);
    assert!(found.diffusion.displacements.known().is_some(), "{:?}", found.diffusion);
    assert!(known(&found.exponents[1]).lower() > 1.0);
    assert!(found.diffusion.doubt.unwrap().contains("not as lag^1"));
    // nothing is doubted that is not stated
    let line = along(0.1, 4000, |t| ([t, 0.0], [1.0, 0.0]));
    let line = statistics(&Tracks::new(0.1, vec![], vec![line]).unwrap(), &Settings::default()).unwrap();
    assert_eq!((line.diffusion.displacements.known(), line.diffusion.doubt), (None, None));
}

/// A velocity that is the sum of a fast and of a small slow part, the shape that of the slow one: where the record does not see the slow
/// part decay, there is no coefficient. Where it does, or where the shape oscillates, nothing is.
#[test]
fn a_slow_part_of_the_shape_is_why_there_is_no_coefficient() {
    let body = |slow: f64, period: f64, normal: &mut Normal| {
        let (fast, slow) = (
            ornstein_uhlenbeck(5.0, 0.4, 0.2, 4000, normal),
            ornstein_uhlenbeck(slow, 0.006, 0.2, 4000, normal),
        );
        let sum = |a: &[[f64; 2]], b: &[[f64; 2]]| -> Vec<[f64; 2]> {
            a.iter().zip(b).map(|(a, b)| [a[0] + b[0], a[1] + b[1]]).collect()
        };
        let turned = |(k, v): (usize, &[f64; 2])| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * 0.2 * k as f64 / period);
            [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]]
        };
        let mode = slow.velocity.iter().enumerate().map(turned).collect();
        Track {
            position: sum(&fast.position, &slow.position),
            velocity: sum(&fast.velocity, &slow.velocity),
            modes: vec![mode],
            rates: Vec::new(),
        }
    };
    let doubt = |slow: f64, period: f64| {
        let bodies = (0..40).map(|k| body(slow, period, &mut Normal::new(41, k))).collect();
        let tracks = Tracks::new(0.2, vec!["z2".into()], bodies).unwrap();
        let found = statistics(&tracks, &Settings::default()).unwrap().diffusion;
        found.green_kubo.reason().map(str::to_owned).or(found.doubt)
    };
    let said = doubt(0.003, f64::INFINITY).expect("z2 is not forgotten");
    assert!(said.starts_with("not reached: z2 is not forgotten"), "{said}");
    assert_eq!([doubt(1.0, f64::INFINITY), doubt(0.003, 30.0)], [None, None]);
}

/// A mean velocity of a twentieth of the speed: no random walk has it, and the coefficient is in doubt. Without it, or of one body that
/// keeps its direction, nothing is said.
#[test]
fn a_velocity_that_all_bodies_share_is_named() {
    let tracks = |drift: f64, count: usize, samples: usize| {
        let body = |normal: &mut Normal| {
            let Track { mut position, mut velocity, .. } = ornstein_uhlenbeck(1.0, 1.0, 0.2, samples, normal);
            position.iter_mut().enumerate().for_each(|(k, x)| x[0] += drift * 0.2 * k as f64);
            velocity.iter_mut().for_each(|v| v[0] += drift);
            Track { position, velocity, ..Track::default() }
        };
        statistics(&many(0.2, count, body, 51), &Settings::default()).unwrap()
    };
    let found = tracks(0.05, 64, 4000);
    assert!(
        found.diffusion.doubt.unwrap().contains("all bodies together move"),
        "{:?}",
        found.diffusion.green_kubo
    );
    assert!(found.walk.persistence.reason().unwrap().contains("all bodies together have"));
    // too short for a coefficient, which no longer record would give
    let short = tracks(0.5, 64, 60);
    for answer in
        [short.diffusion.green_kubo, short.diffusion.displacements, short.autocorrelations[0].time.clone()]
    {
        assert!(answer.reason().unwrap().starts_with("all bodies together move"), "{answer:?}");
    }
    for still in [tracks(0.0, 64, 4000), tracks(0.0, 1, 4000)] {
        assert!(
            still.diffusion.doubt.is_none() && still.walk.persistence.known().is_some(),
            "{:?}",
            still.walk
        );
    }
}

/// Two intervals of one number are not apart: a walk that differs from what is seen, by more than the accuracy of its fit (.3 %), is none,
/// or its interval says so.
#[test]
fn numbers_of_a_walk_reach_what_is_seen() {
    let measured = |value: f64, half: f64| Measured { value, interval: Some([value - half, value + half]) };
    for scale in [1.0, 1e-3] {
        for step in 0..40 {
            let speed = measured(scale * (1.0 - 0.0005 * f64::from(step)), scale * 0.0044);
            let seen = measured(scale, scale * 0.0009);
            let none = Answer::unknown("not looked at");
            let [persistence, diffusion] = [(); 2].map(|()| none.clone());
            let walk =
                Walk { persistence, speed: Answer::Known(speed), diffusion, curve: None, deviation: 0.0 };
            let walk = walk.held_against(&Seen { speed: &seen, diffusion: &none, time: &none });
            let apart = |found: Measured| found.upper() < seen.lower() || found.lower() > seen.upper();
            assert!(walk.speed.known().is_none_or(|found| !apart(found)), "{step}: {walk:?}");
            assert_eq!(
                walk.speed.known().is_some(),
                f64::from(step) * 0.0005 < 1.25 * 0.0044_f64.hypot(0.0009) + 0.003,
                "{step}"
            );
        }
    }
}
