//! Members of an ensemble against single orbits: the same states to the bit, on every instruction set.

use motiform_dynamics::ensemble::{Member, Propagation, Queue, propagate, propagate_on};
use motiform_dynamics::simd::{InstructionSet, has_lanes};
use motiform_dynamics::steppers::DOP853;
use motiform_dynamics::{InPlane, Orbit, Outcome, Request, StepControl, Watch, drive::drive};
use motiform_models::tensor::TensorParameters;
use motiform_models::tensor::fourier::{Coefficients, DIM, FourierField, terms};
use std::sync::atomic::{AtomicUsize, Ordering};

type Field = FourierField<f64, { terms::PAPER }>;

/// Shape and position.
const STATE: usize = DIM + 2;

type States = Option<Vec<[f64; STATE]>>;

/// Members of the full model (paper, Simulations II).
fn members(kappa2: impl Fn(usize) -> f64, count: usize) -> Vec<Member<Field, STATE>> {
    let start = [0.5, 0.1, 0.1, -0.2, 0.05, 0.1, 3.0, -2.0];
    let member = |i: usize| {
        let parameters = TensorParameters::full(kappa2(i), 0.1);
        let start = std::array::from_fn(|j| start[j] * (1.0 + 0.1 * (0.7 * i as f64 + 1.3 * j as f64).sin()));
        Member { key: i, field: FourierField(Coefficients::from(&parameters)), start }
    };
    (0..count).map(member).collect()
}

fn how(times: &[f64], rtol: f64) -> Propagation<'_> {
    Propagation { times, rtol, atol: 1e-2 * rtol, escape_norm: 1e6 }
}

/// A member as a single orbit, driven from time to time.
fn alone(member: &Member<Field, STATE>, how: &Propagation<'_>) -> States {
    let body = InPlane(member.field);
    let control = StepControl::Adaptive { rtol: how.rtol, atol: how.atol };
    let mut orbit = Orbit::new(&body, &DOP853, control, 0.0, &member.start).expect("valid");
    let mut states = Vec::new();
    for &t in how.times {
        if t > 0.0 {
            let request = Request { escape_norm: how.escape_norm, watched: DIM, ..Request::until(t, STATE) };
            let outcome = drive(&mut orbit, &request, &mut ()).expect("valid");
            if !matches!(outcome, Outcome::Completed { .. }) {
                return None;
            }
        }
        states.push(std::array::from_fn(|i| motiform_dynamics::Integration::state(&orbit)[i]));
    }
    Some(states)
}

/// All members at once, on some instructions.
fn together(members: &[Member<Field, STATE>], how: &Propagation<'_>, set: InstructionSet) -> Vec<States> {
    let mut left = members.iter().copied();
    let mut found: Vec<Option<States>> = vec![None; members.len()];
    let mut done = |key: usize, states: States| assert!(found[key].replace(states).is_none());
    let queue = Queue { next: &mut || left.next(), done: &mut done, watch: &() };
    propagate_on(set, how, queue);
    found.into_iter().map(|states| states.expect("every member is told of")).collect()
}

fn check(members: &[Member<Field, STATE>], how: &Propagation<'_>) -> Vec<States> {
    let single: Vec<_> = members.iter().map(|member| alone(member, how)).collect();
    for set in InstructionSet::available() {
        assert_eq!(format!("{:?}", together(members, how, set)), format!("{single:?}"), "{set:?}");
    }
    single
}

#[test]
fn members_pass_where_single_orbits_pass() {
    let some = members(|i| 0.45 + 0.2 * i as f64 / 37.0, 37);
    for rtol in [1e-6, 1e-9, 1e-12] {
        let states = check(&some, &how(&[0.0, 0.25, 3.0, 3.5, 41.7], rtol));
        assert!(states.iter().all(Option::is_some));
    }
    check(&some, &how(&[0.0], 1e-9));
}

/// Members that leave every bound do so among others that do not.
#[test]
fn blow_up_is_the_same_in_company() {
    let states = check(&members(|i| 0.1 + 0.01 * i as f64, 30), &how(&[50.0, 200.0], 1e-9));
    let arrived = states.iter().flatten().count();
    assert!(0 < arrived && arrived < states.len(), "{arrived} of {} arrive", states.len());
}

#[test]
fn a_stop_leaves_what_is_under_way() {
    let (some, how) = (members(|_| 0.5, 40), how(&[1e4], 1e-9));
    let mut left = some.iter().copied();
    let (mut told, watch) = (0, AfterAsked(AtomicUsize::new(0)));
    let queue = Queue { next: &mut || left.next(), done: &mut |_, _| told += 1, watch: &watch };
    assert_eq!(propagate(&how, queue), has_lanes());
    assert_eq!(told, 0);
}

/// Stops what has asked it twenty times.
struct AfterAsked(AtomicUsize);

impl Watch for AfterAsked {
    fn stopped(&self) -> bool {
        self.0.fetch_add(1, Ordering::Relaxed) >= 20
    }
}
