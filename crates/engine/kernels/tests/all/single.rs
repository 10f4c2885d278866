//! Single orbits, and what runs them together.

use motiform_dynamics::drive::drive;
use motiform_dynamics::ensemble::Propagation;
use motiform_dynamics::simd::InstructionSet;
use motiform_dynamics::steppers::{DOP853, Method};
use motiform_dynamics::{InPlane, Model, Outcome, Request, StepControl};
use motiform_kernels::{Kernel, Start, propagate_bodies};

/// The states of an orbit at all times; `None` if it did not arrive.
pub(crate) type States = Option<Vec<Vec<f64>>>;

/// A body and its state at the start: shape and position.
pub(crate) type Body = (Box<dyn Model>, Vec<f64>);

/// The instructions that lanes are compiled for.
pub(crate) fn sets() -> impl Iterator<Item = InstructionSet> {
    InstructionSet::available().into_iter().filter(|set| *set > InstructionSet::Portable)
}

pub(crate) fn how(times: &[f64], rtol: f64) -> Propagation<'_> {
    Propagation { times, rtol, atol: 1e-2 * rtol, escape_norm: 1e6, set: InstructionSet::widest() }
}

/// A single orbit, driven from time to time.
fn alone((model, start): &Body, how: &Propagation<'_>) -> States {
    let (body, dim) = (InPlane(model.as_ref()), start.len());
    let control = StepControl::Adaptive { rtol: how.rtol, atol: how.atol };
    let mut orbit = Method::Explicit(&DOP853).orbit(&body, control, 0.0, start).unwrap();
    let mut states = Vec::new();
    for &t in how.times {
        if t > 0.0 {
            let request =
                Request { escape_norm: how.escape_norm, watched: dim - 2, ..Request::until(t, dim) };
            let outcome = drive(orbit.as_mut(), &request, &mut ()).unwrap();
            if !matches!(outcome, Outcome::Completed { .. }) {
                return None;
            }
        }
        states.push(orbit.state().to_vec());
    }
    Some(states)
}

/// The states of all bodies in lanes.
fn together(bodies: &[Body], how: &Propagation<'_>) -> Vec<States> {
    let kernel = Kernel::of_all(bodies.iter().map(|body| body.0.as_ref())).unwrap();
    let mut left = bodies.iter().enumerate();
    let mut next =
        || left.next().map(|(key, (body, state))| Start { key, body: body.as_ref(), state: state.clone() });
    let mut found: Vec<Option<States>> = vec![None; bodies.len()];
    let mut done = |key: usize, states: Option<Vec<&[f64]>>| {
        let states = states.map(|states| states.iter().map(|state| state.to_vec()).collect());
        assert!(found[key].replace(states).is_none());
    };
    assert!(propagate_bodies(kernel, how, &mut next, &mut done, &()));
    found.into_iter().map(|states| states.expect("every member is told of")).collect()
}

/// The states of single orbits, which are those in lanes.
pub(crate) fn checked(bodies: &[Body], how: &Propagation<'_>) -> Vec<States> {
    let single: Vec<_> = bodies.iter().map(|body| alone(body, how)).collect();
    for set in sets() {
        let found = together(bodies, &Propagation { set, ..*how });
        assert_eq!(format!("{found:?}"), format!("{single:?}"), "{set:?}");
    }
    single
}
