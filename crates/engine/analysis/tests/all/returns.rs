//! The correlation dimension of sets whose dimension is known.

use motiform_analysis::{Dimension, Error, correlation_dimension, return_pairs};
use motiform_dynamics::Normal;
use std::f64::consts::TAU;

fn dimension(points: &[Vec<f64>]) -> Dimension {
    let seen = correlation_dimension(points, 1e-9).expect("a dimension");
    println!("{} points: {seen:?}", points.len());
    seen
}

/// Points of the golden rotation: what returns of a quasi-periodic orbit look like.
fn rotation(count: u32) -> impl Iterator<Item = f64> {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    (0..count).map(move |j| TAU * golden * f64::from(j))
}

#[test]
fn a_circle_has_dimension_one() {
    // counts of neighbours are even numbers here: a few percent at 8 of them
    for (count, tolerance) in [(200, 0.1), (1000, 0.05), (4000, 0.05)] {
        let points: Vec<Vec<f64>> = rotation(count).map(|a| vec![a.cos(), a.sin()]).collect();
        let seen = dimension(&points);
        assert!((seen.value - 1.0).abs() < tolerance && seen.spread < 0.15, "{count}: {seen:?}");
    }
}

#[test]
fn an_ellipse_in_six_dimensions_has_dimension_one() {
    // spanned by two vectors of lengths 3 and 0.6 that are orthogonal, plus a bend out of their plane
    let (p, q) = ([1.0, 1.0, -1.0, 2.0, 1.0, 1.0], [0.2, -0.2, 0.2, 0.2, -0.3, 0.1]);
    for count in [400, 3000] {
        let points: Vec<Vec<f64>> = rotation(count)
            .map(|a| {
                (0..6).map(|i| p[i] * a.cos() + q[i] * a.sin() + 0.1 * (2.0 * a).sin() * q[5 - i]).collect()
            })
            .collect();
        let seen = dimension(&points);
        assert!((seen.value - 1.0).abs() < 0.12, "{count}: {seen:?}");
    }
}

#[test]
fn finite_sets_have_dimension_zero() {
    let mut normal = Normal::new(1, 0);
    for period in [1, 2, 7, 40] {
        let corners: Vec<Vec<f64>> = (0..period).map(|_| (0..4).map(|_| normal.next()).collect()).collect();
        // each visited many times, to 11 digits
        let points: Vec<Vec<f64>> = (0..1000)
            .map(|j| corners[j % period].iter().map(|x| x + 1e-11 * normal.next()).collect())
            .collect();
        let seen = dimension(&points);
        assert!(seen.value.abs() < 0.05, "period {period}: {seen:?}");
    }
}

/// Source: Grassberger and Procaccia (1983), Physica D 9, 189: D2 = 1.25 +- 0.02 with 20000 points, 1.220 +- 0.036 by
/// Sprott and Rowlands (2001), Int. J. Bifurc. Chaos 11, 1865: both are met by 1.22 +- 0.05.
#[test]
fn the_henon_map_has_its_dimension() {
    let step = |p: &[f64; 2]| Some([1.0 - 1.4 * p[0] * p[0] + p[1], 0.3 * p[0]]);
    let orbit = std::iter::successors(Some([0.1, 0.1]), step).skip(1000);
    let points: Vec<Vec<f64>> = orbit.take(6000).map(|p| p.to_vec()).collect();
    let seen = dimension(&points);
    assert!((seen.value - 1.22).abs() < 0.05, "{seen:?}");
}

#[test]
fn a_filled_square_has_dimension_two_and_needs_more_points() {
    let mut normal = Normal::new(2, 0);
    let mut uniform = || 0.5 * libm::erfc(normal.next() / 2.0_f64.sqrt());
    let points: Vec<Vec<f64>> = (0..4000).map(|_| vec![uniform(), uniform()]).collect();
    assert!((dimension(&points).value - 2.0).abs() < 0.15);
    assert!(matches!(correlation_dimension(&points[..200], 1e-9), Err(Error::Scales { points: 200, .. })));
}

#[test]
fn pairs_are_the_graph_of_the_map() {
    assert_eq!(return_pairs(&[1.0, 2.0, 4.0]), [[1.0, 2.0], [2.0, 4.0]]);
    assert!(return_pairs(&[1.0]).is_empty());
}

#[test]
fn bad_input_is_refused() {
    let mut points = vec![vec![1.0, 2.0]; 300];
    assert!(matches!(correlation_dimension(&points[..199], 1e-9), Err(Error::TooFew { .. })));
    assert!(matches!(correlation_dimension(&points, 0.0), Err(Error::OutOfRange { .. })));
    points[5] = vec![1.0];
    assert!(matches!(correlation_dimension(&points, 1e-9), Err(Error::Shape { expected: 2, got: 1, .. })));
    points[5] = vec![1.0, f64::NAN];
    assert!(matches!(correlation_dimension(&points, 1e-9), Err(Error::NotFinite { index: 5, .. })));
    points[5] = vec![1.0, 1e200];
    assert!(matches!(correlation_dimension(&points, 1e-9), Err(Error::Overflow { .. })));
}
