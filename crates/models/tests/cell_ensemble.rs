//! Cells in lanes: the ends are those of single orbits, for every instruction set and number of threads.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use motiform_dynamics::drive::drive;
use motiform_dynamics::ensemble::{StiffEnd, StiffMember, StiffPropagation, propagate_stiff};
use motiform_dynamics::simd::InstructionSet;
use motiform_dynamics::steppers::{ETDRK4, EXPONENTIAL_STEPPERS};
use motiform_dynamics::{ExponentialOrbit, Integration as _, Outcome, Request, StepControl};
use motiform_models::cell::{CellField, CellParameters};

const BOUND: f64 = 1e3;

fn how(instructions: InstructionSet) -> StiffPropagation {
    StiffPropagation { method: &ETDRK4, step: 0.02, instructions, escape_norm: BOUND, threads: 1 }
}

/// Cells of lengths 19 to 23 with their own starts and spans, some with the variational term.
fn members(count: usize, modes: usize, span: impl Fn(usize) -> f64) -> Vec<StiffMember<CellField<f64>>> {
    let member = |i: usize| {
        let g4 = if i % 3 == 1 { 0.3 } else { 0.0 };
        let length = 19.0 + 4.0 * (i as f64 * 0.37).fract();
        let size = 1.0 + 0.1 * (i as f64).sin();
        let start =
            (0..2 * modes).map(|j| 0.1 * size * (1.0 + 3.0 * j as f64).cos() * (-((j / 2) as f64)).exp2());
        let field = CellField::new(&CellParameters { length, g4, ..CellParameters::default() }, modes);
        StiffMember { field, start: start.collect(), t_end: span(i) }
    };
    (0..count).map(member).collect()
}

fn alone(member: &StiffMember<CellField<f64>>, how: &StiffPropagation) -> StiffEnd {
    let control = StepControl::Fixed { step: how.step };
    let mut orbit = ExponentialOrbit::new(&member.field, how.method, control, 0.0, &member.start).unwrap();
    let request =
        Request { escape_norm: how.escape_norm, ..Request::until(member.t_end, member.start.len()) };
    let outcome = drive(&mut orbit, &request, &mut ()).unwrap();
    StiffEnd { outcome, u: orbit.state().to_vec(), steps: orbit.counters().steps }
}

fn bits(ends: &[StiffEnd]) -> Vec<Vec<u64>> {
    ends.iter().map(|end| end.u.iter().map(|x| x.to_bits()).collect()).collect()
}

/// More members than lanes, spans that are no multiples of the step, one of them empty.
#[test]
fn lanes_compute_the_bits_of_single_orbits() {
    for method in EXPONENTIAL_STEPPERS {
        for modes in [17, 18, 19, 20] {
            let members = members(37, modes, |i| 0.31 * (i % 7) as f64 + 0.013 * i as f64);
            let how = |set| StiffPropagation { method, ..how(set) };
            let single: Vec<_> = members.iter().map(|m| alone(m, &how(InstructionSet::Portable))).collect();
            for set in InstructionSet::available() {
                for threads in [1, 2] {
                    let ends = propagate_stiff(&members, &StiffPropagation { threads, ..how(set) }).unwrap();
                    assert_eq!(bits(&ends), bits(&single), "{} {modes} {set:?} {threads}", method.name);
                    assert_eq!(ends, single);
                }
            }
        }
    }
}

/// One huge start, and one whose first step is not finite, among others that arrive.
#[test]
fn an_escaped_member_ends_as_a_single_orbit_does() {
    let mut members = members(24, 20, |_| 1.0);
    for (i, size) in [(3, 1e5), (11, 1e200)] {
        members[i].start.iter_mut().for_each(|x| *x *= size);
    }
    for set in InstructionSet::available() {
        let how = how(set);
        let ends = propagate_stiff(&members, &how).unwrap();
        for (i, (end, member)) in ends.iter().zip(&members).enumerate() {
            let single = alone(member, &how);
            assert_eq!(
                matches!(end.outcome, Outcome::Completed { .. }),
                i != 3 && i != 11,
                "{i} {}",
                end.outcome
            );
            assert_eq!(format!("{end:?}"), format!("{single:?}"));
        }
    }
}

#[test]
fn members_that_do_not_fit_are_refused() {
    let how = how(InstructionSet::widest());
    assert_eq!(propagate_stiff::<CellField<f64>>(&[], &how), Ok(vec![]));
    let mixed: Vec<_> = members(1, 20, |_| 1.0).into_iter().chain(members(1, 21, |_| 1.0)).collect();
    assert!(propagate_stiff(&mixed, &how).is_err());
    assert!(propagate_stiff(&mixed[..1], &StiffPropagation { step: 0.0, ..how }).is_err());
}
