//! Exponents of periodic motions in systems of many unknowns do not depend on the start, and are those that are known otherwise.

use crate::common::Folder;
use std::fmt::Write;

/// The exponents and their errors that `motiform classify` states.
fn exponents(folder: &Folder, arguments: &str) -> Vec<(f64, f64)> {
    let json = folder.run(&format!("classify {arguments} --json")).expect(0).json();
    let list = json["exponents"].as_array().expect("exponents").iter();
    let number = |value: &serde_json::Value| value.as_f64().expect("a number");
    list.map(|one| (number(&one["value"]), number(&one["error"]))).collect()
}

/// The stated exponents are the first ones of `exact`, in their order and within their errors; at least so many are stated.
fn assert_are(found: &[(f64, f64)], exact: &[(f64, f64)], least: usize) {
    assert!(found.len() >= least, "{found:?}");
    for ((value, error), (exact, uncertain)) in found.iter().zip(exact) {
        assert!(
            (value - exact).abs() <= 2.0 * (error + uncertain),
            "{value} +- {error}, not {exact}: {found:?}"
        );
    }
    assert!(found.len() <= exact.len(), "{found:?}");
}

/// A cycle of Hopf's normal form that drives nine damped modes: its exponents are exact.
#[test]
fn a_driven_cascade_has_the_rates_that_it_was_given() {
    let folder = Folder::new();
    let mut text = "[model.amplitudes]\nmodes = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10]\nsymmetry = \"none\"\n\
                    [model.amplitudes.equations]\nz1 = \"(1 + i)*z1 - z1^2*conj(z1)\"\n"
        .to_owned();
    let mut exact = vec![(0.0, 0.0), (-2.0, 0.0)];
    for mode in 2..=10 {
        let rate = 0.3 * f64::from(mode - 1);
        writeln!(text, "z{mode} = \"-{rate}*z{mode} + z{}*conj(z1) + 2*z1^2\"", mode - 1).expect("a string");
        exact.extend([(-rate, 0.0); 2]);
    }
    exact.sort_by(|a, b| b.0.total_cmp(&a.0));
    folder.write("cascade.toml", &text);
    for seed in 1..=3 {
        assert_are(&exponents(&folder, &format!("cascade.toml --seed {seed}")), &exact, 9);
    }
}

/// The cell in its window of large turns: values of `motiform lyapunov` over 20,000 times. The next exponent, -.0732, shrinks deviations to
/// e^-24 in half a period; what was stated in its place had depended on the seed.
#[test]
fn the_exponents_of_the_cell_are_those_of_a_long_average() {
    let folder = Folder::new();
    let long = [(0.0, 1.8e-4), (0.0, 1.8e-4), (-0.001_228, 9.7e-5), (-0.013_351, 9.7e-5)];
    for seed in [1, 3] {
        assert_are(&exponents(&folder, &format!("cell --set length=29.6 --seed {seed}")), &long, 3);
    }
}
