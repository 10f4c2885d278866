//! Tests of refused input, of the units of errors, and of tracks of different lengths.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{along, many, ornstein_uhlenbeck};
use motiform_statistics::{Errors, Settings, Track, Tracks, mean_square, statistics};

fn line(samples: usize) -> Track {
    along(0.1, samples, |t| ([t, 0.0], [1.0, 0.0]))
}

#[test]
fn bad_samples_are_named() {
    let mut broken = line(400);
    broken.velocity[7][1] = f64::NAN;
    let mut uneven = line(400);
    uneven.velocity.pop();
    for (dt, names, bodies, told) in [
        (0.0, vec![], vec![line(400)], "dt = 0"),
        (0.1, vec![], vec![], "at least one track"),
        (0.1, vec![], vec![line(400), line(15)], "body 1 has 15 samples"),
        (0.1, vec![], vec![line(255)], "fewer than 256"), // 16 blocks of 16
        (0.1, vec![], vec![broken], "sample 7 of velocity is NaN"),
        (0.1, vec![], vec![uneven], "velocity has 399 samples"),
        (0.1, vec!["s".to_owned()], vec![line(400)], "0 modes where 1 are named"),
    ] {
        let error = Tracks::new(dt, names, bodies).unwrap_err().to_string();
        assert!(error.contains(told), "{error}");
    }
    assert!(Tracks::new(0.1, vec![], vec![line(256)]).is_ok());
    let tracks = Tracks::new(0.1, vec![], vec![line(400)]).unwrap();
    let threshold = Some(("sped".to_owned(), None));
    let error = statistics(&tracks, &Settings { threshold, ..Settings::default() }).unwrap_err().to_string();
    assert!(error.contains("choose one of speed"), "{error}");
    let error = statistics(&tracks, &Settings { radii: vec![-1.0], ..Settings::default() }).unwrap_err();
    assert!(error.to_string().contains("disc = -1"));
}

/// From 8 bodies on, errors are those over bodies.
#[test]
fn few_bodies_are_cut_into_blocks() {
    let of = |count: usize| Tracks::new(0.1, vec![], vec![line(320); count]).unwrap().errors();
    assert_eq!(of(1), Errors::Blocks { count: 16, samples: 20 });
    assert_eq!(of(7), Errors::Blocks { count: 21, samples: 106 });
    assert_eq!(of(8), Errors::Bodies { count: 8 });
}

/// A longer track counts more, and lags beyond a short one are those of the long ones.
#[test]
fn lengths_may_differ() {
    let fast = |samples| along(0.1, samples, |t| ([2.0 * t, 0.0], [2.0, 0.0]));
    let mut bodies = vec![line(100); 8];
    bodies.extend(vec![fast(400); 8]);
    let curve = mean_square(&Tracks::new(0.1, vec![], bodies).unwrap());
    let weights = (99.0, 399.0);
    let exact = 0.01 * (weights.0 + 4.0 * weights.1) / (weights.0 + weights.1);
    assert!((curve.measured(0).value / exact - 1.0).abs() < 1e-12);
    let last = curve.len() - 1;
    assert!(
        curve.lag(last) > 10.0
            && (curve.measured(last).value / (2.0 * curve.lag(last)).powi(2) - 1.0).abs() < 1e-12
    );
}

/// More bodies than groups, and no number that is not one, whatever the motion.
#[test]
fn results_hold_no_nan() {
    let rest = along(0.1, 300, |_| ([0.0, 0.0], [0.0, 0.0]));
    let sets = [
        Tracks::new(0.1, vec![], vec![rest; 9]).unwrap(),
        Tracks::new(0.1, vec![], vec![line(300)]).unwrap(),
        many(0.1, 100, |normal| ornstein_uhlenbeck(1.0, 1.0, 0.1, 200, normal), 1),
    ];
    for tracks in sets {
        let found = statistics(&tracks, &Settings::default()).unwrap();
        for point in found.displacement.points() {
            assert!(point.value.value.is_finite() && point.exponent.is_none_or(|e| e.value.is_finite()));
        }
        let walk = [
            &found.walk.persistence,
            &found.walk.speed,
            &found.walk.diffusion,
            &found.diffusion.displacements,
        ];
        for answer in walk.into_iter().chain(&found.exponents) {
            assert!(answer.known().is_none_or(|m| m.value.is_finite()), "{answer:?}");
        }
        for correlation in &found.autocorrelations {
            assert!(correlation.correlation.iter().all(|rho| rho.value.is_finite()));
        }
        assert!(found.passages.iter().all(|p| p.time.restricted.value.is_finite()));
        assert!(found.spectra.iter().all(|s| s.power.iter().all(|p| p.is_finite())));
    }
}
