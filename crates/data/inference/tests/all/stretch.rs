//! Outlines that are elongated along one direction whatever the heading.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{Equations, Experiment, FULL, diagonal, full};
use crate::samples::draws;
use motiform_dynamics::{Complex, Normal};
use motiform_inference::{
    Beside, HANDED_RATE, Library, Observation, Settings, Stretch, Track, fit, handed_beside, handedness,
};

/// A cell that steps in independent random directions, elongated along each step by chance and by `constant` always.
fn random_steps(frames: usize, constant: Complex<f64>, seed: u64) -> Track {
    let mut normal = Normal::new(seed, 0);
    let mut centre = [0.0; 2];
    let frame = |k: usize| {
        let z = Complex::new(0.1 * normal.next(), 0.1 * normal.next()) + constant;
        centre = centre.map(|x| x + normal.next());
        let y = vec![centre[0], centre[1], z.re, z.im, 0.0, 0.0];
        Observation { t: k as f64, y, covariance: diagonal(&[1e-3; 6]) }
    };
    Track((0..frames).map(frame).collect())
}

/// Without stretch, p values are uniform: the distribution of T^2 is exact for normal parts.
#[test]
fn p_values_of_random_steps_are_uniform() {
    let records = 2000;
    let p: Vec<f64> = (0..records)
        .map(|seed| Stretch::of(&random_steps(482, Complex::new(0.0, 0.0), seed)).unwrap().p_value)
        .collect();
    for level in [0.5, 0.2, 0.05, 0.01] {
        let share = p.iter().filter(|p| **p < level).count() as f64 / records as f64;
        let error = (level * (1.0 - level) / records as f64).sqrt();
        println!("p below {level}: {share}");
        assert!((share - level).abs() < 4.0 * error, "p below {level} in {share}");
    }
}

/// Size and direction of a stretch that was put in; turning the record turns the direction alone.
#[test]
fn a_stretch_has_its_size_and_direction() {
    let constant = Complex::new(0.06, -0.08);
    let track = random_steps(1000, constant, 5);
    let found = Stretch::of(&track).unwrap();
    // |c| = 0.1 beside two numbers of standard deviation 0.1; the long axis is at minus half the argument of c.
    let share = 0.1 / 0.03_f64.sqrt();
    assert!((found.share - share).abs() < 0.05 && found.p_value < 1e-10, "{found:?}");
    assert!((found.degrees - 26.57).abs() < 4.0, "{found:?}");
    let angle = 0.5_f64;
    let turn = |y: &[f64], n: i32| {
        let (sin, cos) = libm::sincos(f64::from(n) * angle);
        [y[0] * cos + y[1] * sin, y[1] * cos - y[0] * sin]
    };
    let turned = track.0.iter().map(|frame| {
        let [centre, z] = [turn(&frame.y[..2], -1), turn(&frame.y[2..4], 2)];
        let y = vec![centre[0], centre[1], z[0], z[1], 0.0, 0.0];
        Observation { y, ..frame.clone() }
    });
    let other = Stretch::of(&Track(turned.collect())).unwrap();
    assert!((other.degrees - found.degrees - angle.to_degrees()).abs() < 1e-9, "{found:?} {other:?}");
    assert!((other.p_value / found.p_value - 1.0).abs() < 1e-6 && (other.share - found.share).abs() < 1e-12);
}

/// Bodies whose equations keep their form under rotations have none, although their frames are far from
/// independent. Legs in two directions are told from them.
#[test]
fn turning_bodies_have_none() {
    let (mut all_directions, mut smallest) = (0, 1.0_f64);
    for seed in 0..100 {
        let mut experiment = Experiment::new(full(0.5, 0.1), 0.02, seed);
        experiment.frames = 400;
        let found = Stretch::of(&experiment.track()).unwrap();
        if found.order < 1.0 / 3.0 {
            all_directions += 1;
            smallest = smallest.min(found.p_value);
        }
    }
    println!("{all_directions} of 100 go in all directions, smallest p = {smallest:.1e}");
    assert!(all_directions >= 50 && smallest > 1e-3, "{all_directions} {smallest}");
    let legs = (0..400).map(|k| {
        let sign = if k / 10 % 2 == 0 { 1.0 } else { -1.0 };
        let y = vec![
            f64::from(k),
            sign * f64::from(k % 10 - 5),
            0.1 + 0.01 * libm::sin(f64::from(k * k)),
            0.05 * sign,
            0.0,
            0.0,
        ];
        Observation { t: f64::from(k), y, covariance: diagonal(&[1e-3; 6]) }
    });
    let found = Stretch::of(&Track(legs.collect())).unwrap();
    assert!(found.is_possible(1) && !found.is_clear(1), "{found:?}");
}

/// Circling cells in square images: p values are not smaller than by chance, and none of them has a stretch. Both sides of the threshold,
/// 1e-4 over the number of cells.
#[test]
fn circles_in_square_images_have_none() {
    let p: Vec<Stretch> = (0..draws(100, 400))
        .map(|seed| {
            let experiment = Experiment::new(full(0.5, 0.3), 0.02, 4000 + seed);
            Stretch::of(&Experiment { frames: 250, interval: 1.0, ..experiment }.track()).unwrap()
        })
        .collect();
    let below = |level: f64| p.iter().filter(|one| one.p_value < level).count();
    println!("{} below 0.05, {} below 0.01, {} below 1e-3", below(0.05), below(0.01), below(1e-3));
    // means 20 and 4 of 400, four standard deviations; of 100 more than 13 and 5 have a probability of 5e-4 each
    let most = draws([13, 5], [37, 12]);
    assert!(below(0.05) <= most[0] && below(0.01) <= most[1] && p.iter().all(|one| !one.is_clear(1)));
    let at = |p_value: f64, cells: usize| {
        Stretch { share: 0.09, degrees: 0.0, p_value, order: 0.1 }.is_clear(cells)
    };
    assert_eq!([at(1.1e-4, 1), at(0.9e-4, 1), at(1.1e-5, 10), at(0.9e-5, 10)], [false, true, false, true]);
    assert!(!Stretch { share: 0.049, degrees: 0.0, p_value: 1e-12, order: 0.1 }.is_clear(1));
}

/// y of a cell of radius 0.6 multiplied by 1 - part, to first order: its path, and a constant in z2.
fn stretched(track: &Track, part: f64) -> Track {
    let mut frames = track.0.clone();
    for frame in &mut frames {
        frame.y[1] *= 1.0 - part;
        frame.y[2] += 0.25 * part * 0.6;
    }
    Track(frames)
}

/// A circle in images that are stretched by 3 and 5 % is called handed by its likelihood, and not beside a strain of
/// the path and a constant elongation; a cell that is handed stays so.
#[test]
fn a_stretch_is_no_handedness() {
    let p_values = |equations: Equations, noise: f64, part: f64, seed: u64| {
        let still = Experiment { frames: 600, ..Experiment::new(equations, noise, seed) }.track();
        let tracks = [stretched(&still, part)];
        let library = Library::tensor().select(&FULL).unwrap();
        let real = fit(&tracks, &Settings { library, ..Settings::default() }, &()).unwrap();
        let found = handedness(&tracks, &real, &()).unwrap();
        (found.p_value, handed_beside(Beside::Stretch, &tracks, [&real, &found.fit], &()).unwrap())
    };
    let circle = p_values(full(0.5, 0.3), 0.005, 0.05, 9);
    // too small for a warning, and clear enough for a likelihood
    let small: Vec<(f64, f64)> =
        (9..draws(11, 15)).map(|seed| p_values(full(0.5, 0.3), 0.005, 0.03, seed)).collect();
    println!("3 %: {small:?}");
    assert!(
        small.iter().all(|one| one.1 > HANDED_RATE) && small.iter().any(|one| one.0 < HANDED_RATE),
        "{small:?}"
    );
    let mut equations = full(0.5, 0.1);
    equations[3].1 = Complex::new(-0.5, 0.1);
    let handed = p_values(equations, 0.02, 0.05, 9);
    println!("circle {circle:?}, handed {handed:?}");
    assert!(circle.0 < HANDED_RATE && circle.1 > HANDED_RATE, "{circle:?}");
    assert!(handed.0 < HANDED_RATE && handed.1 < HANDED_RATE, "{handed:?}");
}
