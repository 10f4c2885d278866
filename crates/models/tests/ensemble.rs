//! Members of an ensemble against single orbits: the same ends to the bit, on every instruction set and thread count.

use motiform_dynamics::ensemble::{End, Member, Propagation, propagate};
use motiform_dynamics::simd::InstructionSet;
use motiform_dynamics::steppers::{DOP853, RK4, Tableau};
use motiform_dynamics::{Orbit, Outcome, Request, StepControl, drive::drive};
use motiform_models::tensor::TensorParameters;
use motiform_models::tensor::fourier::{Coefficients, DIM, FourierField, terms};

type Field = FourierField<f64, { terms::PAPER }>;

const ESCAPE: f64 = 1e6;

/// Members of the full model (paper, Simulations II) with unequal time spans, so that lanes change hands.
fn members(
    kappa2: impl Fn(usize) -> f64,
    span: impl Fn(usize) -> f64,
    count: usize,
) -> Vec<Member<Field, DIM>> {
    let start = [0.5, 0.1, 0.1, -0.2, 0.05, 0.1];
    let member = |i: usize| {
        let parameters = TensorParameters::full(kappa2(i), 0.1);
        let start = std::array::from_fn(|j| start[j] * (1.0 + 0.1 * (0.7 * i as f64 + 1.3 * j as f64).sin()));
        Member { field: FourierField(Coefficients::from(&parameters)), start, t_end: span(i) }
    };
    (0..count).map(member).collect()
}

fn mixed(count: usize) -> Vec<Member<Field, DIM>> {
    members(|i| 0.45 + 0.2 * i as f64 / count as f64, |i| 3.0 + 11.7 * (i % 5) as f64, count)
}

fn how(method: &'static Tableau, control: StepControl) -> Propagation {
    Propagation { method, control, instructions: InstructionSet::widest(), escape_norm: ESCAPE, threads: 1 }
}

fn adaptive(method: &'static Tableau, rtol: f64) -> Propagation {
    how(method, StepControl::Adaptive { rtol, atol: 1e-2 * rtol })
}

/// The end of a member as a single orbit.
fn alone(member: &Member<Field, DIM>, how: &Propagation) -> End<DIM> {
    let mut orbit = Orbit::new(&member.field, how.method, how.control, 0.0, &member.start).expect("valid");
    let request = Request { escape_norm: how.escape_norm, ..Request::until(member.t_end, DIM) };
    let outcome = drive(&mut orbit, &request, &mut ()).expect("valid");
    let u = std::array::from_fn(|i| orbit.state()[i]);
    End { outcome, u, steps: orbit.counters().steps, rejected: orbit.counters().rejected }
}

fn bits(ends: &[End<DIM>]) -> Vec<[u64; DIM]> {
    ends.iter().map(|end| end.u.map(f64::to_bits)).collect()
}

/// Every way to run the members gives the ends of the single orbits.
fn check(members: &[Member<Field, DIM>], how: &Propagation) {
    let single: Vec<_> = members.iter().map(|member| alone(member, how)).collect();
    for instructions in InstructionSet::available() {
        for threads in [1, 2] {
            let ends = propagate(members, &Propagation { instructions, threads, ..*how }).expect("valid");
            let name = how.method.name;
            assert_eq!(bits(&ends), bits(&single), "{name} {instructions:?}, {threads} threads");
            assert_eq!(ends, single, "{name} {instructions:?}, {threads} threads");
        }
    }
}

#[test]
fn adaptive_members_end_where_single_orbits_end() {
    for rtol in [1e-6, 1e-9, 1e-12] {
        check(&mixed(37), &adaptive(&DOP853, rtol));
    }
}

/// Spans that are no multiple of the step, and some that are.
#[test]
fn fixed_steps_end_where_single_orbits_end() {
    for method in [&RK4, &DOP853] {
        for step in [0.01, 0.05, 0.037] {
            check(&mixed(37), &how(method, StepControl::Fixed { step }));
        }
    }
}

/// Members that leave every bound do so among others that do not.
#[test]
fn blow_up_is_the_same_in_company() {
    let some = members(|i| 0.1 + 0.01 * i as f64, |i| 100.0 + 50.0 * (i % 3) as f64, 30);
    let how = adaptive(&DOP853, 1e-9);
    let ends: Vec<_> = some.iter().map(|member| alone(member, &how)).collect();
    let arrived = ends.iter().filter(|end| matches!(end.outcome, Outcome::Completed { .. })).count();
    assert!(arrived < ends.len(), "no member of this set escapes");
    check(&some, &how);
    check(&some, &how_fixed());
}

fn how_fixed() -> Propagation {
    how(&RK4, StepControl::Fixed { step: 0.02 })
}
