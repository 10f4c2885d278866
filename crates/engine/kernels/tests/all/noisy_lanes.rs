//! Bodies of the tensor model under noise.

use crate::single::sets;
use motiform_dynamics::drive::drive;
use motiform_dynamics::ensemble::NoisySpan;
use motiform_dynamics::simd::InstructionSet;
use motiform_dynamics::steppers::DOP853;
use motiform_dynamics::{
    InPlane, Model, Noise, NoiseSteps, NoisyOrbit, Normal, Orbit, Request, StepControl, Trajectory,
};
use motiform_kernels::{Kernel, NoisyStart, NoisyStates, Stretch, propagate_noisy_bodies};
use motiform_models::tensor::{Tensor, TensorParameters};

const START: [f64; 8] = [0.5, 0.1, 0.1, -0.2, 0.05, 0.1, 3.0, -2.0];
const DIM: usize = 6;

fn span() -> NoisySpan {
    NoisySpan {
        times: (0.0, 20.0),
        every: Some(0.37),
        rtol: 1e-9,
        atol: 1e-12,
        escape_norm: 1e6,
        max_steps: 1_000_000,
        set: InstructionSet::widest(),
    }
}

fn body(member: usize) -> Tensor {
    Tensor::new(&TensorParameters::full(0.45 + 0.01 * member as f64, 0.1))
}

fn noise(member: usize) -> NoiseSteps {
    let noise =
        Noise { amplitudes: vec![0.1; DIM], rates: vec![0.0, 0.0, -0.5, -0.5, -0.1, -0.1], step: 0.0625 };
    NoiseSteps::new(&noise, Normal::new(7, member as u64), 0.0, START.len()).unwrap()
}

fn alone(member: usize) -> Vec<Vec<f64>> {
    let (model, span) = (body(member), span());
    let plane = InPlane(&model as &dyn Model);
    let control = StepControl::Adaptive { rtol: span.rtol, atol: span.atol };
    let orbit = Orbit::new(&plane, &DOP853, control, 0.0, &START).unwrap();
    let mut rows = Trajectory::new(START.len());
    let request =
        Request { sample_every: span.every, watched: DIM, ..Request::until(span.times.1, START.len()) };
    let ended = drive(&mut NoisyOrbit::of(orbit, noise(member)), &request, &mut rows).unwrap();
    assert!(ended.is_complete());
    rows.iter().map(|(_, state)| state.to_vec()).collect()
}

#[test]
fn members_under_noise_have_the_rows_of_single_orbits() {
    let bodies: Vec<Tensor> = (0..21).map(body).collect();
    let single: Vec<_> = (0..bodies.len()).map(alone).collect();
    for set in sets() {
        let (mut left, mut found) = (bodies.iter().enumerate(), vec![None; bodies.len()]);
        let mut next = || {
            let (key, body) = left.next()?;
            Some(NoisyStart { key, body, state: START.to_vec(), noise: noise(key) })
        };
        let mut done = |key: usize, states: Option<NoisyStates<'_>>| {
            let rows = states.expect("nothing escapes").rows;
            found[key] = Some(rows.iter().map(|row| row.to_vec()).collect::<Vec<_>>());
        };
        let (kernel, span) = (Kernel::Tensor, NoisySpan { set, ..span() });
        assert!(propagate_noisy_bodies(kernel, Stretch::Plane, &span, &mut next, &mut done, &()));
        let found: Vec<_> = found.into_iter().map(|rows| rows.expect("every member is told of")).collect();
        assert_eq!(found, single, "{set:?}");
    }
}
