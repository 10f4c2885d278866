//! All exponents of many orbits of one body in lanes: those of single orbits, to the last bit.

use crate::amplitude_lanes::three;
use motiform_analysis::lyapunov::LyapunovSettings;
use motiform_analysis::{Lyapunov, lyapunov};
use motiform_dynamics::simd::has_lanes;
use motiform_dynamics::steppers::{DOP853, Method};
use motiform_dynamics::{Model, StepControl};
use motiform_kernels::{exponents_of_body, has_exponents};
use motiform_models::tensor::{Tensor, TensorParameters};

const STARTS: usize = 10;

/// Which start leaves its bounds.
const LARGE: usize = 3;

fn start(number: usize, dim: usize) -> Vec<f64> {
    let size = if number == LARGE { 10.0 } else { 0.3 };
    (0..dim).map(|i| size * (1.0 + number as f64 * 0.7 + i as f64 * 1.3).sin()).collect()
}

fn settings(body: &dyn Model) -> LyapunovSettings {
    LyapunovSettings {
        count: body.dim(),
        method: Method::Explicit(&DOP853),
        control: StepControl::Adaptive { rtol: 1e-9, atol: 1e-12 },
        transient: 20.0,
        span: 150.0,
        escape_norm: 5.0,
        max_steps: 1_000_000,
    }
}

fn together(body: &(dyn Model + 'static), settings: &LyapunovSettings) -> Vec<Lyapunov> {
    assert_eq!(has_exponents(body, settings), has_lanes());
    let mut left = 0..STARTS;
    let mut next = || left.next().map(|number| (number, start(number, body.dim())));
    let mut runs = vec![None; STARTS];
    let mut done = |number: usize, run: motiform_analysis::Result<Lyapunov>| {
        assert!(runs[number].replace(run.unwrap()).is_none());
    };
    exponents_of_body(body, settings, &mut next, &mut done, &());
    runs.into_iter().map(Option::unwrap).collect()
}

/// The runs of a body, which are those of single orbits.
fn checked(body: &(dyn Model + 'static)) -> Vec<Lyapunov> {
    let settings = settings(body);
    let alone = |number| lyapunov(body, &start(number, body.dim()), &settings, &()).unwrap();
    let single: Vec<Lyapunov> = (0..STARTS).map(alone).collect();
    if has_lanes() {
        assert_eq!(format!("{:?}", together(body, &settings)), format!("{single:?}"));
    }
    single
}

#[test]
fn exponents_in_lanes_have_the_bits_of_single_runs() {
    let tensor =
        |kappa2: f64| -> Box<dyn Model> { Box::new(Tensor::new(&TensorParameters::full(kappa2, 0.1))) };
    // chaos and a zigzag of the full model, and a text
    for body in [tensor(0.5), tensor(0.95), three().build(&[0.5, -0.3, 0.2]).unwrap()] {
        for (number, run) in checked(body.as_ref()).iter().enumerate() {
            assert_eq!(run.exponents.is_empty(), number == LARGE, "{number}: {run:?}");
        }
    }
}

/// z3 relaxes so fast that its directions are lost within the first stretches.
#[test]
fn directions_that_are_lost_in_lanes_are_replaced_as_in_a_single_run() {
    let kappa3 = 84.0;
    let runs = checked(&Tensor::new(&TensorParameters::full(0.55, kappa3)));
    let kept: Vec<_> = runs.iter().filter(|run| !run.exponents.is_empty()).collect();
    assert_eq!(kept.len(), STARTS - 1);
    for run in kept {
        // two exponents of z3, at which it relaxes without the rest of the shape
        assert!(
            run.exponents.iter().rev().take(2).all(|x| (x.value / -kappa3 - 1.0).abs() < 0.05),
            "{run:?}"
        );
    }
}
