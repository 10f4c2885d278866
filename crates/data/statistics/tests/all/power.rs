//! Power spectra and their bands.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{along, many, ornstein_uhlenbeck};
use motiform_dynamics::Normal;
use motiform_statistics::{Quantity, Settings, Track, Tracks, power_spectrum, statistics};

/// White noise of one component: P = 2 s^2 dt. The band holds it at 95 % of the frequencies; neighbours are correlated through the window.
#[test]
fn the_band_holds_white_noise() {
    let (dt, mut inside, mut all) = (0.5, 0, 0);
    for seed in 0..40 {
        let noise = |normal: &mut Normal| Track {
            velocity: (0..2048).map(|_| [normal.next(), 0.0]).collect(),
            ..along(dt, 2048, |t| ([t, 0.0], [0.0, 0.0]))
        };
        let tracks = many(dt, 10, noise, seed);
        let found = power_spectrum(&tracks, &Quantity::Velocity).unwrap().unwrap();
        assert_eq!(found.length, 1024);
        for power in &found.power[1..] {
            inside += usize::from((power * found.band[0]..=power * found.band[1]).contains(&(2.0 * dt)));
            all += 1;
        }
    }
    let share = f64::from(u32::try_from(inside).unwrap()) / f64::from(all);
    println!("white noise: {share:.3}");
    assert!((0.935..=0.97).contains(&share), "{share}");
}

/// Ornstein-Uhlenbeck velocity, both components: P(f) = 8 s^2 g/(g^2 + (2 pi f)^2), aliased copies added.
#[test]
fn an_ornstein_uhlenbeck_velocity_has_a_lorentzian_spectrum() {
    let (g, s, dt) = (0.5, 1.0, 0.1);
    let tracks = many(dt, 100, |normal| ornstein_uhlenbeck(g, s, dt, 4096, normal), 3);
    let found = power_spectrum(&tracks, &Quantity::Velocity).unwrap().unwrap();
    let exact = |f: f64| {
        let a = libm::exp(-g * dt); // the sampled process is AR(1)
        4.0 * s * s * dt * (1.0 - a * a) / (1.0 - 2.0 * a * libm::cos(std::f64::consts::TAU * f * dt) + a * a)
    };
    let inside = found.frequencies.iter().zip(&found.power).skip(2).filter(|(f, p)| {
        (**p * found.band[0]..=**p * found.band[1]).contains(&exact(**f)) // the Hann window's leakage is below 1 % here
    });
    let share = inside.count() as f64 / (found.power.len() - 2) as f64;
    println!("lorentzian: {share:.3}");
    assert!(share > 0.95, "{share}"); // two independent components: the band is wide
}

/// 100 sets of 20 bodies whose speeds differ (log-normal, sigma 0.5): the mean of
/// the power over bodies has the band of bodies, not that of one Gaussian process. Below 8 bodies that differ there is none.
#[test]
fn the_band_is_that_of_bodies_that_differ() {
    let (g, dt, sigma) = (0.5, 0.5, 0.5);
    let walker = |normal: &mut Normal| {
        let size = libm::exp(sigma * normal.next() - sigma * sigma); // mean square 1
        ornstein_uhlenbeck(g, size, dt, 200, normal)
    };
    let a = libm::exp(-g * dt);
    let exact = |f: f64| {
        4.0 * dt * (1.0 - a * a) / (1.0 - 2.0 * a * libm::cos(std::f64::consts::TAU * f * dt) + a * a)
    };
    let (mut inside, mut all) = (0, 0);
    for seed in 0..100 {
        let tracks = many(dt, 20, walker, 700 + seed);
        let found = power_spectrum(&tracks, &Quantity::Velocity).unwrap().unwrap();
        for (f, power) in found.frequencies.iter().zip(&found.power).skip(1) {
            inside += usize::from((power * found.band[0]..=power * found.band[1]).contains(&exact(*f)));
            all += 1;
        }
    }
    let share = f64::from(u32::try_from(inside).unwrap()) / f64::from(all);
    println!("bodies that differ: {share:.3}");
    assert!(share > 0.85, "{share}"); // powers of log-normal speeds are skew; 0.72 with the band of one process
    let few = statistics(
        &many(dt, 5, |normal| ornstein_uhlenbeck(g, libm::exp(normal.next()), dt, 2000, normal), 9),
        &Settings::default(),
    );
    let few = few.unwrap();
    assert!(few.no_intervals.is_some() && few.spectra[0].band[0].is_nan());
}

/// Samples every two persistence times: the power at low frequencies is 1.3 times that of the velocity.
#[test]
fn samples_that_are_too_coarse_have_no_spectrum() {
    let of = |dt| {
        statistics(
            &many(dt, 12, |normal| ornstein_uhlenbeck(0.5, 1.0, dt, 300, normal), 5),
            &Settings::default(),
        )
    };
    let spectra = |dt| of(dt).unwrap().spectra.iter().any(|found| found.quantity == Quantity::Velocity);
    assert!(spectra(0.5) && !spectra(4.0));
}

#[test]
fn short_tracks_have_no_spectrum() {
    let tracks = Tracks::new(0.1, vec![], vec![along(0.1, 16, |t| ([t, 0.0], [1.0, 0.0])); 8]).unwrap();
    let found = power_spectrum(&tracks, &Quantity::Velocity).unwrap();
    assert!(found.is_none_or(|found| found.length <= 8));
}
