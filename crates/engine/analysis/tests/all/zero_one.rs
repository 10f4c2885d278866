//! The 0-1 test on series whose kind is known.

use motiform_analysis::{Error, zero_one};
use std::f64::consts::TAU;

fn logistic(r: f64, count: usize) -> Vec<f64> {
    let orbit = std::iter::successors(Some(0.3), |x: &f64| Some(r * x * (1.0 - x)));
    orbit.skip(1000).take(count).collect()
}

fn k(series: &[f64]) -> f64 {
    let seen = zero_one(series, 42).expect("a K");
    assert!(seen.lower <= seen.k && seen.k <= seen.upper && seen.upper <= 1.0, "{seen:?}");
    seen.k
}

/// Source: Gottwald and Melbourne (2009), sec. 3: r = 3.55 is periodic (K near 0), r = 3.97 chaotic (K near 1).
#[test]
fn the_logistic_map_at_the_two_parameters_of_the_paper() {
    let (regular, chaotic) = (k(&logistic(3.55, 2000)), k(&logistic(3.97, 2000)));
    println!("r = 3.55: {regular}, r = 3.97: {chaotic}");
    assert!(regular.abs() < 0.1 && chaotic > 0.9, "{regular} {chaotic}");
}

#[test]
fn the_answer_does_not_hang_on_the_seed_or_on_a_constant_added() {
    for seed in 0..5 {
        let series = logistic(3.97, 1000);
        let lifted: Vec<f64> = series.iter().map(|x| x + 10.0).collect();
        assert!(zero_one(&series, seed).expect("a K").k > 0.9);
        assert!(zero_one(&lifted, seed).expect("a K").k > 0.9);
        assert_eq!(zero_one(&series, seed).ok(), zero_one(&series, seed).ok());
    }
}

#[test]
fn quasi_periodic_series_are_regular() {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    for count in [500, 2000] {
        let phase = |j: i32| TAU * golden * f64::from(j);
        let series: Vec<f64> =
            (0..count).map(|j| 2.0 + phase(j).cos() + 0.3 * (2.0 * phase(j)).sin()).collect();
        assert!(k(&series).abs() < 0.1, "{count}: {}", k(&series));
    }
}

#[test]
fn a_short_period_is_regular() {
    let series: Vec<f64> = (0..1000).map(|j| f64::from(j % 2)).collect();
    assert!(k(&series).abs() < 0.1, "{}", k(&series));
}

#[test]
fn bad_input_is_refused() {
    assert!(matches!(zero_one(&[0.0; 199], 1), Err(Error::TooFew { least: 200, got: 199, .. })));
    assert!(matches!(zero_one(&[2.5; 300], 1), Err(Error::Constant { value: 2.5 })));
    let mut series = logistic(3.9, 300);
    series[3] = f64::INFINITY;
    assert!(matches!(zero_one(&series, 1), Err(Error::NotFinite { index: 3, .. })));
    series[3] = 1e200;
    assert!(matches!(zero_one(&series, 1), Err(Error::Overflow { .. })));
}
