//! Mean-square displacements with closed forms, the fit of a persistent random walk, exponents.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{active_brownian, active_msd, agrees, along, known, many, ornstein_uhlenbeck};
use motiform_statistics::{
    MeanSquare, Tracks, furth, lagged_sums, local_exponent, mean_square, persistent_walk,
};

/// Every lag within five standard errors of the closed form.
fn follows(curve: &MeanSquare, exact: impl Fn(f64) -> f64) {
    for place in 0..curve.len() {
        let (lag, measured) = (curve.lag(place), curve.measured(place));
        // rounding, where no error is left (the ballistic end of a constant speed)
        let rounding = (measured.value / exact(lag) - 1.0).abs() < 1e-4;
        assert!(agrees(measured, exact(lag), 2.5) || rounding, "{lag}: {measured:?}, {}", exact(lag));
    }
}

#[test]
fn an_ornstein_uhlenbeck_velocity_is_a_persistent_random_walk() {
    let (g, s, dt) = (0.5, 1.3, 0.2);
    let tracks = many(dt, 60, |normal| ornstein_uhlenbeck(g, s, dt, 2000, normal), 1);
    let curve = mean_square(&tracks);
    follows(&curve, |t| furth(2.0 * s * s, 1.0 / g, t));
    let walk = persistent_walk(&curve);
    assert!(agrees(known(&walk.persistence), 1.0 / g, 2.0), "{walk:?}");
    assert!(agrees(known(&walk.speed), s * 2.0_f64.sqrt(), 2.0), "{walk:?}");
    assert!(agrees(known(&walk.diffusion), s * s / g, 2.0), "{walk:?}");
    // 60 bodies for 200 persistence times: a few per cent
    assert!(known(&walk.diffusion).half_width() < 0.1 * s * s / g);
    let [first, last] = [true, false].map(|first| known(&local_exponent(&curve, first)));
    assert!((first.value - 2.0).abs() < 0.06 && (last.value - 1.0).abs() < 0.2, "{first:?} {last:?}");
}

#[test]
fn active_brownian_particles_have_their_closed_forms() {
    for case in [(0.5, 0.0, 0.0), (0.5, 2.0, 0.0), (0.5, 0.0, 0.05)] {
        let dt = 0.1;
        let tracks = many(dt, 60, |normal| active_brownian(case, dt, 1000, normal), 2);
        let curve = mean_square(&tracks);
        follows(&curve, |t| active_msd(case, t));
        let (d_r, omega, d) = case;
        let walk = persistent_walk(&curve);
        if omega == 0.0 && d == 0.0 {
            assert!(agrees(known(&walk.persistence), 1.0 / d_r, 2.0) && agrees(known(&walk.speed), 1.0, 2.0));
        }
        if omega != 0.0 {
            // a chiral particle is no persistent random walk, and the fit says so
            let reason = walk.persistence.reason().unwrap();
            assert!(reason.contains("does not describe"), "{reason}");
        }
    }
}

#[test]
fn a_circle_and_a_line_are_exact() {
    let (radius, omega, speed, dt) = (2.0, 0.7, 0.3, 0.05);
    let turn = |t: f64| {
        let (s, c) = (omega * t).sin_cos();
        ([radius * c, radius * s], [-radius * omega * s, radius * omega * c])
    };
    let circle = mean_square(&Tracks::new(dt, vec![], vec![along(dt, 4000, turn)]).unwrap());
    for place in 0..circle.len() {
        let exact = 2.0 * radius * radius * (1.0 - (omega * circle.lag(place)).cos());
        assert!((circle.measured(place).value - exact).abs() < 1e-12);
    }
    let line = |t: f64| ([speed * t, 0.0], [speed, 0.0]);
    let line = mean_square(&Tracks::new(dt, vec![], vec![along(dt, 4000, line)]).unwrap());
    for place in 0..line.len() {
        let exact = (speed * line.lag(place)).powi(2);
        assert!((line.measured(place).value / exact - 1.0).abs() < 1e-10);
        assert!((line.exponent(place).unwrap().value - 2.0).abs() < 1e-9);
    }
    // diffusion is not reached, and that is the answer
    let walk = persistent_walk(&line);
    for answer in [&walk.persistence, &walk.diffusion] {
        assert!(answer.reason().unwrap().starts_with("not reached"), "{answer:?}");
    }
    assert!((known(&walk.speed).value - speed).abs() < 0.01 * speed);
}

/// Both sides of the threshold: the longest lag is 5 persistence times.
#[test]
fn diffusion_is_reached_from_five_persistence_times_on() {
    let dt = 0.1;
    for (persistence, reached) in [(9.0, true), (11.0, false)] {
        // the longest lag is 50: half of 1000 samples
        let tracks = many(dt, 400, |normal| ornstein_uhlenbeck(1.0 / persistence, 1.0, dt, 1000, normal), 3);
        let walk = persistent_walk(&mean_square(&tracks));
        assert_eq!(walk.diffusion.known().is_some(), reached, "{walk:?}");
        assert!(walk.persistence.known().is_some());
    }
}

#[test]
fn a_walk_without_ballistic_part_has_a_diffusion_coefficient_only() {
    let d = 0.4;
    let brownian = |normal: &mut _| ornstein_uhlenbeck(1000.0, (d * 1000.0_f64).sqrt(), 1.0, 500, normal);
    let curve = mean_square(&many(1.0, 50, brownian, 4));
    let walk = persistent_walk(&curve);
    assert!(walk.persistence.reason().unwrap().starts_with("not resolved"), "{walk:?}");
    assert!(agrees(known(&walk.diffusion), d, 2.0));
}

#[test]
fn a_body_at_rest_has_no_walk() {
    let rest = |_| ([1.0, 2.0], [0.0, 0.0]);
    let curve = mean_square(&Tracks::new(0.1, vec![], vec![along(0.1, 400, rest)]).unwrap());
    let walk = persistent_walk(&curve);
    assert!(walk.diffusion.reason().unwrap().contains("nothing moved") && curve.exponent(3).is_none());
    assert!(local_exponent(&curve, true).reason().is_some());
}

/// The sum of squares minus twice the lagged products, by Fourier transforms (Kneller 1995): a second formulation.
#[test]
fn displacements_agree_with_fourier_sums() {
    let tracks = many(0.1, 8, |normal| ornstein_uhlenbeck(0.5, 1.0, 0.1, 300, normal), 5);
    let curve = mean_square(&tracks);
    for place in 0..curve.len() {
        let lag = (curve.lag(place) / 0.1).round() as usize;
        let mut sum = 0.0;
        for track in tracks.bodies() {
            let path = &track.position;
            let components: Vec<Vec<f64>> = (0..2).map(|k| path.iter().map(|x| x[k]).collect()).collect();
            let product = lagged_sums(&components, lag).unwrap()[lag];
            let square = |p: &[f64; 2]| p[0] * p[0] + p[1] * p[1];
            let (early, late) = (&path[..path.len() - lag], &path[lag..]);
            sum +=
                early.iter().map(square).sum::<f64>() + late.iter().map(square).sum::<f64>() - 2.0 * product;
        }
        let exact = sum / (8 * (300 - lag)) as f64;
        assert!((curve.measured(place).value / exact - 1.0).abs() < 1e-8); // positions of up to 1e2, squares of 1e4
    }
}

#[test]
fn the_form_is_smooth_where_its_series_takes_over() {
    for t in [0.019_999, 0.020_001] {
        let exact: f64 = 2.0 * (t + libm::expm1(-t));
        assert!((furth(1.0, 1.0, t) / exact - 1.0).abs() < 1e-10);
    }
}
