//! Exponents of many orbits in lanes: those of single orbits, to the last bit.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_analysis::lyapunov::{LyapunovSettings, TangentMember, lyapunov_in_lanes};
use motiform_analysis::{Lyapunov, lyapunov};
use motiform_dynamics::simd::has_lanes;
use motiform_dynamics::steppers::{DOP853, Method};
use motiform_dynamics::{Equivariant, StepControl};
use motiform_models::tensor::fourier::{FourierField, terms};
use motiform_models::tensor::{Tensor, TensorParameters};
use std::ops::Range;

struct Body(Tensor);

impl AsRef<dyn Equivariant> for Body {
    fn as_ref(&self) -> &(dyn Equivariant + 'static) {
        &self.0
    }
}

const TOLERANCES: (f64, f64) = (1e-9, 1e-12);

/// The full model, from chaos to straight motion; the first ones escape, if they are given the time. From the twentieth on, z3
/// relaxes so fast that its directions are lost within the first stretches.
fn tensor(member: usize) -> Tensor {
    let kappa3 = if member < FAST { 0.1 } else { 60.0 + member as f64 };
    Tensor::new(&TensorParameters::full(0.15 + 0.1 * (member % FAST) as f64, kappa3))
}

const FAST: usize = 20;

fn start(member: usize) -> [f64; 6] {
    std::array::from_fn(|i| 0.3 * (1.0 + member as f64 * 0.7 + i as f64 * 1.3).sin())
}

fn settings(member: usize, count: usize) -> LyapunovSettings {
    LyapunovSettings {
        count,
        method: Method::Explicit(&DOP853),
        control: StepControl::Adaptive { rtol: TOLERANCES.0, atol: TOLERANCES.1 },
        transient: 20.0 + 7.0 * (member % FAST) as f64, // lanes are refilled at different times
        span: 150.0,
        escape_norm: if member == 3 { 0.5 } else { 1e6 }, // one leaves its bounds
        max_steps: 1_000_000,
    }
}

fn together<const K: usize, const D: usize>(members: Range<usize>) -> Vec<Lyapunov> {
    let (first, mut left) = (members.start, members.clone());
    let mut next = || {
        let member = left.next()?;
        let body = tensor(member);
        let field = FourierField::<f64, { terms::PAPER }>(body.field().0);
        let settings = settings(member, K);
        Some(TangentMember { key: member, body: Body(body), field, start: start(member), settings })
    };
    let mut runs = vec![None; members.len()];
    let mut done = |number: usize, run: motiform_analysis::Result<Lyapunov>| {
        runs[number - first] = Some(run.unwrap());
    };
    lyapunov_in_lanes::<_, _, 6, K, D>(TOLERANCES, &mut next, &mut done, &());
    runs.into_iter().map(Option::unwrap).collect()
}

fn alone(member: usize, count: usize) -> Lyapunov {
    lyapunov(&tensor(member), &start(member), &settings(member, count), &()).unwrap()
}

#[test]
fn one_exponent_in_lanes_has_the_bits_of_a_single_run() {
    if !has_lanes() {
        return; // single orbits are what such a machine runs
    }
    for (member, run) in together::<1, 12>(0..19).iter().enumerate() {
        assert_eq!(format!("{run:?}"), format!("{:?}", alone(member, 1)), "member {member}");
    }
}

#[test]
fn six_exponents_in_lanes_have_the_bits_of_a_single_run() {
    if !has_lanes() {
        return; // single orbits are what such a machine runs
    }
    let runs = together::<6, 42>(0..10);
    for (member, run) in runs.iter().enumerate() {
        assert_eq!(format!("{run:?}"), format!("{:?}", alone(member, 6)), "member {member}");
    }
    assert!(!runs[3].outcome.is_complete() && runs[3].exponents.is_empty());
}

#[test]
fn directions_that_are_lost_in_lanes_are_replaced_as_in_a_single_run() {
    if !has_lanes() {
        return; // single orbits are what such a machine runs
    }
    for (member, run) in (FAST + 4..).zip(together::<6, 42>(FAST + 4..FAST + 9)) {
        assert_eq!(format!("{run:?}"), format!("{:?}", alone(member, 6)), "member {member}");
        // Two exponents of z3, at which it relaxes without the rest of the shape.
        let kappa3 = 60.0 + member as f64;
        assert!(
            run.exponents.iter().rev().take(2).all(|x| (x.value / -kappa3 - 1.0).abs() < 0.05),
            "{run:?}"
        );
    }
}
