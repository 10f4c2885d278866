//! The thresholds of the classifier from both sides: fields made so that a number lies just inside or just outside.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{ORDINARY, named};
use motiform_analysis::{Attractor, Settings, Verdict};
use motiform_dynamics::{Equivariant, Scalar, StepControl, VectorField};
use motiform_models::plain;
use motiform_models::zoo::{Hopf, Torus};
use std::f64::consts::TAU;

/// A stable focus at (1, 0), rate -0.2, inside a small stable cycle of radius `cycle`: with `s = r^2/(r^2 + cycle^2)`,
/// `r' = -0.2 r (1 - 5 s)(1 - 2 s)`, turning at rate 1. Between the two an unstable cycle at half the radius.
struct Whirl {
    cycle: f64,
}

impl<T: Scalar> VectorField<T> for Whirl {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let one = u[0].constant(1.0);
        let (p, q) = (u[0] - one, u[1]);
        let square = p * p + q * q;
        let s = square / (square + u[0].constant(self.cycle * self.cycle));
        let rate = (one - s * 5.0) * (one - s * 2.0) * -0.2;
        du[0] = rate * p - q;
        du[1] = rate * q + p;
    }
}
plain!(Whirl, 2);

/// A cycle of period 2 pi (a [`Hopf`] oscillator) and `w' = growth w (1 - w^2)`: the multiplier of the cycle at w = 0 is
/// `exp(2 pi growth)`, and orbits that begin at w = 0 stay there.
struct Ledge {
    growth: f64,
}

impl<T: Scalar> VectorField<T> for Ledge {
    fn eval(&self, t: T::Real, u: &[T], du: &mut [T]) {
        Hopf { mu: 1.0, omega: 1.0 }.eval(t, &u[..2], &mut du[..2]);
        du[2] = u[2] * (u[0].constant(1.0) - u[2] * u[2]) * self.growth;
    }
}
plain!(Ledge, 3);

/// A fold of cycles: `r' = -r ((r^2 - 1/2)^2 + gap)`, turning at rate 1.15. Without a gap the two cycles are one, with one there is
/// none; with a negative one the outer cycle has the exponent `-4 r^2 sqrt(-gap)`.
struct Fold {
    gap: f64,
}

impl<T: Scalar> VectorField<T> for Fold {
    fn eval(&self, _t: T::Real, u: &[T], du: &mut [T]) {
        let square = u[0] * u[0] + u[1] * u[1] - u[0].constant(0.5);
        let rate = -(square * square + u[0].constant(self.gap));
        du[0] = rate * u[0] - u[1] * 1.15;
        du[1] = rate * u[1] + u[0] * 1.15;
    }
}
plain!(Fold, 2);

/// Three independent limit cycles: returns to a section fill a surface.
struct ThreeTorus;

impl<T: Scalar> VectorField<T> for ThreeTorus {
    fn eval(&self, t: T::Real, u: &[T], du: &mut [T]) {
        for (j, omega) in [1.0, 0.5 * (1.0 + 5.0_f64.sqrt()), 0.3 * 7.0_f64.sqrt()].into_iter().enumerate() {
            let pair = 2 * j..2 * j + 2;
            Hopf { mu: 1.0, omega }.eval(t, &u[pair.clone()], &mut du[pair]);
        }
    }
}
plain!(ThreeTorus, 6);

fn verdict(body: &impl Equivariant, start: &[f64]) -> Verdict {
    let verdict = named(body, start, &ORDINARY);
    println!("{:?} {:?} t {:.0}: {}", verdict.attractor, verdict.margin, verdict.time, verdict.why);
    verdict
}

/// An orbit as near to a stable equilibrium as one that arrives, but on a cycle around it, is not called at rest: it must
/// also come closer at the rate that the eigenvalues say.
#[test]
fn to_be_near_a_stable_equilibrium_is_not_to_approach_it() {
    for cycle in [2e-4, 5e-4, 9e-4] {
        let seen = verdict(&Whirl { cycle }, &[2.0, 0.0]);
        assert_ne!(seen.attractor, Attractor::Equilibrium, "{cycle}: {}", seen.why);
    }
    // from inside the unstable cycle the same field does approach it
    let seen = verdict(&Whirl { cycle: 0.5 }, &[1.2, 0.0]);
    assert_eq!(seen.attractor, Attractor::Equilibrium, "{}", seen.why);
}

/// Beyond 1e-3 of the size (here 2) no equilibrium is thought of: the cycle is found.
#[test]
fn a_cycle_around_an_equilibrium_is_found_where_it_is_not_close() {
    for cycle in [4e-3, 0.01, 0.03, 0.1] {
        let seen = verdict(&Whirl { cycle }, &[2.0, 0.0]);
        assert_eq!(seen.attractor, Attractor::Periodic, "{cycle}: {}", seen.why);
        common::near(seen.period.unwrap(), TAU, 1e-6);
    }
}

/// A periodic orbit is what a motion ends on if its largest multiplier is below 1, however little; above it is none, and
/// an orbit that stays on it is not chaotic either.
#[test]
fn a_periodic_orbit_is_stable_below_the_multiplier_one_and_not_above() {
    for multiplier in [0.3_f64, 0.9, 0.99] {
        let seen = verdict(&Ledge { growth: multiplier.ln() / TAU }, &[0.7, 0.1, 0.0]);
        assert_eq!(seen.attractor, Attractor::Periodic, "{multiplier}: {}", seen.why);
    }
    for multiplier in [1.01_f64, 1.1, 1.4, 3.0] {
        let seen = verdict(&Ledge { growth: multiplier.ln() / TAU }, &[0.7, 0.1, 0.0]);
        let confident = seen.margin.is_some_and(|margin| margin >= 3.0);
        let stable = seen.attractor == Attractor::Periodic && !seen.why.contains("unstable");
        assert!(!(stable || confident && seen.attractor == Attractor::Chaotic), "{multiplier}: {}", seen.why);
        // beside the ledge the same field ends on a stable cycle, at w = 1
        let seen = verdict(&Ledge { growth: multiplier.ln() / TAU }, &[0.7, 0.1, 1e-3]);
        assert_eq!(seen.attractor, Attractor::Periodic, "{multiplier}: {}", seen.why);
    }
}

/// Returns on a curve are a torus; returns on a surface, as orderly, are not called one.
#[test]
fn a_torus_has_returns_on_a_curve() {
    let seen = verdict(&Torus::default(), &[0.5, -0.1, 0.8, 0.1]);
    assert_eq!(seen.attractor, Attractor::Torus, "{}", seen.why);
    let seen = verdict(&ThreeTorus, &[0.5, -0.1, 0.8, 0.1, 0.3, 0.6]);
    assert_eq!(seen.attractor, Attractor::Unknown, "{}", seen.why);
}

/// Beyond a fold of cycles orbits all but close, with residuals below every tolerance: there is no stable cycle, however small the gap.
/// Before it there is one, with its exact exponent. Both at every tolerance, and from starts in any direction.
#[test]
fn beyond_a_fold_there_is_no_cycle() {
    for (rtol, angle) in [(1e-9, 0.0), (1e-9, 2.1), (1e-7, 0.7), (1e-11, 4.0)] {
        let control = StepControl::Adaptive { rtol, atol: 1e-3 * rtol };
        let settings = Settings { control, ..ORDINARY };
        let seen = |gap| named(&Fold { gap }, &[f64::cos(angle), f64::sin(angle)], &settings);
        for gap in [1e-9, 1e-10, 1e-11, 0.0] {
            let seen = seen(gap);
            assert_ne!(seen.attractor, Attractor::Periodic, "{gap} {rtol}: {}", seen.why);
        }
        for gap in [-1e-4, -1e-6] {
            let seen = seen(gap);
            assert_eq!(seen.attractor, Attractor::Periodic, "{gap} {rtol}: {}", seen.why);
            let exact = -4.0 * (0.5 + (-gap).sqrt()) * (-gap).sqrt();
            let found = seen.exponents[1];
            assert!((found.value - exact).abs() <= found.error.max(1e-9), "{gap} {rtol}: {found:?} {exact}");
        }
    }
}
