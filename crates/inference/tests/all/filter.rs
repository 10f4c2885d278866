//! The likelihood against independent formulas.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common::{Experiment, full};
use motiform_inference::{Parameters, Settings, likelihood};

#[test]
fn gradient_by_differences() {
    let mut experiment = Experiment::new(full(0.5, 0.1), 0.05, 11);
    experiment.frames = 40;
    let mut track = experiment.track();
    track.0.remove(20);
    track.0.drain(28..31);
    for handed in [false, true] {
        let settings = Settings { handed, ..Settings::default() };
        let n = settings.library.terms.len() * if handed { 2 } else { 1 };
        let coefficients = (0..n).map(|i| 0.3 * libm::sin(i as f64 + 1.0)).collect();
        let at = Parameters { coefficients, s: 1.3, eta_v: 0.08, eta_shape: 0.06 };
        let value = |at: &Parameters| likelihood(&[track.clone()], &settings, at).unwrap();
        let exact = value(&at);
        for i in 0..n + 3 {
            let moved = |by: f64| {
                let mut at = at.clone();
                match i.checked_sub(n) {
                    None => at.coefficients[i] += by,
                    Some(0) => at.s *= libm::exp(by),
                    Some(1) => at.eta_v *= libm::exp(by),
                    Some(_) => at.eta_shape *= libm::exp(by),
                }
                value(&at).value.unwrap()
            };
            let h = 1e-4;
            let slope = |h: f64| (moved(h) - moved(-h)) / (2.0 * h);
            let difference = (4.0 * slope(h) - slope(2.0 * h)) / 3.0;
            let size = exact.information[i][i].sqrt();
            assert!((difference - exact.gradient[i]).abs() < 1e-6 * size, "{handed} {i}: {difference} {exact:?}");
        }
    }
}
