//! Distributions of speed and turning angle.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{along, many, ornstein_uhlenbeck};
use motiform_dynamics::Normal;
use motiform_statistics::{Settings, Tracks, histogram, statistics, turning_angles};

/// The speed of a two-dimensional normal velocity has the density v/s^2 exp(-v^2/2 s^2).
#[test]
fn the_speed_of_a_normal_velocity_is_rayleigh_distributed() {
    let s: f64 = 1.3;
    let tracks = many(0.5, 100, |normal| ornstein_uhlenbeck(1.0, s, 0.5, 500, normal), 1);
    let found = statistics(&tracks, &Settings::default()).unwrap();
    let speeds = found.speeds.unwrap();
    assert_eq!(speeds.bins.iter().map(|bin| bin.count).sum::<usize>(), 50_000);
    let area: f64 = speeds.bins.iter().map(|bin| bin.density * (bin.to - bin.from)).sum();
    assert!((area - 1.0).abs() < 1e-12);
    let share = |v: f64| 1.0 - (-v * v / (2.0 * s * s)).exp();
    let outside = speeds.bins.iter().filter(|bin| {
        let exact = (share(bin.to) - share(bin.from)) / (bin.to - bin.from);
        !(bin.lower..=bin.upper).contains(&exact)
    });
    assert!(outside.count() <= 6); // 2 of 40 expected; 7 or more have a probability of 0.3 %
    let mean = s * (std::f64::consts::PI / 2.0).sqrt();
    assert!((found.mean_speed.value - mean).abs() < 2.0 * found.mean_speed.half_width());
    assert!((found.rms_speed.value - s * 2.0_f64.sqrt()).abs() < 2.0 * found.rms_speed.half_width());
}

/// Every sample twice is worth no more than once.
#[test]
fn repeated_samples_are_not_independent() {
    let mut normal = Normal::new(2, 0);
    let once: Vec<(usize, f64)> = (0..6400).map(|k| (k / 100, normal.next())).collect();
    let twice: Vec<(usize, f64)> = once.iter().flat_map(|&sample| [sample; 4]).collect();
    let [once, twice] = [once, twice].map(|samples| histogram(&samples, 64, (-3.0, 3.0), 20));
    assert!((once.independent / 6400.0 - 1.0).abs() < 0.2, "{}", once.independent);
    assert!((twice.independent / once.independent - 1.0).abs() < 0.2, "{}", twice.independent);
}

#[test]
fn a_circle_turns_by_one_angle() {
    let turn = |t: f64| ([t.cos(), t.sin()], [-t.sin(), t.cos()]);
    let tracks = Tracks::new(0.1, vec![], vec![along(0.1, 800, turn)]).unwrap();
    for turning in turning_angles(&tracks) {
        let expected =
            (turning.lag + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
        let full: Vec<_> = turning.angles.bins.iter().filter(|bin| bin.count > 0).collect();
        assert_eq!((full.len(), turning.at_rest), (1, 0));
        assert!(full[0].from <= expected && expected < full[0].to);
    }
}

/// Steps of Brownian motion are independent: every angle is equally likely.
#[test]
fn brownian_motion_turns_anywhere() {
    let brownian = |normal: &mut _| ornstein_uhlenbeck(1e4, 1.0, 1.0, 400, normal);
    let found = turning_angles(&many(1.0, 50, brownian, 3));
    let uniform = 1.0 / std::f64::consts::TAU;
    for turning in &found {
        let outside = turning.angles.bins.iter().filter(|b| !(b.lower..=b.upper).contains(&uniform)).count();
        assert!(outside <= 6, "{} {outside}", turning.lag);
    }
    assert_eq!(found.len(), 3);
}
