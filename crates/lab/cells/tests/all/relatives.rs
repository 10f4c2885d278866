//! Spectra, rests, legs, rotation and the 0-1 test of motions that are given by formulas.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_cells::{Finding, Relatives, Sample, observe};
use motiform_dynamics::Normal;
use motiform_tracks::modes::ModeOptions;
use motiform_tracks::synthetic::Synthetic;
use motiform_tracks::{Cell, Outline, Tracks};
use std::f64::consts::{PI, TAU};

/// A body at a time: its place, its heading, and z2 along and across the heading.
struct Body {
    place: [f64; 2],
    heading: f64,
    z2: [f64; 2],
}

const RADIUS: f64 = 1.0;

/// Outlines of a body, with vertices that have noise of this part of the radius.
fn seen(body: impl Fn(usize) -> Body, times: (f64, usize), noise: f64) -> Relatives {
    scaled(body, times, (noise, RADIUS))
}

/// The same of a body of this radius.
fn scaled(
    body: impl Fn(usize) -> Body,
    (dt, frames): (f64, usize),
    (noise, radius): (f64, f64),
) -> Relatives {
    let mut normal = Normal::new(4, 0);
    let outline = |frame: usize| {
        let Body { place, heading, z2 } = body(frame);
        let (sin, cos) = libm::sincos(2.0 * heading);
        let z = vec![[z2[0] * cos + z2[1] * sin, z2[1] * cos - z2[0] * sin], [0.0, 0.0]];
        let mut points = Synthetic { centre: place, r0: radius, z }.vertices(48, 0.0);
        points.iter_mut().flatten().for_each(|x| *x += noise * radius * normal.next());
        Outline { frame: i64::try_from(frame).unwrap(), t: frame as f64 * dt, points, missing: 0 }
    };
    let cell = Cell { name: "one".to_owned(), frames: (0..frames).map(outline).collect() };
    let units = |unit: &str| unit.to_owned();
    let tracks = Tracks {
        cells: vec![cell],
        length_unit: units("um"),
        time_unit: units("s"),
        y_down: None,
        image: None,
        files: Vec::new(),
        notes: Vec::new(),
    };
    let sample = Sample::of_tracks(tracks, &ModeOptions::default());
    observe(&sample.cells[0]).relatives.unwrap()
}

/// Places after unit speed along these headings, in fine steps.
fn path(heading: impl Fn(f64) -> f64, speed: impl Fn(f64) -> f64, dt: f64, frames: usize) -> Vec<[f64; 2]> {
    let (fine, mut at, mut all) = (50, [0.0, 0.0], Vec::new());
    for step in 0..fine * frames {
        if step % fine == 0 {
            all.push(at);
        }
        let h = dt / fine as f64;
        let t = (step as f64 + 0.5) * h;
        at = [at[0] + h * speed(t) * libm::cos(heading(t)), at[1] + h * speed(t) * libm::sin(heading(t))];
    }
    all
}

/// Heading A sin(2 pi t/P): the swing is 2 A, there are two corners a period, and the chord of a leg is J_0(A) P/2 along the mean
/// direction and H_0(A) P/2 to the side (Bessel's and Struve's functions; here by their series).
#[test]
fn a_zigzag_has_its_legs_turns_and_period() {
    let (amplitude, period, dt, frames) = (0.8, 20.0, 0.5, 600);
    let heading = |t: f64| amplitude * libm::sin(TAU * t / period);
    let places = path(heading, |_| 1.0, dt, frames);
    let body = |frame: usize| {
        let t = frame as f64 * dt;
        Body { place: places[frame], heading: heading(t), z2: [0.15, 0.05 * libm::cos(TAU * t / period)] }
    };
    let found = seen(body, (dt, frames), 0.01);
    let legs = found.legs.found().unwrap();
    let [forward, sideways] = [0.846_287, 0.473_995].map(|part| part * period / 2.0); // J_0(0.8), H_0(0.8)
    println!("{legs:?}");
    assert!((28..=30).contains(&legs.corners), "{}", legs.corners);
    assert!((legs.duration.unwrap() - 10.0).abs() <= dt, "{:?}", legs.duration);
    assert!((legs.swing.unwrap() - 2.0 * amplitude).abs() < 0.1, "{:?}", legs.swing);
    assert!((legs.length.unwrap() - libm::hypot(forward, sideways)).abs() < 0.3, "{:?}", legs.length);
    assert!((legs.turn.unwrap() - 2.0 * libm::atan2(sideways, forward)).abs() < 0.1, "{:?}", legs.turn);
    let across = found.spectra.iter().find(|of| of.quantity == "z2 across").unwrap();
    assert!((across.peaks[0].frequency - 1.0 / period).abs() < 0.3 * across.spacing, "{:?}", across.peaks);
    assert!(found.rotation.heading.abs() < 0.3 && (found.rotation.swing - 1.6).abs() < 0.2);
    assert_eq!(found.rests.found().unwrap().count, 0);
}

/// Six units of time on the way, four at rest.
#[test]
fn stop_and_go_has_its_rests() {
    let (dt, frames) = (0.2, 1000);
    let speed = |t: f64| if t % 10.0 < 6.0 { 1.0 } else { 0.0 };
    let places = path(|_| 0.3, speed, dt, frames);
    let body = |frame: usize| Body { place: places[frame], heading: 0.3, z2: [0.1, 0.0] };
    let found = seen(body, (dt, frames), 0.005);
    let rests = found.rests.found().unwrap();
    println!("{rests:?}");
    assert!((19..=20).contains(&rests.count), "{}", rests.count);
    assert!((rests.duration.unwrap() - 4.0).abs() < 0.5 && (rests.share - 0.4).abs() < 0.05, "{rests:?}");
    assert!((rests.growth.unwrap() - 1.0).abs() < 0.1);
    let speed = found.spectra.iter().find(|of| of.quantity == "speed").unwrap();
    assert!((speed.peaks[0].frequency - 0.1).abs() < 0.3 * speed.spacing, "{:?}", speed.peaks);
    // a body that rests all the time: noise alone has neither rests nor legs
    let resting = seen(|_| Body { place: [0.0; 2], heading: 0.0, z2: [0.1, 0.0] }, (dt, 400), 0.01);
    assert!(
        matches!(resting.rests, Finding::Missing { .. }) && matches!(resting.legs, Finding::Missing { .. })
    );
}

/// Legs of 9 lengths, corners of 1.2 rad to one side and the other, and ten frames of rest at each corner: rests have no heading, so legs,
/// corners and their durations are those of the path, also in other units of length and time.
#[test]
fn legs_are_those_of_the_path_whatever_rests_and_units() {
    let (go, rest, swing) = (15, 10, 1.2);
    let mut places: Vec<([f64; 2], f64)> = vec![([0.0; 2], 0.0)];
    for k in 0..16 * (go + rest) {
        let (at, heading) = (places[k].0, if k / (go + rest) % 2 == 0 { 0.3 } else { 0.3 + swing });
        let step = if k % (go + rest) < go { 0.6 } else { 0.0 };
        places.push(([at[0] + step * libm::cos(heading), at[1] + step * libm::sin(heading)], heading));
    }
    let found = |length: f64, time: f64| {
        let body = |k: usize| {
            let ([x, y], heading) = places[k];
            Body { place: [length * x, length * y], heading, z2: [0.05 * length, 0.0] }
        };
        let found = scaled(body, (time, places.len()), (0.004, length));
        found.legs.found().unwrap().clone()
    };
    let legs = found(1.0, 1.0);
    println!("{legs:?}");
    let near = |found: Option<f64>, truth: f64| (found.unwrap() / truth - 1.0).abs() < 0.01;
    // the first and the last leg are no extremes
    assert_eq!(legs.corners, 13, "of 16 legs");
    assert!(near(legs.length, 9.0) && near(legs.swing, swing) && near(legs.turn, swing), "{legs:?}");
    assert!(near(legs.duration, 25.0), "{legs:?}");
    let other = found(1000.0, 60.0);
    let ratio = |k: [Option<f64>; 2]| k[1].unwrap() / k[0].unwrap();
    for (ratio, unit) in [
        (ratio([legs.length, other.length]), 1000.0),
        (ratio([legs.duration, other.duration]), 60.0),
        (ratio([legs.swing, other.swing]), 1.0),
        (ratio([legs.turn, other.turn]), 1.0),
    ] {
        assert!((ratio / unit - 1.0).abs() < 1e-9, "{ratio} for {unit}");
    }
}

/// A turn within one sample is in the middle of it: which of two samples is nearer must not be a matter of round-off.
#[test]
fn corners_of_a_walk_do_not_depend_on_units() {
    let mut normal = Normal::new(8, 3);
    let (mut at, mut heading, mut places) = ([0.0; 2], 0.0, Vec::new());
    for _ in 0..200 {
        places.push((at, heading));
        heading += 0.8 * normal.next();
        at = [at[0] + 0.5 * libm::cos(heading), at[1] + 0.5 * libm::sin(heading)];
    }
    let found = |length: f64, time: f64| {
        let body = |k: usize| {
            let ([x, y], heading) = places[k];
            Body { place: [length * x, length * y], heading, z2: [0.05 * length, 0.0] }
        };
        scaled(body, (time, places.len()), (0.004, length)).legs.found().unwrap().clone()
    };
    let legs = found(1.0, 1.0);
    for (length, time) in [(1000.0, 60.0), (0.1, 1.0 / 3.0), (7.3, 0.7)] {
        let other = found(length, time);
        assert_eq!(other.corners, legs.corners);
        for (a, b) in [(other.length, legs.length.map(|x| length * x)), (other.turn, legs.turn)] {
            assert!((a.unwrap() / b.unwrap() - 1.0).abs() < 1e-9, "{other:?} {legs:?}");
        }
    }
}

#[test]
fn a_circle_turns_and_has_neither_legs_nor_rests() {
    for sense in [1.0, -1.0] {
        let (dt, frames, rate) = (0.25, 401, sense * 0.5);
        let places = path(|t| rate * t, |_| 1.0, dt, frames);
        let body =
            |frame: usize| Body { place: places[frame], heading: rate * frame as f64 * dt, z2: [0.2, 0.1] };
        let found = seen(body, (dt, frames), 0.005);
        let turns = rate * 100.0 / TAU;
        assert!((found.rotation.shape.unwrap() - turns).abs() < 0.05, "{:?}", found.rotation);
        assert!((found.rotation.heading - turns).abs() < 0.3, "{:?}", found.rotation);
        assert_eq!((found.legs.found().unwrap().corners, found.rests.found().unwrap().count), (0, 0));
        assert!(found.spectra.iter().all(|of| of.peaks.is_empty()), "{:?}", found.spectra[0].peaks);
    }
}

/// K of a shape that moves with two frequencies, by the logistic map, and at random.
#[test]
fn the_zero_one_test_tells_regular_from_irregular() {
    let (dt, frames) = (1.0, 1200);
    let k = |across: &dyn Fn(usize) -> f64| {
        let body = |frame: usize| Body { place: [frame as f64, 0.0], heading: 0.0, z2: [0.3, across(frame)] };
        *seen(body, (dt, frames), 0.0005).zero_one.found().unwrap()
    };
    let regular = k(&|frame| {
        0.1 * (libm::cos(1.9 * frame as f64) + libm::cos(frame as f64 * 1.9 * (5_f64.sqrt() - 1.0) / PI))
    });
    let mut x = 0.3;
    let logistic: Vec<f64> = (0..frames)
        .map(|_| {
            x = 4.0 * x * (1.0 - x);
            0.2 * x
        })
        .collect();
    let mut normal = Normal::new(9, 0);
    let noise: Vec<f64> = (0..frames).map(|_| 0.05 * normal.next()).collect();
    let (chaos, random) = (k(&|frame| logistic[frame]), k(&|frame| noise[frame]));
    println!("{regular:?} {chaos:?} {random:?}");
    assert!(regular.k < 0.2 && chaos.k > 0.9 && random.k > 0.9);
    let short = seen(
        |frame| Body { place: [frame as f64, 0.0], heading: 0.0, z2: [0.3, noise[frame]] },
        (1.0, 150),
        0.001,
    );
    assert!(matches!(&short.zero_one, Finding::Missing { reason } if reason.contains("200 are needed")));
}
