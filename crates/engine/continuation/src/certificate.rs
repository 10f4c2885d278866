//! The evidence for a special point.

use super::normal_form::NormalForm;
use serde::{Deserialize, Serialize};

/// The function that vanishes at a special point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum TestFunction {
    /// `dp/ds`, the derivative of the parameter by the length along the branch.
    Slope,
    /// The growth of a deviation: the real part of an eigenvalue (per model time), or the logarithm of the modulus of a multiplier.
    Growth,
}

/// The evidence for a special point: the test function that changes its sign there, how close to 0 it was brought, and how fast it passes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// The function that vanishes.
    pub test: TestFunction,
    /// Its value at the point.
    pub residual: f64,
    /// Its derivative by the length along the branch (in the units of [`super::Settings`]), from a solution nearby: where it is not 0 the
    /// test function passes 0 transversally, and the point is of the generic kind.
    pub transversality: f64,
    /// Bound of the error of the parameter: from the residual, from the errors of the test function and of Newton's method.
    pub error: f64,
    /// The same for the time of an orbit ([`motiform_analysis::PeriodicOrbit::time`]); 0 for steady motions.
    #[serde(default)]
    pub time_error: f64,
    /// The leading coefficient of the normal form, where the point is one at which it says what begins. (That of a Hopf bifurcation is in
    /// [`super::Hopf`].)
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normal_form: Option<NormalForm>,
}

/// Values at a place along a branch: of a test function, and the slope `dp/ds`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Passing {
    /// Length along the branch.
    pub(super) s: f64,
    /// The test function.
    pub(super) value: f64,
    /// `dp/ds`.
    pub(super) slope: f64,
}

impl Certificate {
    /// The certificate of the point `at`, from the solution `beside` it. The test function has the error `noise`, the parameter of each
    /// solution the error `solved`; a time changes by `time` with the length along the branch.
    pub(super) fn of(
        test: TestFunction,
        (at, time): (Passing, f64),
        beside: Passing,
        noise: f64,
        solved: f64,
    ) -> Self {
        let by = |change: f64| change / (beside.s - at.s);
        let (transversality, bend) = (by(beside.value - at.value), by(beside.slope - at.slope));
        let off = (at.value.abs() + noise) / transversality.abs();
        let error = off * (at.slope.abs() + 0.5 * bend.abs() * off) + solved;
        let time_error = off * time.abs();
        Self { test, residual: at.value, transversality, error, time_error, normal_form: None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_at_a_fold_is_of_second_order() {
        // p = s^2, found at s = 1e-6
        let passing = |s: f64| Passing { s, value: 2.0 * s, slope: 2.0 * s };
        let found = Certificate::of(TestFunction::Slope, (passing(1e-6), 2.0), passing(1e-3), 0.0, 0.0);
        assert!((found.transversality - 2.0).abs() < 1e-9);
        assert!(found.error >= 1e-12 && found.error < 4e-12, "{found:?}");
        assert!((found.time_error - 2e-6).abs() < 1e-9, "{found:?}");
    }

    #[test]
    fn the_error_of_a_growth_is_its_distance() {
        // growth 3 (s - 1), p = 5 s, found at s = 1.001
        let passing = |s: f64| Passing { s, value: 3.0 * (s - 1.0), slope: 5.0 };
        let found = Certificate::of(TestFunction::Growth, (passing(1.001), 0.0), passing(1.1), 0.0, 1e-9);
        assert!((found.error - 5e-3).abs() < 1e-6, "{found:?}");
    }
}
