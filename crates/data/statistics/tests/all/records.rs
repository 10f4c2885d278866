//! Few short records: values against those of the whole, and how often intervals hold the exact value.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{holds, known, many, ornstein_uhlenbeck};
use motiform_dynamics::Normal;
use motiform_statistics::{Errors, Quantity, Tracks, autocorrelation, furth, mean_square, persistent_walk};

const SETS: u64 = 200;

fn record(g: f64, dt: f64, samples: usize, seed: u64) -> Tracks {
    let body = ornstein_uhlenbeck(g, 1.0, dt, samples, &mut Normal::new(seed, 0));
    Tracks::of_records(dt, Vec::new(), vec![body]).unwrap()
}

#[test]
fn values_are_those_of_all_windows_of_the_record() {
    let tracks = record(0.5, 0.5, 203, 1);
    assert_eq!(tracks.errors(), Errors::Blocks { count: 8, samples: 25 });
    let curve = mean_square(&tracks);
    let path = &tracks.bodies()[0].position;
    assert!(curve.lag(curve.len() - 1) > 0.5 * 20.0);
    for place in [0, 6, curve.len() - 1] {
        let lag = (curve.lag(place) / 0.5).round() as usize;
        let squares =
            path.iter().zip(&path[lag..]).map(|(a, b)| (b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2));
        let direct = squares.sum::<f64>() / (path.len() - lag) as f64;
        assert!((curve.measured(place).value / direct - 1.0).abs() < 1e-12, "lag {lag}");
    }
    // white errors of the positions: 4 sigma^2 more at every lag
    let less = mean_square(&tracks).less(0.25);
    assert!(
        (0..curve.len()).all(|k| (curve.measured(k).value - less.measured(k).value - 0.25).abs() < 1e-12)
    );
    let velocity = autocorrelation(&tracks, &Quantity::Velocity).unwrap();
    let v = &tracks.bodies()[0].velocity;
    let dot = |lag: usize| {
        let products = v.iter().zip(&v[lag..]).map(|(a, b)| a[0] * b[0] + a[1] * b[1]);
        products.sum::<f64>() / (v.len() - lag) as f64
    };
    assert!((velocity.correlation[20].value - dot(20) / dot(0)).abs() < 1e-12);
    // many records are bodies
    let bodies = many(0.5, 9, |normal| ornstein_uhlenbeck(0.5, 1.0, 0.5, 100, normal), 3).bodies().to_vec();
    assert_eq!(Tracks::of_records(0.5, Vec::new(), bodies).unwrap().errors(), Errors::Bodies { count: 9 });
}

/// 400 samples over 50 persistence times: what a tracked cell gives.
#[test]
fn intervals_hold_the_exact_value_nearly_as_often_as_they_say() {
    let (g, dt) = (0.5, 0.25);
    let mut counts = [0_usize; 5];
    for seed in 0..SETS {
        let tracks = record(g, dt, 400, 4000 + seed);
        let curve = mean_square(&tracks);
        let walk = persistent_walk(&curve);
        let velocity = autocorrelation(&tracks, &Quantity::Velocity).unwrap();
        let exact = |place| furth(2.0, 1.0 / g, curve.lag(place));
        let last = curve.len() - 1;
        let held = [
            holds(curve.measured(3), exact(3)),
            holds(curve.measured(last / 2), exact(last / 2)),
            holds(curve.measured(last), exact(last)),
            holds(velocity.correlation[8], (-g * 8.0 * dt).exp()),
            walk.persistence.known().is_none() || holds(known(&walk.persistence), 1.0 / g),
        ];
        counts.iter_mut().zip(held).for_each(|(count, held)| *count += usize::from(held));
    }
    println!("msd at short, middle, longest lag; velocity; P: {counts:?} of {SETS}");
    let [short, middle, longest, velocity, persistence] = counts;
    assert!(short >= 178 && middle >= 170 && velocity >= 178, "{counts:?}");
    assert!(longest >= 150 && persistence >= 160, "{counts:?}");
}
