//! The largest exponents of many orbits in lanes, as the classification of the cells of a plane asks for them: those of single orbits, to
//! the last bit. All exponents in lanes: `kernels/tests/all/exponent_lanes.rs`.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_analysis::lyapunov::{LyapunovSettings, TangentMember, lyapunov_in_lanes};
use motiform_analysis::{Lyapunov, lyapunov};
use motiform_dynamics::simd::has_lanes;
use motiform_dynamics::steppers::{DOP853, Method};
use motiform_dynamics::{Equivariant, StepControl, Tolerance};
use motiform_models::tensor::fourier::{FourierField, terms};
use motiform_models::tensor::{Tensor, TensorParameters};

struct Body(Tensor);

impl AsRef<dyn Equivariant> for Body {
    fn as_ref(&self) -> &(dyn Equivariant + 'static) {
        &self.0
    }
}

const TOLERANCE: Tolerance = Tolerance { rtol: 1e-9, atol: 1e-12 };

/// The full model, from chaos to straight motion; the first ones escape, if they are given the time.
fn tensor(member: usize) -> Tensor {
    Tensor::new(&TensorParameters::full(0.15 + 0.1 * member as f64, 0.1))
}

const MEMBERS: usize = 19;

fn start(member: usize) -> [f64; 6] {
    std::array::from_fn(|i| 0.3 * (1.0 + member as f64 * 0.7 + i as f64 * 1.3).sin())
}

fn settings(member: usize) -> LyapunovSettings {
    LyapunovSettings {
        count: 1,
        method: Method::Explicit(&DOP853),
        control: StepControl::Adaptive { rtol: TOLERANCE.rtol, atol: TOLERANCE.atol },
        transient: 20.0 + 7.0 * member as f64, // lanes are refilled at different times
        span: 150.0,
        escape_norm: if member == 3 { 0.5 } else { 1e6 }, // one leaves its bounds
        max_steps: 1_000_000,
    }
}

fn together() -> Vec<Lyapunov> {
    let mut left = 0..MEMBERS;
    let mut next = || {
        let member = left.next()?;
        let body = tensor(member);
        let field = FourierField::<f64, { terms::PAPER }>(body.field().0);
        Some(TangentMember {
            key: member,
            body: Body(body),
            field,
            start: start(member),
            settings: settings(member),
        })
    };
    let mut runs = vec![None; MEMBERS];
    let mut done =
        |member: usize, run: motiform_analysis::Result<Lyapunov>| runs[member] = Some(run.unwrap());
    lyapunov_in_lanes::<_, _, 6, 1, 12>(TOLERANCE, &mut next, &mut done, &());
    runs.into_iter().map(Option::unwrap).collect()
}

#[test]
fn one_exponent_in_lanes_has_the_bits_of_a_single_run() {
    if !has_lanes() {
        return; // single orbits are what such a machine runs
    }
    for (member, run) in together().iter().enumerate() {
        let alone = lyapunov(&tensor(member), &start(member), &settings(member), &()).unwrap();
        assert_eq!(format!("{run:?}"), format!("{alone:?}"), "member {member}");
    }
}
