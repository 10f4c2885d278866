//! Tracks of an ensemble against single runs, to the bit.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{preset, run};
use motiform_dynamics::Outcome;
use motiform_lab::ensemble::{Member, random_members, tracks};
use motiform_study::{Random, RunPlan, Study};

const TIMES: [f64; 3] = [0.0, 1.5, 12.0];

/// The last state of a single run from a member's start.
fn alone(study: &Study, member: &Member) -> Vec<f64> {
    let mut study = study.clone();
    (study.run.transient, study.run.t_end) = (0.0, TIMES[2]);
    let info = study.info().unwrap();
    for (spec, value) in info.parameters().iter().zip(&member.parameters) {
        study.set(spec.name, *value).unwrap();
    }
    let coordinates = info.build(&member.parameters).unwrap().coordinates().to_vec();
    let names = coordinates.iter().map(|coordinate| coordinate.name).chain(["x", "y"]);
    for (name, value) in names.zip(&member.start) {
        study.set_initial(name, *value).unwrap();
    }
    let manifest = run(&study).manifest;
    manifest.state.values().into_iter().chain(manifest.position).collect()
}

fn check(name: &str, change: impl FnOnce(&mut Study), count: usize, tolerance: f64) {
    let study = preset(name, change);
    let plan = RunPlan::new(&study).unwrap();
    let mut members = random_members(&plan, count, Random::Within(0.3)).unwrap();
    for (place, member) in members.iter_mut().enumerate() {
        member.parameters[1] *= 1.0 + 0.001 * place as f64;
    }
    let one = tracks(&plan, &members, &TIMES, 1, &()).unwrap().unwrap();
    assert_eq!(tracks(&plan, &members, &TIMES, 3, &()).unwrap().unwrap(), one);
    for (track, member) in one.iter().zip(&members) {
        assert_eq!(track.outcome, Outcome::Completed { t: TIMES[2] });
        assert_eq!(track.states.len(), TIMES.len());
        let off = track.states[2].iter().zip(alone(&study, member)).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) <= tolerance, "{name}");
    }
}

/// Single runs do not stop on the way, so steps differ at the times in between: within the tolerance, and not at all with fixed steps
/// that meet these times.
#[test]
fn tracks_end_where_single_runs_end() {
    check("fig5a", |_| {}, 19, 1e-6);
    let fixed = |study: &mut Study| {
        study.run.stepper = "rk4".into();
        study.run.step = Some(0.0625);
    };
    check("fig5a", fixed, 5, 0.0);
    // more than the paper's terms: by the list of products
    check("fig5a", |study| study.set("a5", 0.01).unwrap(), 5, 1e-6);
    check("fig6b", |_| {}, 3, 1e-4);
}

/// With a term beyond those of the paper a body has another kernel. A track does not depend on what the other members are.
#[test]
fn members_with_other_terms_have_their_own_tracks() {
    let plan = RunPlan::new(&preset("fig5a", |_| {})).unwrap();
    let mut members = random_members(&plan, 7, Random::Within(0.3)).unwrap();
    let place = plan.info().unwrap().parameters().iter().position(|spec| spec.name == "a5").unwrap();
    for member in members.iter_mut().skip(2) {
        member.parameters[place] = 0.01;
    }
    let all = tracks(&plan, &members, &TIMES, 1, &()).unwrap().unwrap();
    for (member, track) in members.iter().zip(&all) {
        let one = tracks(&plan, std::slice::from_ref(member), &TIMES, 1, &()).unwrap().unwrap();
        assert_eq!(&one[0], track);
    }
    assert_ne!(all[1].states, all[2].states);
}

#[test]
fn input_that_makes_no_sense_is_refused() {
    let plan = RunPlan::new(&preset("fig5a", |_| {})).unwrap();
    let members = random_members(&plan, 2, Random::Within(0.3)).unwrap();
    for times in [&[1.0, 1.0][..], &[-1.0], &[f64::NAN]] {
        assert!(tracks(&plan, &members, times, 1, &()).unwrap_err().to_string().contains("increasing"));
    }
    let short = [Member { start: vec![0.0; 3], ..members[0].clone() }];
    assert!(tracks(&plan, &short, &TIMES, 1, &()).is_err());
    let stopped = std::sync::atomic::AtomicBool::new(true);
    assert_eq!(tracks(&plan, &members, &TIMES, 1, &stopped).unwrap(), None);
}
