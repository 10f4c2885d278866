//! Autocorrelations with closed forms, and their correlation times.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{active_brownian, agrees, along, known, many, ornstein_uhlenbeck};
use motiform_dynamics::Normal;
use motiform_statistics::{Quantity, Track, Tracks, autocorrelation, lagged_sums};

#[test]
fn an_ornstein_uhlenbeck_velocity_forgets_exponentially() {
    let (g, s, dt) = (0.5, 1.3, 0.2);
    let tracks = many(dt, 60, |normal| ornstein_uhlenbeck(g, s, dt, 2000, normal), 1);
    let found = autocorrelation(&tracks, &Quantity::Velocity).unwrap();
    assert!(agrees(found.variance, 2.0 * s * s, 2.0) && found.correlation[0].value == 1.0);
    for (lag, rho) in found.lags.iter().zip(&found.correlation).skip(1) {
        assert!(agrees(*rho, (-g * lag).exp(), 2.5), "{lag} {rho:?}");
    }
    // the sum over 8 decay times lacks e^-8, the trapezoidal rule adds (g dt)^2/12
    assert!(agrees(known(&found.time), 1.0 / g, 2.0), "{:?}", found.time);
}

#[test]
fn a_chiral_particle_turns_its_correlation() {
    let (d_r, omega, dt) = (0.3, 2.0, 0.1);
    let tracks = many(dt, 80, |normal| active_brownian((d_r, omega, 0.0), dt, 2000, normal), 2);
    for quantity in [Quantity::Velocity, Quantity::Heading] {
        let found = autocorrelation(&tracks, &quantity).unwrap();
        for (lag, rho) in found.lags.iter().zip(&found.correlation).skip(1) {
            assert!(agrees(*rho, (-d_r * lag).exp() * (omega * lag).cos(), 2.5), "{lag} {rho:?}");
        }
        assert!(agrees(known(&found.time), d_r / (d_r * d_r + omega * omega), 2.0), "{:?}", found.time);
    }
    let speed = autocorrelation(&tracks, &Quantity::Speed).unwrap();
    assert_eq!(speed.time.reason(), Some("it does not vary"));
}

#[test]
fn a_circle_never_forgets() {
    let turn = |t: f64| ([t.cos(), t.sin()], [-t.sin(), t.cos()]);
    let tracks = Tracks::new(0.1, vec![], vec![along(0.1, 4000, turn)]).unwrap();
    let found = autocorrelation(&tracks, &Quantity::Velocity).unwrap();
    for (lag, rho) in found.lags.iter().zip(&found.correlation) {
        assert!((rho.value - lag.cos()).abs() < 1e-9);
    }
    assert!(found.time.reason().unwrap().starts_with("not reached"));
}

#[test]
fn fourier_sums_are_direct_sums() {
    let mut normal = Normal::new(7, 0);
    let series = [57, 40].map(|length| (0..length).map(|_| normal.next()).collect::<Vec<f64>>());
    let sums = lagged_sums(&series, 70).unwrap();
    for (lag, sum) in sums.iter().enumerate() {
        let direct: f64 = series
            .iter()
            .map(|x| x.iter().zip(x.get(lag..).unwrap_or(&[])).map(|(a, b)| a * b).sum::<f64>())
            .sum();
        assert!((sum - direct).abs() < 1e-12);
    }
}

/// A heading that is undefined at rest is left out, pair by pair.
#[test]
fn gaps_of_the_heading_do_not_count() {
    let go = |t: f64| ([t, 0.0], [if (t % 2.0) < 0.45 { 0.0 } else { 1.0 }, 0.0]);
    let tracks = Tracks::new(0.1, vec![], vec![along(0.1, 800, go)]).unwrap();
    let found = autocorrelation(&tracks, &Quantity::Heading).unwrap();
    assert!(found.correlation.iter().all(|rho| (rho.value - 1.0).abs() < 1e-9));
}

#[test]
fn a_mode_is_a_vector() {
    let mut normal = Normal::new(8, 0);
    let body = |normal: &mut Normal| {
        let mode = ornstein_uhlenbeck(1.0, 0.2, 0.1, 2000, normal).velocity;
        Track { modes: vec![mode], ..along(0.1, 2000, |t| ([t, 0.0], [1.0, 0.0])) }
    };
    let bodies = (0..20).map(|_| body(&mut normal)).collect();
    let tracks = Tracks::new(0.1, vec!["s".into()], bodies).unwrap();
    let found = autocorrelation(&tracks, &tracks.sized("s").unwrap()).unwrap();
    assert!(agrees(found.variance, 0.08, 2.0) && agrees(known(&found.time), 1.0, 2.0));
}
