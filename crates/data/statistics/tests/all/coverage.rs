//! The coverage of 95 % intervals: the share of 200 data sets in which they hold the exact value.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{active_brownian, holds, known, many, ornstein_uhlenbeck};
use motiform_statistics::{
    Quantity, Tracks, autocorrelation, diffusion, histogram, mean_square, persistent_walk,
};

const SETS: u64 = 200;

/// 95 % of 200 are 190; three standard deviations of a binomial variable are 9.2.
const LEAST: usize = 181;

/// The number of data sets whose intervals hold each of the values.
fn counts<const N: usize>(tracks: impl Fn(u64) -> Tracks, hold: impl Fn(&Tracks) -> [bool; N]) -> [usize; N] {
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
            holds(curve.measured(10), motiform_statistics::furth(2.0 * s * s, 1.0 / g, curve.lag(10))),
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
        let of = |(unit, track): (usize, &motiform_statistics::Track)| {
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
