//! The coverage of 95 % intervals: the share of 200 data sets in which they hold the exact value.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{active_brownian, holds, known, many, ornstein_uhlenbeck};
use motiform_dynamics::Normal;
use motiform_statistics::{
    Quantity, Settings, Track, Tracks, autocorrelation, diffusion, furth, histogram, local_exponent,
    mean_square, persistent_walk, statistics,
};

const SETS: u64 = 200;

/// 95 % of 200 are 190; three standard deviations of a binomial variable are 9.2.
const LEAST: usize = 181;

/// The number of data sets whose intervals hold each of the values.
fn counts<const N: usize>(
    tracks: impl Fn(u64) -> Tracks,
    mut hold: impl FnMut(&Tracks) -> [bool; N],
) -> [usize; N] {
    let mut counts = [0; N];
    for seed in 0..SETS {
        for (count, held) in counts.iter_mut().zip(hold(&tracks(seed))) {
            *count += usize::from(held);
        }
    }
    counts
}

#[test]
fn over_bodies() {
    let (d_r, dt) = (0.5, 0.25);
    let set = |seed| many(dt, 24, |normal| active_brownian((d_r, 0.0, 0.0), dt, 400, normal), 1000 + seed);
    let found = counts(set, |tracks| {
        let curve = mean_square(tracks);
        let walk = persistent_walk(&curve);
        let time = autocorrelation(tracks, &Quantity::Velocity).unwrap().time;
        [
            holds(curve.measured(20), crate::common::active_msd((d_r, 0.0, 0.0), curve.lag(20))),
            holds(known(&walk.persistence), 1.0 / d_r),
            holds(known(&walk.diffusion), 0.5 / d_r),
            diffusion(tracks).unwrap().displacements.known().is_none_or(|late| holds(late, 0.5 / d_r)),
            holds(known(&time), 1.0 / d_r),
        ]
    });
    println!("msd, P, D, late D, correlation time: {found:?} of {SETS}");
    assert!(found.iter().all(|&count| count >= LEAST), "{found:?}");
}

/// Twelve bodies whose records are 60, 200 and 800 samples long, of which few reach the longest lags: what is stated there holds, and a
/// walk is fitted to lags whose errors are known.
#[test]
fn over_bodies_of_unequal_length() {
    let (g, dt) = (0.5, 0.5);
    let set = |seed: u64| {
        let mut normal = Normal::new(4000 + seed, 0);
        let mut body = || {
            let samples = [60, 200, 200, 800][(normal.uniform() * 4.0) as usize % 4];
            ornstein_uhlenbeck(g, 0.5_f64.sqrt(), dt, samples, &mut normal)
        };
        Tracks::new(dt, Vec::new(), (0..12).map(|_| body()).collect()).unwrap()
    };
    let (mut stated, mut walks) = ([0; 2], 0);
    let found = counts(set, |tracks| {
        let curve = mean_square(tracks);
        let last = curve.len() - 1;
        let half = (0..last).min_by(|a, b| {
            let off = |place: &usize| (curve.lag(*place) - 0.5 * curve.lag(last)).abs();
            off(a).total_cmp(&off(b))
        });
        let exact = |place: usize| furth(1.0, 1.0 / g, curve.lag(place)).ln();
        let (from, to) = (half.unwrap(), last);
        let slope = (exact(to) - exact(from)) / (curve.lag(to) / curve.lag(from)).ln();
        let exponent = local_exponent(&curve, false).known();
        let velocity = autocorrelation(tracks, &Quantity::Velocity).unwrap();
        let late = *velocity.correlation.last().unwrap();
        for (count, is_stated) in stated.iter_mut().zip([exponent.is_some(), late.interval.is_some()]) {
            *count += usize::from(is_stated);
        }
        walks += usize::from(persistent_walk(&curve).persistence.known().is_some());
        [exponent.is_none_or(|one| holds(one, slope)), late.interval.is_none() || holds(late, 0.0)]
    });
    println!("exponent, late correlation: {found:?} of {SETS}, {stated:?} stated; {walks} walks");
    assert!(found.iter().all(|&count| count >= LEAST) && walks > 190, "{found:?} {stated:?} {walks}");
}

/// The sum of two Ornstein-Uhlenbeck velocities of persistence 1 and 5 is near a persistent random walk: where it is taken for one, its
/// speed and coefficient hold those of the motion.
#[test]
fn of_a_walk_that_is_one_nearly() {
    let (dt, s) = (0.5, 0.7 / 2.0_f64.sqrt());
    let body = |normal: &mut Normal| {
        let [one, other] = [1.0, 0.2].map(|g| ornstein_uhlenbeck(g, s, dt, 300, normal));
        let sum = |a: Vec<[f64; 2]>, b: Vec<[f64; 2]>| {
            a.into_iter().zip(b).map(|(a, b)| [a[0] + b[0], a[1] + b[1]]).collect()
        };
        Track {
            position: sum(one.position, other.position),
            velocity: sum(one.velocity, other.velocity),
            ..Track::default()
        }
    };
    let (mut stated, mut held) = (0, [0; 2]);
    for seed in 0..80 {
        let found = statistics(&many(dt, 12, body, 6000 + seed), &Settings::default()).unwrap();
        if let (Some(speed), Some(coefficient)) = (found.walk.speed.known(), found.walk.diffusion.known()) {
            stated += 1;
            held[0] += usize::from(holds(speed, 2.0 * s));
            held[1] += usize::from(holds(coefficient, s * s * 6.0));
        }
    }
    println!("S, D: {held:?} of {stated}");
    assert!(stated > 40 && held.iter().all(|&count| 100 * count >= 85 * stated), "{held:?} of {stated}");
}

/// One body, 16 blocks of 60 correlation times.
#[test]
fn over_blocks_of_one_body() {
    let (g, s, dt) = (0.5, 1.0, 0.25);
    let set = |seed| many(dt, 1, |normal| ornstein_uhlenbeck(g, s, dt, 8000, normal), 2000 + seed);
    let found = counts(set, |tracks| {
        let curve = mean_square(tracks);
        let walk = persistent_walk(&curve);
        let velocity = autocorrelation(tracks, &Quantity::Velocity).unwrap();
        [
            holds(curve.measured(10), furth(2.0 * s * s, 1.0 / g, curve.lag(10))),
            holds(known(&walk.persistence), 1.0 / g),
            holds(known(&walk.diffusion), s * s / g),
            holds(velocity.variance, 2.0 * s * s),
        ]
    });
    println!("msd, P, D, <v^2>: {found:?} of {SETS}");
    assert!(found.iter().all(|&count| count >= LEAST), "{found:?}");
}

/// Shares of a correlated variable: the mean over the bins of how often the interval holds the exact share.
#[test]
fn of_histograms() {
    let (g, dt, edges, bins) = (0.5, 0.25, (-3.0, 3.0), 12);
    let mut held = 0;
    for seed in 0..SETS {
        let tracks = many(dt, 20, |normal| ornstein_uhlenbeck(g, 1.0, dt, 300, normal), 3000 + seed);
        let of = |(unit, track): (usize, &Track)| {
            track.velocity.iter().map(move |v| (unit, v[0])).collect::<Vec<_>>()
        };
        let samples: Vec<_> = tracks.units().iter().enumerate().flat_map(of).collect();
        let found = histogram(&samples, tracks.groups(), edges, bins);
        assert!(found.independent < 0.5 * found.samples as f64);
        let exact = |k: usize| 0.5 * libm::erf((k as f64 * 0.5 - 3.0) / 2.0_f64.sqrt());
        for (k, bin) in found.bins.iter().enumerate().skip(1).take(bins - 2) {
            let density = (exact(k + 1) - exact(k)) / 0.5;
            held += usize::from((bin.lower..=bin.upper).contains(&density));
        }
    }
    let share = held as f64 / (SETS as usize * (bins - 2)) as f64;
    println!("bins: {share:.3}");
    assert!((0.92..=0.99).contains(&share), "{share}"); // one design effect for all bins
}
