//! Fits with all 91 terms to fifth order.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use super::common::{Experiment, FULL, full};
use motiform_dynamics::Complex;
use motiform_inference::{Library, Settings, fit, identifiability, select};

fn settings() -> Settings {
    Settings { library: Library::new(3, 5).unwrap(), ..Settings::default() }
}

/// Of 91 terms the nine of the law are found: the others are not asked for.
#[test]
fn a_cell_of_third_order_has_no_terms_of_fifth() {
    let experiment = Experiment::new(full(0.5, 0.1), 0.02, 7);
    let tracks = [experiment.track()];
    let whole = fit(&tracks, &settings(), &()).unwrap();
    assert!(whole.converged() && whole.coefficients.len() == 91, "{:?}", whole.ending);
    let selection = select(&tracks, &whole, &()).unwrap();
    assert!(selection.subsets.complete && identifiability(&selection.fit).identifiable);
    let names: Vec<&str> = selection.fit.coefficients.iter().map(|c| c.name.as_str()).collect();
    assert_eq!(names, FULL);
    for (found, (_, truth, _)) in selection.fit.coefficients.iter().zip(&experiment.equations) {
        let off = (found.estimate.value - truth.re).abs() / found.estimate.error;
        assert!(off < 4.0, "{}: {off:.1} errors from the truth", found.name);
    }
}

/// The velocity is limited by its fourth power: only the fifth order has the term.
#[test]
fn a_term_of_fifth_order_is_found() {
    let mut equations = full(0.5, 0.1);
    equations[2] = (1, Complex::new(-1.0, 0.0), vec![1, 1, 1, -1, -1]);
    let tracks = [Experiment::new(equations, 0.02, 3).track()];
    let whole = fit(&tracks, &settings(), &()).unwrap();
    let selection = select(&tracks, &whole, &()).unwrap();
    let found = selection.fit.coefficient("z1: |z1|^4 z1").map(|c| c.estimate);
    let all = Library::new(3, 5).unwrap().names();
    assert!(all.iter().any(|name| name == "z1: |z1|^4 z1"), "{all:?}");
    let names: Vec<&str> = selection.fit.coefficients.iter().map(|c| c.name.as_str()).collect();
    let found = found.unwrap_or_else(|| panic!("{names:?}"));
    assert!((found.value + 1.0).abs() < 4.0 * found.error, "{found:?}");
}
