//! The velocity of a stage beside the motion of a cell.

use crate::common::{Equations, Experiment, FULL, full};
use crate::samples::draws;
use motiform_dynamics::Complex;
use motiform_inference::{
    Beside, Fit, HANDED_RATE, Library, Settings, Symmetry, Track, Warning, fit, handed_beside, handedness,
    stage_velocities, warnings, with_stage,
};

fn fitted(track: &Track) -> Fit {
    let settings =
        Settings { library: Library::tensor().select(&FULL).expect("terms"), ..Settings::default() };
    fit(std::slice::from_ref(track), &settings, &()).expect("a fit")
}

fn cell(equations: Equations, frames: usize, seed: u64) -> Track {
    Experiment { frames, ..Experiment::new(equations, 0.02, seed) }.track()
}

/// A velocity of 2 % of the speed is found within its errors, whatever the motion, and subtracting it gives
/// the coefficients of the still stage.
#[test]
fn a_velocity_that_was_added_is_found() {
    for (kappa3, seed) in [(0.1, 3), (0.3, 5)] {
        let still = cell(full(0.5, kappa3), 400, seed);
        let before = fitted(&still);
        let added = [0.03, -0.02];
        let carried = still.without_velocity(added.map(|v: f64| -v));
        let there = with_stage(std::slice::from_ref(&carried), &fitted(&carried), &()).expect("a fit");
        let at_rest = with_stage(std::slice::from_ref(&still), &before, &()).expect("a fit");
        let errors = stage_velocities(std::slice::from_ref(&still), &before).expect("a track")[0]
            .expect("told")
            .errors;
        for k in 0..2 {
            let difference = there.velocities[0][k] - at_rest.velocities[0][k] - added[k];
            // the same record: only the ends of two searches differ
            assert!(difference.abs() < 0.2 * errors[k], "{:?} {errors:?}", there.velocities);
            assert!(at_rest.velocities[0][k].abs() < 4.0 * errors[k], "{:?} {errors:?}", at_rest.velocities);
        }
        for (a, b) in there.fit.coefficients.iter().zip(&at_rest.fit.coefficients) {
            assert!((a.estimate.value - b.estimate.value).abs() < 0.2 * b.estimate.error, "{}", a.name);
        }
    }
}

/// A warning asks for half a percent of the speed: with next to no noise the errors of the filter are significant as well.
#[test]
fn a_velocity_is_named_from_half_a_percent_of_the_speed_on() {
    let still = Experiment { frames: 600, ..Experiment::new(full(0.5, 0.3), 0.001, 9) }.track();
    let speed = fitted(&still).scales.amplitudes[0];
    // errors are some 3e-4 of the speed: four of them on both sides of the threshold; one step from 0 falls
    // short of large velocities, but stays above it
    let all =
        [(0.0035, false), (0.0065, true), (0.02, true), (0.05, true), (0.2, true), (0.5, true), (1.0, true)];
    for (part, is_named) in all {
        let tracks = [still.without_velocity([-part * speed, 0.0])];
        let found = fitted(&tracks[0]);
        let seen = stage_velocities(&tracks, &found).expect("a track")[0].expect("told");
        let off = (seen.velocity[0] - part * speed).abs();
        assert!(seen.p_value < 1e-6 && (part > 0.01 || off < 4.0 * seen.errors[0]), "{part}: {seen:?}");
        let named = warnings(&tracks, &found, None).expect("warnings");
        let is_carried = named.iter().any(|warning| matches!(warning, Warning::Carried { .. }));
        assert_eq!(is_carried, is_named, "{part}: {named:?}");
    }
}

/// Cells on a stage that rests: p-values are uniform.
#[test]
fn p_values_without_a_velocity_are_uniform() {
    let p_value = |seed: u64| {
        let track = cell(full(0.5, 0.1), 200, 700 + seed);
        let found = fitted(&track);
        stage_velocities(&[track], &found).expect("a track")[0].expect("told").p_value
    };
    let p: Vec<f64> = (0..draws(16, 40)).map(p_value).collect();
    let below = |level: f64| p.iter().filter(|p| **p < level).count();
    println!("{} below 0.05, {} below 0.5 of {}", below(0.05), below(0.5), p.len());
    // means 2 and 20 of 40, three standard deviations; of 16 others have a probability of 1e-4 and 5e-4
    assert!(below(0.05) <= draws(5, 6) && draws(2..=14, 10..=30).contains(&below(0.5)), "{p:?}");
}

/// Four zigzags of one law that are fitted together, each in a direction of its own: so are the p-values of each track there, and a
/// velocity that one of them has is its own.
#[test]
fn p_values_of_tracks_that_are_fitted_together_are_uniform() {
    let settings =
        Settings { library: Library::tensor().select(&FULL).expect("terms"), ..Settings::default() };
    let group = |seed: u64| -> Vec<Track> {
        (0..4).map(|k| cell(full(0.9, 0.1), 200, 5000 + 10 * seed + k)).collect()
    };
    let p_values = |seed: u64| -> Vec<f64> {
        let tracks = group(seed);
        let found = fit(&tracks, &settings, &()).expect("a fit");
        let all = stage_velocities(&tracks, &found).expect("tracks");
        all.into_iter().map(|one| one.expect("told").p_value).collect()
    };
    let p: Vec<f64> = (0..draws(5, 12)).flat_map(p_values).collect();
    let below = |level: f64| p.iter().filter(|p| **p < level).count();
    println!("{} below 0.05, {} below 0.5 of {}", below(0.05), below(0.5), p.len());
    // means 2.4 and 24 of 48, three standard deviations; of 20 others have a probability of 3e-4 and 4e-4
    let halves = draws(3..=17, 14..=34);
    assert!(below(0.05) <= draws(5, 7) && below(1e-4) == 0 && halves.contains(&below(0.5)), "{p:?}");
    let mut tracks = group(0);
    tracks[2] = tracks[2].without_velocity([0.03, -0.02].map(|v: f64| -v));
    let found = fit(&tracks, &settings, &()).expect("a fit");
    let errors = stage_velocities(&tracks, &found).expect("tracks");
    let there = with_stage(&tracks, &found, &()).expect("a fit");
    for (k, velocity) in there.velocities.iter().enumerate() {
        let known = if k == 2 { [0.03, -0.02] } else { [0.0; 2] };
        let errors = errors[k].expect("told").errors;
        assert!(
            (0..2).all(|c| (velocity[c] - known[c]).abs() < 4.0 * errors[c]),
            "{k}: {velocity:?} {errors:?}"
        );
    }
}

/// A circle on a stage that drifts by 4 % of its speed is called handed by its likelihood, and not beside a
/// velocity of the stage; a cell that is handed stays so.
#[test]
fn a_drift_is_no_handedness() {
    let circle = Experiment { frames: 600, ..Experiment::new(full(0.5, 0.3), 0.005, 9) }.track();
    let track = circle.without_velocity([-0.04, 0.0]);
    let real = fitted(&track);
    let tracks = [track];
    let found = handedness(&tracks, &real, &()).expect("a fit");
    let p = handed_beside(Beside::Stage, &tracks, [&real, &found.fit], &()).expect("fits");
    println!("circle: {:.1e}, beside a stage {p:.1e}", found.p_value);
    assert!(found.p_value < HANDED_RATE && p > HANDED_RATE, "{:.1e} {p:.1e}", found.p_value);
    let mut handed = full(0.5, 0.1);
    handed[3].1 = Complex::new(-0.5, 0.1);
    let track = cell(handed, 600, 9).without_velocity([-0.02, 0.0]);
    let real = fitted(&track);
    let tracks = [track];
    let found = handedness(&tracks, &real, &()).expect("a fit");
    let p = handed_beside(Beside::Stage, &tracks, [&real, &found.fit], &()).expect("fits");
    println!("handed: {:.1e}, beside a stage {p:.1e}", found.p_value);
    assert_eq!(found.symmetry, Symmetry::Handed);
    assert!(p < HANDED_RATE, "{p:.1e}");
}

/// Cells that turn by themselves on a stage that drifts by an eighth of their speed: the velocity is that of the stage beside handed terms.
#[test]
fn the_stage_of_a_handed_cell_is_found_beside_handed_terms() {
    let mut handed = full(0.5, 0.1);
    handed[0].1 = Complex::new(1.0, 0.15);
    for seed in [9, 10] {
        let still = cell(handed.clone(), 400, seed);
        let before = handedness(std::slice::from_ref(&still), &fitted(&still), &()).expect("a fit").fit;
        let added = [0.12, -0.05];
        let tracks = [still.without_velocity(added.map(|v: f64| -v))];
        let model = handedness(&tracks, &fitted(&tracks[0]), &()).expect("a fit").fit;
        let errors = stage_velocities(&[still], &before).expect("a track")[0].expect("told").errors;
        let found = with_stage(&tracks, &model, &()).expect("a fit").velocities[0];
        println!("{found:?} {errors:?}");
        assert!((0..2).all(|k| (found[k] - added[k]).abs() < 4.0 * errors[k]), "{found:?} {errors:?}");
    }
}
