//! The weak form on exact tracks.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{Experiment, FULL, full};
use motiform_inference::{Library, weak};

/// Equations without terms are no matter: the others are estimated.
#[test]
fn equations_without_terms() {
    let mut experiment = Experiment::new(full(0.5, 0.1), 0.0, 1);
    (experiment.interval, experiment.errors) = (0.1, [1e-6; 2]);
    let library = Library::tensor().select(&FULL[..6]).unwrap();
    let found = weak(&[experiment.track()], &library).unwrap();
    assert!((found.coefficients.unwrap()[0] - 1.0).abs() < 0.1);
}

#[test]
fn exact_tracks() {
    let mut experiment = Experiment::new(full(0.5, 0.1), 0.0, 1);
    experiment.interval = 0.1;
    experiment.errors = [0.0; 2];
    let found = weak(&[experiment.track()], &Library::tensor()).unwrap();
    let c = found.coefficients.unwrap();
    for (name, (_, truth, _)) in FULL.iter().zip(&experiment.equations) {
        let place = found.names.iter().position(|known| known == name).unwrap();
        println!("{name} {} {}", truth.re, c[place]);
        assert!((c[place] - truth.re).abs() < 0.05 * truth.re.abs().max(0.02), "{name}");
    }
}
