//! Intervals of few bodies, whose records are cut into blocks.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{holds, many, ornstein_uhlenbeck};
use motiform_dynamics::Normal;
use motiform_statistics::{Measured, Settings, Statistics, Track, Tracks, statistics};

const SETS: u64 = 100;

/// A body that moves along a line with the speed 1 or 3, `time` being the correlation time of the speed, and a small fast part.
fn switch(time: f64, dt: f64, samples: usize, normal: &mut Normal) -> Track {
    let (kept, fast) = ((-dt / time).exp(), (-dt).exp());
    let mut side = if normal.next() > 0.0 { 1.0 } else { -1.0 };
    let (mut x, mut part) = (0.0, normal.next());
    let mut track = Track::default();
    for _ in 0..samples {
        let v = 2.0 + side + 0.25 * part;
        track.position.push([x, 0.0]);
        track.velocity.push([v, 0.0]);
        x += dt * v;
        part = fast * part + (1.0 - fast * fast).sqrt() * normal.next();
        // a switch where a normal variable is far from 0: its share is (1 - kept)/2
        let share = libm::erfc(normal.next().abs() / 2.0_f64.sqrt());
        side = if share < 0.5 * (1.0 - kept) { -side } else { side };
    }
    track
}

/// Number of data sets with an interval, and of those of them that hold the exact value.
fn counts(tracks: impl Fn(u64) -> Tracks, of: impl Fn(&Statistics) -> Measured, exact: f64) -> [usize; 2] {
    let mut counts = [0; 2];
    for seed in 0..SETS {
        let found = statistics(&tracks(seed), &Settings::default()).unwrap();
        let measured = of(&found);
        assert_eq!(measured.interval.is_none(), found.no_intervals.is_some(), "{:?}", found.no_intervals);
        counts[0] += usize::from(measured.interval.is_some());
        counts[1] += usize::from(holds(measured, exact));
    }
    counts
}

/// A record of some correlation times does not show how much its mean would change if it went on: no interval, and the reason.
#[test]
fn blocks_that_are_alike_have_no_intervals() {
    for (scale, bodies, samples) in [(1.0, 1, 400), (50.0, 1, 1200), (1.0, 4, 400), (0.01, 7, 200)] {
        let dt = 0.5 * scale;
        let set = |seed| many(dt, bodies, |normal| switch(27.0 * scale, dt, samples, normal), 100 + seed);
        let [known, held] = counts(set, |found| found.mean_speed, 2.0);
        println!("{bodies} bodies, {samples} samples: {held} of {known}");
        assert!(known - held <= 1, "{bodies} bodies, {samples} samples: {held} of {known}");
        let found = statistics(&set(1), &Settings::default()).unwrap();
        let why = found.no_intervals.unwrap();
        assert!(why.starts_with("the speed is not forgotten within blocks"), "{why}");
        assert!(found.displacement.measured(3).interval.is_none());
        assert!(found.autocorrelations[2].variance.interval.is_none());
    }
}

/// Long records have intervals, and these hold.
#[test]
fn blocks_that_are_long_have_intervals_that_hold() {
    let exact = (0.5 * std::f64::consts::PI).sqrt();
    for (bodies, samples, least) in [(1, 400, 0), (1, 1200, 60), (1, 4000, 100), (4, 1600, 100)] {
        let set =
            |seed| many(0.5, bodies, |normal| ornstein_uhlenbeck(0.5, 1.0, 0.5, samples, normal), 700 + seed);
        let [known, held] = counts(set, |found| found.mean_speed, exact);
        println!("{bodies} bodies, {samples} samples: {held} of {known}");
        assert!(
            known >= least && held as f64 >= 0.89 * known as f64 - 0.9,
            "{bodies}, {samples}: {held} of {known}"
        );
        let [known, held] =
            counts(set, |found| found.autocorrelations[2].variance, 2.0 - 0.5 * std::f64::consts::PI);
        assert!(held as f64 >= 0.89 * known as f64 - 0.9, "variance, {bodies}, {samples}: {held} of {known}");
    }
}

/// A turning body of constant speed is never forgotten, and its numbers do not depend on that.
#[test]
fn what_does_not_vary_and_what_is_periodic_have_intervals() {
    let circle = |t: f64| ([t.sin(), -t.cos()], [t.cos(), t.sin()]);
    let pulse = |t: f64| ([t + 0.3 * t.sin(), 0.0], [1.0 + 0.3 * t.cos(), 0.0]);
    let circle = Tracks::new(0.1, vec![], vec![crate::common::along(0.1, 4000, circle)]).unwrap();
    let pulse = Tracks::new(0.1, vec![], vec![crate::common::along(0.1, 4000, pulse)]).unwrap();
    for tracks in [circle, pulse] {
        let found = statistics(&tracks, &Settings::default()).unwrap();
        assert!(
            found.no_intervals.is_none() && found.mean_speed.interval.is_some(),
            "{:?}",
            found.no_intervals
        );
    }
}

/// Coefficients that are known only where a record is long against what it shows: those that are known hold the exact one.
#[test]
fn coefficients_at_the_limit_of_a_record_hold() {
    for (bodies, samples) in [(1, 1200), (100, 80)] {
        let (mut known, mut held) = (0_usize, 0_usize);
        for seed in 0..SETS {
            let set = many(
                0.5,
                bodies,
                |normal| ornstein_uhlenbeck(0.5, 1.0, 0.5, samples, normal),
                9000 + 1000 * seed,
            );
            let found = statistics(&set, &Settings::default()).unwrap().diffusion.green_kubo;
            known += usize::from(found.known().is_some());
            held +=
                usize::from(found.known().is_some_and(|found| found.interval.is_none() || holds(found, 2.0)));
        }
        println!("{bodies} bodies: {held} of {known}");
        assert!(held as f64 >= 0.88 * known as f64, "{bodies} bodies: {held} of {known}");
    }
}
