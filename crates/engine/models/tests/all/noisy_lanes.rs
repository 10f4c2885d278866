//! Members under noise against single orbits: the same rows to the bit, on every instruction set.

use motiform_dynamics::ensemble::{
    NoisyMember, NoisyQueue, NoisySpan, NoisyTrack, WithPosition, propagate_noisy_on,
};
use motiform_dynamics::simd::InstructionSet;
use motiform_dynamics::steppers::DOP853;
use motiform_dynamics::{
    InPlane, Noise, NoiseSteps, NoisyOrbit, Normal, Orbit, Request, StepControl, Trajectory, drive::drive,
};
use motiform_models::tensor::TensorParameters;
use motiform_models::tensor::fourier::{Coefficients, DIM, FourierField, terms};

type Field = FourierField<f64, { terms::ALL }>;

const STATE: usize = DIM + 2;
const START: [f64; STATE] = [0.5, 0.1, 0.1, -0.2, 0.05, 0.1, 3.0, -2.0];
const SPAN: NoisySpan = NoisySpan {
    times: (0.0, 20.0),
    every: Some(0.37),
    rtol: 1e-9,
    atol: 1e-12,
    escape_norm: 1e6,
    max_steps: 1_000_000,
};

fn field(member: usize) -> Field {
    FourierField(Coefficients::from(&TensorParameters::full(0.45 + 0.01 * member as f64, 0.1)))
}

fn noise(member: usize) -> NoiseSteps {
    let noise =
        Noise { amplitudes: vec![0.1; DIM], rates: vec![0.0, 0.0, -0.5, -0.5, -0.1, -0.1], step: 0.0625 };
    NoiseSteps::new(&noise, Normal::new(7, member as u64), 0.0, STATE).expect("valid")
}

fn alone(member: usize) -> Vec<Vec<f64>> {
    let body = InPlane(field(member));
    let control = StepControl::Adaptive { rtol: SPAN.rtol, atol: SPAN.atol };
    let orbit = Orbit::new(&body, &DOP853, control, 0.0, &START).expect("valid");
    let mut rows = Trajectory::new(STATE);
    let request = Request { sample_every: SPAN.every, watched: DIM, ..Request::until(SPAN.times.1, STATE) };
    let ended = drive(&mut NoisyOrbit::of(orbit, noise(member)), &request, &mut rows).expect("valid");
    assert!(ended.is_complete());
    rows.iter().map(|(_, state)| state.to_vec()).collect()
}

#[test]
fn members_under_noise_have_the_rows_of_single_orbits() {
    let count = 21;
    let single: Vec<_> = (0..count).map(alone).collect();
    for set in InstructionSet::available() {
        let (mut left, mut found) = (0..count, vec![None; count]);
        let mut next = || {
            let key = left.next()?;
            Some(NoisyMember { key, field: field(key), start: START, noise: noise(key) })
        };
        let mut done = |key: usize, track: Option<NoisyTrack<STATE>>| {
            let rows = track.expect("nothing escapes").rows;
            found[key] = Some(rows.iter().map(|row| row.to_vec()).collect::<Vec<_>>());
        };
        let queue = NoisyQueue { next: &mut next, done: &mut done, watch: &() };
        propagate_noisy_on::<_, WithPosition, STATE>(set, &SPAN, queue);
        let found: Vec<_> = found.into_iter().map(|rows| rows.expect("every member is told of")).collect();
        assert_eq!(found, single, "{set:?}");
    }
}
