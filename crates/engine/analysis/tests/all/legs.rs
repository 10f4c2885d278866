//! Corners, legs and turns of paths that are known in closed form.

use motiform_analysis::{CornerKind, Ends, Error, Legs, PathSample, legs};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

const OPEN: Ends = Ends::Open;

/// A path sampled from its velocity; positions by Simpson's rule over fine steps.
fn path(t_end: f64, count: u32, velocity: impl Fn(f64) -> [f64; 2]) -> Vec<PathSample> {
    let h = t_end / f64::from(count);
    let (mut x, mut y) = (0.3, -0.2);
    (0..=count)
        .map(|j| {
            let t = h * f64::from(j);
            let ([vx, vy], [mx, my], [ex, ey]) = (velocity(t), velocity(t + 0.5 * h), velocity(t + h));
            let sample = PathSample { t, x, y, vx, vy };
            x += h / 6.0 * (vx + 4.0 * mx + ex);
            y += h / 6.0 * (vy + 4.0 * my + ey);
            sample
        })
        .collect()
}

fn turned(path: &[PathSample], angle: f64) -> Vec<PathSample> {
    let (s, c) = angle.sin_cos();
    let turn = |p: &PathSample| PathSample {
        t: p.t,
        x: c * p.x - s * p.y,
        y: s * p.x + c * p.y,
        vx: c * p.vx - s * p.vy,
        vy: s * p.vx + c * p.vy,
    };
    path.iter().map(turn).collect()
}

fn all_near(seen: &[f64], want: &[f64], tolerance: f64) {
    assert_eq!(seen.len(), want.len(), "{seen:?} {want:?}");
    for (s, w) in seen.iter().zip(want) {
        assert!((s - w).abs() < tolerance, "{seen:?} {want:?}");
    }
}

/// Along the sides of a square, one per time unit, at the speed sin^2(pi t): stops at whole times.
fn square(t: f64) -> [f64; 2] {
    let (s, c) = (FRAC_PI_2 * t.floor()).sin_cos();
    let speed = (PI * t).sin().powi(2);
    [speed * c, speed * s]
}

#[test]
fn a_square_with_stops_turns_by_right_angles() {
    let seen = legs(&path(6.0, 1200, square), OPEN).expect("legs");
    assert_eq!(seen.kind, Some(CornerKind::Stop));
    all_near(&seen.corners, &[1.0, 2.0, 3.0, 4.0, 5.0], 1e-3);
    all_near(&seen.turns, &[FRAC_PI_2; 3], 1e-6);
    all_near(&seen.heading_turns, &[FRAC_PI_2; 3], 1e-6);
    for leg in &seen.legs {
        assert!((leg.length - 0.5).abs() < 1e-6); // the mean of sin^2
        assert!((leg.direction - leg.heading).abs() < 1e-6);
    }
    assert!((seen.swing - 5.0 * FRAC_PI_2).abs() < 1e-9, "{}", seen.swing);
}

#[test]
fn one_side_of_a_square_is_a_period_with_net_rotation() {
    for cut in [0.0, 0.003, 0.25, 0.5, 0.997] {
        // wherever the period is cut, at the stop as well
        let side = path(1.0, 200, |t| square(t + cut));
        let seen = legs(&side, Ends::Periodic { rotation: FRAC_PI_2 }).expect("legs");
        all_near(&seen.turns, &[FRAC_PI_2], 1e-6);
        all_near(&seen.heading_turns, &[FRAC_PI_2], 1e-6);
        assert_eq!((seen.corners.len(), seen.legs.len()), (1, 1), "{seen:?}");
        assert!((seen.legs[0].length - 0.5).abs() < 1e-6);
        let off = (seen.corners[0] + cut).fract(); // from a whole time
        assert!(off.min(1.0 - off) < 6e-3, "{cut}: {:?}", seen.corners);
    }
}

/// Heading +-0.6 in turn, at constant speed; at whole times it turns within 0.02.
fn triangle(t: f64) -> [f64; 2] {
    let heading = 0.6 * ((PI * t).sin() / 0.03).tanh();
    [heading.cos(), heading.sin()]
}

#[test]
fn a_triangle_wave_turns_by_twice_its_slope() {
    let wave = path(6.5, 13_000, triangle);
    let seen = legs(&wave[500..], OPEN).expect("legs"); // from t = 1/4
    assert_eq!((seen.kind, seen.heading_turns.len()), (Some(CornerKind::Bend), 0));
    all_near(&seen.corners, &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0], 1e-3);
    // rounded corners: the chord between the middles of two bends is a little flatter than the leg
    all_near(&seen.turns, &[1.2, -1.2, 1.2, -1.2], 0.02);
    assert!((seen.swing - 1.2).abs() < 1e-6);
}

/// J0 by its integral (1/pi) int_0^pi cos(a sin u) du, trapezoidal: exact to round-off for a periodic integrand.
fn bessel_j0(a: f64) -> f64 {
    (0..64).map(|j| (a * (PI * f64::from(j) / 64.0).sin()).cos() / 64.0).sum()
}

/// Heading A cos t at unit speed. |turning rate| = A |sin t| is largest at t = pi/2, 3 pi/2, ...; between those the path
/// travels int cos(A cos t) dt = pi J0(A) along and +-int sin(A cos t) dt = +-pi H0(A) across (Struve function).
#[test]
fn a_wavy_path_swings_by_twice_its_amplitude_and_its_legs_are_flatter() {
    let amplitude = 40.0_f64.to_radians();
    let wave = path(5.0 * TAU, 10_000, |t| [(amplitude * t.cos()).cos(), (amplitude * t.cos()).sin()]);
    let seen = legs(&wave, OPEN).expect("legs");
    assert!((seen.swing.to_degrees() - 80.0).abs() < 1e-6, "{}", seen.swing);
    assert_eq!(seen.kind, Some(CornerKind::Bend));
    let corners: Vec<f64> = (0..10).map(|n| PI * (f64::from(n) + 0.5)).collect();
    all_near(&seen.corners, &corners, 1e-3);
    // H0(a) = (2/pi) (a - a^3/9 + a^5/225 - a^7/11025 ...), Abramowitz and Stegun 12.1.4
    let a = amplitude;
    let struve = 2.0 / PI * (a - a.powi(3) / 9.0 + a.powi(5) / 225.0 - a.powi(7) / 11025.0);
    let slope = struve.atan2(bessel_j0(a));
    for (n, leg) in seen.legs.iter().enumerate() {
        let sign = if n % 2 == 0 { -1.0 } else { 1.0 };
        assert!((leg.direction - sign * slope).abs() < 1e-5, "{n}: {leg:?} {slope}");
        assert!((leg.length - PI * struve.hypot(bessel_j0(a))).abs() < 1e-5);
    }
    println!("leg angle {} degrees, turn {} degrees", slope.to_degrees(), 2.0 * slope.to_degrees());
    // one period of it, cut anywhere
    for cut in [0.0, 1.0, FRAC_PI_2] {
        let heading = |t: f64| amplitude * (t + cut).cos();
        let period = path(TAU, 2000, |t| [heading(t).cos(), heading(t).sin()]);
        let seen = legs(&period, Ends::Periodic { rotation: 0.0 }).expect("legs");
        assert_eq!((seen.corners.len(), seen.legs.len(), seen.turns.len()), (2, 2, 2), "{cut}: {seen:?}");
        assert!(seen.turns.iter().all(|turn| (turn.abs() - 2.0 * slope).abs() < 1e-5), "{seen:?}");
        assert!((seen.turns[0] + seen.turns[1]).abs() < 1e-9);
    }
}

#[test]
fn a_full_reversal_turns_by_pi_and_does_not_blow_up() {
    // to and fro along a line, v = cos t through exact and inexact zeros, tilted by round-off
    for (tilt, count) in [(0.0, 4000), (1e-12, 4001), (-1e-12, 3777)] {
        let fro = path(6.0 * TAU, count, |t| [t.cos(), tilt * (3.0 * t).sin()]);
        let seen = legs(&fro, OPEN).expect("legs");
        assert_eq!(seen.kind, Some(CornerKind::Stop));
        assert_eq!(seen.corners.len(), 12);
        assert!((seen.swing - PI).abs() < 1e-3, "{tilt}: {}", seen.swing);
        for (turn, heading) in seen.turns.iter().zip(&seen.heading_turns) {
            assert!((turn.abs() - PI).abs() < 1e-6 && (heading.abs() - PI).abs() < 1e-6);
        }
        assert!(seen.legs.iter().all(|leg| (leg.length - 2.0).abs() < 1e-5));
    }
    // headings a little beside the line, now on one side and now on the other: still to and fro
    for seed in 1..20 {
        let rate = 0.37 * f64::from(seed);
        let fro = path(20.0 * TAU, 12_000, |t| [t.cos(), 1e-4 * t.cos() * (rate * t).sin()]);
        let seen = legs(&fro, OPEN).expect("legs");
        assert!((seen.swing - PI).abs() < 1e-3, "{rate}: {}", seen.swing);
    }
}

#[test]
fn straight_and_circular_motion_have_no_corners() {
    let straight = legs(&path(5.0, 100, |_| [0.6, 0.8]), OPEN).expect("legs");
    let circle = legs(&path(20.0, 2000, |t| [t.cos(), t.sin()]), OPEN).expect("legs");
    for (seen, swing) in [(straight, 0.0), (circle, 20.0)] {
        assert_eq!((seen.kind, seen.corners.len(), seen.legs.len()), (None, 0, 0));
        assert!((seen.swing - swing).abs() < 1e-9);
    }
}

#[test]
fn turns_do_not_know_directions() {
    let wavy = |t: f64| [(0.7 * t.cos()).cos(), (0.7 * t.cos()).sin()];
    let paths = [path(6.0, 1200, square), path(5.0 * TAU, 5000, wavy)];
    for original in &paths {
        let first: Legs = legs(original, OPEN).expect("legs");
        for angle in [0.5, 2.0, -3.0] {
            let seen = legs(&turned(original, angle), OPEN).expect("legs");
            all_near(&seen.turns, &first.turns, 1e-9);
            all_near(&seen.heading_turns, &first.heading_turns, 1e-9);
            all_near(&seen.corners, &first.corners, 1e-9);
            assert!((seen.swing - first.swing).abs() < 1e-9);
        }
    }
}

#[test]
fn bad_input_is_refused() {
    let good = path(3.0, 100, square);
    assert!(matches!(legs(&good[..7], OPEN), Err(Error::TooFew { .. })));
    let refused = |index: usize, change: &dyn Fn(&mut PathSample)| {
        let mut path = good.clone();
        change(&mut path[index]);
        legs(&path, OPEN).expect_err("an error")
    };
    assert!(matches!(refused(9, &|p| p.t = 0.0), Error::Order { index: 9, .. }));
    assert!(matches!(refused(9, &|p| p.vy = f64::NAN), Error::NotFinite { index: 9, .. }));
    assert!(matches!(legs(&good, Ends::Periodic { rotation: f64::NAN }), Err(Error::OutOfRange { .. })));
    assert!(matches!(legs(&path(1.0, 20, |_| [0.0; 2]), OPEN), Err(Error::AtRest)));
    // stops at t = 1, 2; a full circle in between
    let loops = path(3.0, 3000, |t| {
        let (speed, angle) = ((PI * t).sin().powi(2), t * TAU - (TAU * t).sin());
        [speed * angle.cos(), speed * angle.sin()]
    });
    assert!(matches!(legs(&loops, OPEN), Err(Error::ClosedLeg { .. })));
}

proptest! {
    /// The results for samples of any kind, rests and jumps included: numbers, angles in (-pi, pi], lists that belong together.
    #[test]
    fn any_path_has_finite_angles_or_an_error(
        values in prop::collection::vec((0..4_u8, -1.0..1.0f64, -1.0..1.0f64, -5.0..5.0f64, -5.0..5.0f64), 8..60),
        rotation in prop::option::of(-4.0..4.0f64),
    ) {
        let sample = |(j, &(kind, vx, vy, x, y)): (usize, &(u8, f64, f64, f64, f64))| {
            let scale = [0.0, 1e-9, 1.0, 1.0][usize::from(kind)];
            PathSample { t: j as f64, x, y, vx: scale * vx, vy: scale * vy }
        };
        let path: Vec<PathSample> = values.iter().enumerate().map(sample).collect();
        let ends = rotation.map_or(OPEN, |rotation| Ends::Periodic { rotation });
        if let Ok(seen) = legs(&path, ends) {
            prop_assert!(seen.swing.is_finite() && seen.swing >= 0.0);
            if rotation.is_none() {
                prop_assert_eq!(seen.legs.len(), seen.corners.len().saturating_sub(1));
                prop_assert_eq!(seen.turns.len(), seen.legs.len().saturating_sub(1));
            } else {
                // as many of each, where the samples are fine enough for the sense of every turn to be known
                prop_assert!(seen.turns.len() <= seen.legs.len() && seen.legs.len() <= seen.corners.len());
            }
            prop_assert!(seen.corners.windows(2).all(|pair| pair[0] <= pair[1]));
            for angle in seen.turns.iter().chain(&seen.heading_turns) {
                prop_assert!((-PI..=PI).contains(angle));
            }
        }
    }
}
