//! Equal eigenvalues and equal multipliers: what is followed does not depend on them.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::ranges::plane;
use motiform_analysis::periodic::PeriodicGuess;
use motiform_analysis::{PeriodicOrbit, RelativeEquilibrium};
use motiform_continuation::{Branch, End, Family2, Point, Settings};

/// `z1' = (p - |z1|^2 + 2i) z1` beside amplitudes that decay alone: at p = 0.5 the radial multiplier is that of a rate of 1. Where they
/// were equal, no orbit was found.
#[test]
fn an_orbit_is_found_beside_silent_amplitudes_of_any_rate() {
    for rates in [&[0.9][..], &[1.0], &[1.1], &[1.0, 1.0, 1.0], &[2.0, 2.0], &[0.3, 1.0, 1.0]] {
        let silent = rates.iter().enumerate().map(|(i, rate)| format!("-{rate}*z{}", i + 2));
        let equations: Vec<String> =
            std::iter::once("(p - |z1|^2 + 2*i)*z1".to_owned()).chain(silent).collect();
        let family = plane("none", &equations.iter().map(String::as_str).collect::<Vec<_>>());
        let along = |p: f64| family.at([p, 0.0]);
        let settings = Settings::over(1.0, -0.5);
        let mut shape = vec![0.0; 2 * equations.len()];
        (shape[0], shape[1]) = (0.6 * f64::sqrt(0.5), 0.8 * f64::sqrt(0.5));
        let (body, time) = (along(0.5).unwrap(), std::f64::consts::PI);
        let guess = PeriodicGuess { shape: &shape, time, angle: 0.0, mirrored: false };
        for rtol in [1e-9, 1e-12] {
            let mut flow = settings.flow;
            flow.control = motiform_dynamics::StepControl::Adaptive { rtol, atol: 1e-3 * rtol };
            let start = PeriodicOrbit::find(body.as_ref(), &guess, &flow, &());
            let start = start.unwrap_or_else(|| unreachable!("{rates:?}, {rtol:e}: not found"));
            let mut branch = Branch::of_orbits(&along, 0.5, &start, &settings, &()).unwrap();
            let points: Vec<Point> = branch.by_ref().collect();
            assert!(matches!(branch.end(), Some(End::Shrinks { parameter, .. }) if parameter.abs() < 1e-8));
            for point in points {
                let mut expected: Vec<f64> = rates.iter().flat_map(|rate| [*rate; 2]).collect();
                expected.push(2.0 * point.parameter);
                expected.sort_by(f64::total_cmp);
                let found = point.motion.orbit().unwrap().exponents();
                let off = found.iter().zip(&expected).map(|(x, rate)| (x + rate).abs()).fold(0.0, f64::max);
                // a group of equal multipliers may be off by the root of the accuracy of the flow
                assert!(
                    found.len() == expected.len() && off < 1e-6,
                    "{rates:?} {}: {found:?}",
                    point.parameter
                );
            }
        }
    }
}

/// `x_k' = a_k (p + 2 m - m^3) - x_k` with a mean `m = sum_k w_k x_k`: all eigenvalues but one are -1. With `S = sum_k w_k a_k` the branch
/// is `m = S (p + 2 m - m^3)`, with folds at `3 m^2 = 2 - 1/S`. Without eigenvalues it was `singular` after some points.
#[test]
fn folds_are_found_where_all_other_eigenvalues_are_equal() {
    let weights = [0.17, 0.31, 0.07, 0.11, 0.23, 0.41, 0.29, 0.19];
    for count in 1..=4 {
        let weight = |k: usize| (weights[2 * k], weights[2 * k + 1]);
        let input = |k: usize| (1.1 + 0.1 * k as f64, 0.7 * (k + 1) as f64);
        let terms: Vec<String> =
            (0..count).map(|k| format!("{}*re(z{2})+{}*im(z{2})", weight(k).0, weight(k).1, k + 1)).collect();
        let mean = terms.join("+");
        let equation = |k: usize| {
            let (re, im) = input(k);
            format!("({re}+{im}*i)*(p + 2*({mean}) - ({mean})^3) - z{}", k + 1)
        };
        let equations: Vec<String> = (0..count).map(equation).collect();
        let family = plane("none", &equations.iter().map(String::as_str).collect::<Vec<_>>());
        let sum: f64 = (0..count).map(|k| weight(k).0 * input(k).0 + weight(k).1 * input(k).1).sum();
        let slowest = 2.0 - 1.0 / sum;
        let along = |p: f64| family.at([p, 0.0]);
        let settings = Settings::over(-3.0, 3.0);
        let start = RelativeEquilibrium::find(along(-3.0).unwrap().as_ref(), &vec![-2.0; 2 * count]).unwrap();
        let points = Branch::of_equilibria(&along, -3.0, &start, &settings, &()).unwrap();
        let found: Vec<(f64, &str)> =
            points.filter_map(|point| Some((point.parameter, point.special?.name()))).collect();
        if slowest < 0.0 {
            assert!(found.is_empty(), "{count}: {found:?}");
            continue;
        }
        let m = (slowest / 3.0).sqrt();
        let fold = 2.0 * m - m.powi(3) - m / sum;
        let [(up, "fold"), (down, "fold")] = found[..] else { unreachable!("{count}: {found:?}") };
        assert!((up - fold).abs() < 1e-9 && (down + fold).abs() < 1e-9, "{count}: {found:?}, {fold}");
    }
}
