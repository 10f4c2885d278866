//! Tracks with gaps: exact processes with samples left out.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{agrees, holds, known, ornstein_uhlenbeck};
use motiform_dynamics::Normal;
use motiform_statistics::{
    GappedVectors, PathPiece, Quantity, Settings, Track, Tracks, autocorrelation, diffusion, furth,
    mean_square, mean_square_of_paths, statistics,
};

/// Every sample is lost with this probability, and so is one stretch of 40.
fn gaps(samples: usize, share: f64, normal: &mut Normal) -> Vec<bool> {
    let hole = samples / 3..samples / 3 + 40;
    (0..samples)
        .map(|at| hole.contains(&at) || libm::erf(normal.next() / 2.0_f64.sqrt()) < 2.0 * share - 1.0)
        .collect()
}

fn tracks(share: f64, bodies: u64, seed: u64) -> Tracks {
    let body = |k| {
        let mut normal = Normal::new(seed, k);
        let track = ornstein_uhlenbeck(0.5, 1.0, 0.5, 600, &mut normal);
        let mode = track.velocity.iter().map(|v| [0.1 * v[0], 0.1 * v[1]]).collect();
        let missing = gaps(600, share, &mut normal);
        Track { modes: vec![mode], ..track }.without(&missing)
    };
    Tracks::with_gaps(0.5, vec!["s".into()], (0..bodies).map(body).collect()).unwrap()
}

#[test]
fn pairs_that_are_there_are_averaged() {
    let tracks = tracks(0.3, 9, 31);
    let curve = mean_square(&tracks);
    let velocity = autocorrelation(&tracks, &Quantity::Velocity).unwrap();
    let dot = |a: &[f64; 2], b: &[f64; 2]| a[0] * b[0] + a[1] * b[1];
    for lag in [1, 5] {
        let (mut square, mut product, mut count) = (0.0, 0.0, 0.0);
        for track in tracks.bodies() {
            for at in 0..600 - lag {
                let (a, b) = (track.position[at], track.position[at + lag]);
                if a[0].is_nan() || b[0].is_nan() {
                    continue;
                }
                square += (b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2);
                product += dot(&track.velocity[at], &track.velocity[at + lag]);
                count += 1.0;
            }
        }
        let place = (0..curve.len()).find(|&place| curve.lag(place) == 0.5 * lag as f64).unwrap();
        assert!((curve.measured(place).value / (square / count) - 1.0).abs() < 1e-12);
        let rho = product / count / velocity.variance.value;
        assert!((velocity.correlation[lag].value - rho).abs() < 1e-9, "{lag}");
    }
}

/// Pieces of paths in the groups of the tracks have the curve of the tracks.
#[test]
fn paths_in_pieces_have_the_curve_of_their_tracks() {
    let tracks = tracks(0.3, 9, 31);
    let curve = mean_square(&tracks);
    let groups: Vec<_> = (0..9).map(|body: usize| move |_: usize| body).collect();
    let bodies = tracks.bodies().iter().zip(&groups);
    let pieces: Vec<PathPiece<'_>> =
        bodies.map(|(track, group)| PathPiece { position: &track.position, group }).collect();
    let other = mean_square_of_paths(0.5, &pieces, 9);
    assert_eq!(curve.len(), other.len());
    for place in 0..curve.len() {
        let (a, b) = (curve.measured(place), other.measured(place));
        assert!((a.value / b.value - 1.0).abs() < 1e-12 && a.interval.is_some(), "{a:?} {b:?}");
        assert!((a.upper() / b.upper() - 1.0).abs() < 1e-9, "{a:?} {b:?}");
    }
}

#[test]
fn a_third_of_the_frames_may_be_missing() {
    let exact = |found: &Tracks| {
        let all = statistics(found, &Settings::default()).unwrap();
        let [time, mode] = [0, 3].map(|place| known(&all.autocorrelations[place].time));
        assert!(agrees(time, 2.0, 1.5) && agrees(mode, 2.0, 1.5), "{time:?} {mode:?}");
        assert!(agrees(known(&all.diffusion.green_kubo), 2.0, 1.5), "{:?}", all.diffusion);
        assert!(agrees(known(&all.diffusion.displacements), 2.0, 1.5), "{:?}", all.diffusion);
        assert!(agrees(all.rms_speed, 2.0_f64.sqrt(), 1.5) && all.residence.above.time.is_some());
        assert!(agrees(known(&all.walk.persistence), 2.0, 1.5), "{:?}", all.walk);
        for (place, point) in all.displacement.points().iter().enumerate().step_by(3) {
            assert!(agrees(point.value, furth(2.0, 2.0, point.lag), 2.0), "{place}: {point:?}");
        }
    };
    exact(&tracks(0.0, 24, 32));
    exact(&tracks(0.3, 24, 32));
}

/// 100 data sets: 95 of them hold, with a standard deviation of 2.2.
#[test]
fn intervals_hold_with_gaps() {
    let mut counts = [0; 3];
    for seed in 0..100 {
        let tracks = tracks(0.3, 16, 3300 + seed);
        let time = autocorrelation(&tracks, &Quantity::Velocity).unwrap().time;
        let found = diffusion(&tracks).unwrap();
        let held = [time, found.green_kubo, found.displacements].map(|answer| holds(known(&answer), 2.0));
        counts.iter_mut().zip(held).for_each(|(count, held)| *count += usize::from(held));
    }
    println!("time, Green-Kubo, displacements: {counts:?} of 100");
    assert!(counts.iter().all(|&count| count >= 88), "{counts:?}");
}

#[test]
fn what_is_not_enough_is_named() {
    let line = |k: usize| [k as f64, 0.0];
    let track =
        Track { position: (0..40).map(line).collect(), velocity: vec![[1.0, 0.0]; 40], ..Track::default() };
    let missing: Vec<bool> = (0..40).map(|k| k >= 10).collect();
    let error = Tracks::with_gaps(1.0, vec![], vec![track.clone().without(&missing)]).unwrap_err();
    assert!(error.to_string().contains("body 0 has 10 samples, fewer than 16"), "{error}");
    let error = Tracks::new(1.0, vec![], vec![track.without(&missing)]).unwrap_err();
    assert!(error.to_string().contains("leave such bodies out"), "{error}");
}

/// Means, correlations, displacements and turns of one series of vectors are those of its pairs, written out.
#[test]
fn vectors_with_gaps() {
    let mut normal = Normal::new(5, 0);
    let walk: Vec<Option<[f64; 2]>> =
        (0..90).map(|at| (at % 7 != 3).then(|| [normal.next(), normal.next()])).collect();
    let vectors = GappedVectors::of(walk.iter().copied());
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-13, "{a} {b}");
    let mean = |pairs: &[([f64; 2], [f64; 2])], of: &dyn Fn([f64; 2], [f64; 2]) -> f64| {
        pairs.iter().map(|(a, b)| of(*a, *b)).sum::<f64>() / pairs.len() as f64
    };
    for lag in [1_usize, 4, 7] {
        let pairs: Vec<_> = (0..90 - lag).filter_map(|at| walk[at].zip(walk[at + lag])).collect();
        let square = mean(&pairs, &|a, b| (b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2));
        close(vectors.mean_square(lag), square);
        let product = mean(&pairs, &|a, b| a[0] * b[0] + a[1] * b[1]);
        close(vectors.mean_dot(&vectors, lag.cast_signed()), product);
        close(vectors.mean_dot(&vectors, -lag.cast_signed()), product);
        close(vectors.correlations(&[lag])[0], product / vectors.mean_dot(&vectors, 0));
        // Re b exp(2 i angle of a)
        let double = mean(&pairs, &|a, b| {
            let angle = 2.0 * a[1].atan2(a[0]);
            b[0] * angle.cos() - b[1] * angle.sin()
        });
        close(vectors.doubled().mean_dot(&vectors, lag.cast_signed()), double);
        let turns = pairs.iter().map(|(a, b)| (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]));
        assert_eq!(vectors.turns(lag).len(), pairs.len());
        vectors.turns(lag).into_iter().zip(turns).for_each(|(a, b)| close(a, b));
        let steps: Vec<f64> = pairs.iter().map(|(a, b)| (b[0] - a[0]).hypot(b[1] - a[1]) / 0.5).collect();
        let lengths = vectors.displacements(lag, 0.5).lengths();
        assert_eq!(lengths.len(), steps.len());
        lengths.into_iter().zip(steps).for_each(|(a, b)| close(a, b));
    }
    assert!(vectors.mean_square(90).is_nan() && vectors.get(3).is_none() && vectors.len() == 90);
}
