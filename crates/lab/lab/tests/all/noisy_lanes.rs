//! Bodies under noise in lanes: the rows of single runs, to the bit.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{column, run};
use motiform_dynamics::Outcome;
use motiform_lab::ensemble::Track;
use motiform_lab::noisy::{has_noisy_lanes, noisy_tracks};
use motiform_study::{RunPlan, Study};

/// Additive and multiplicative noise on three modes of a handed body.
const TEXT: &str = "[model.amplitudes]\nmodes = [1, 2, 3]\n[model.amplitudes.equations]\n\
    z1 = \"(1 + 0.1*i - |z1|^2)*z1 + 2*conj(z1)*z2\"\nz2 = \"-0.9*z2 - 0.125*z1^2 + 0.3*conj(z1)*z3\"\n\
    z3 = \"-0.1*z3 + 0.0125*z1^3 + 0.4*z1*z2\"\n[model.amplitudes.noise]\nz1 = \"0.2*z1\"\nz2 = \"0.05\"\n\
    [run]\nt_end = 30\ntransient = 7\ndt_out = 0.13";

/// The tensor model: rows between the steps of the noise.
const TENSOR: &str = "[model.tensor]\ngamma = 1\nkappa2 = 0.9\nkappa3 = 0.1\na1 = -1\nb1 = -0.5\nb2 = 0.3\nd1 = 0.1\nd2 = 0.8\n\
    [run]\nt_end = 20\ntransient = 5\ndt_out = 0.01\nnoise = 0.05\nnoise_velocity = 0.2";

fn plans(text: &str, count: u64, change: impl Fn(&mut Study)) -> Vec<(Study, RunPlan)> {
    let plan = |seed| {
        let mut study = Study::parse(text, "text", "text").unwrap();
        study.run.seed = seed;
        change(&mut study);
        (study.clone(), RunPlan::new(&study).unwrap())
    };
    (1..=count).map(plan).collect()
}

/// All bodies against single runs; how they ended.
fn check(text: &str, count: u64, change: impl Fn(&mut Study)) -> Vec<Track> {
    let (studies, plans): (Vec<_>, Vec<_>) = plans(text, count, change).into_iter().unzip();
    let one = noisy_tracks(&plans, 1, &()).unwrap().unwrap();
    assert_eq!(one, noisy_tracks(&plans, 3, &()).unwrap().unwrap());
    for (study, track) in studies.iter().zip(&one) {
        let dataset = run(study);
        assert_eq!(dataset.manifest.outcome.outcome, track.outcome);
        let names = dataset.manifest.state.0.iter().map(|(name, _)| name.as_str()).chain(["x", "y"]);
        for (place, name) in names.enumerate() {
            let rows: Vec<f64> = track.states.iter().map(|state| state[place]).collect();
            assert_eq!(column(&dataset, name), rows, "{name}");
        }
    }
    one
}

fn lanes() -> bool {
    motiform_dynamics::simd::has_lanes()
}

#[test]
fn the_tensor_model_has_the_rows_of_single_runs() {
    assert_eq!(has_noisy_lanes(&plans(TENSOR, 1, |_| {})[0].1).unwrap(), lanes());
    let found = check(TENSOR, 19, |_| {});
    assert!(found.iter().all(|track| track.states.len() == 2001));
    check(TENSOR, 9, |study| (study.run.transient, study.run.dt_out) = (0.0, 0.5));
    check(TENSOR, 9, |study| study.run.rtol = 1e-12); // several steps of the flow in one of the noise
}

#[test]
fn equations_with_noise_of_both_kinds_have_them_too() {
    assert_eq!(has_noisy_lanes(&plans(TEXT, 1, |_| {})[0].1).unwrap(), lanes());
    check(TEXT, 19, |_| {});
}

#[test]
fn bodies_that_escape_or_use_up_their_steps_do_so_among_others() {
    let ended = check(TENSOR, 17, |study| study.run.escape_norm = Some(1.2));
    let escaped = |track: &&Track| matches!(track.outcome, Outcome::Escaped { .. });
    let count = ended.iter().filter(escaped).count();
    assert!((2..=16).contains(&count), "{count}");
    let short = check(TENSOR, 9, |study| study.run.max_steps = 200);
    assert!(short.iter().all(|track| matches!(track.outcome, Outcome::StepBudget { .. })));
    check(TENSOR, 9, |study| study.run.max_steps = 50); // in the transient
}

#[test]
fn what_has_no_lanes_runs_alone_and_a_stop_leaves_nothing() {
    let fixed = |study: &mut Study| {
        (study.run.stepper, study.run.step) = ("rk4".into(), Some(0.01));
    };
    assert!(!has_noisy_lanes(&plans(TENSOR, 1, fixed)[0].1).unwrap());
    check(TENSOR, 3, fixed);
    let plans: Vec<_> = plans(TENSOR, 3, |_| {}).into_iter().map(|(_, plan)| plan).collect();
    let stopped = std::sync::atomic::AtomicBool::new(true);
    assert_eq!(noisy_tracks(&plans, 1, &stopped).unwrap(), None);
    assert_eq!(noisy_tracks(&[], 1, &()).unwrap(), Some(vec![]));
}
