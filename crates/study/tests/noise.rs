//! Noise in a study: seeded, felt, and refused where only the flow without it has an answer.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

mod common;

use common::{column, preset, run};
use motiform_study::table::same_bits;
use motiform_study::{Plan, Study, analyse};

fn rectangular(noise: f64, seed: u64) -> Study {
    preset("fig2", |study| {
        (study.run.noise, study.run.seed) = (noise, seed);
        (study.run.t_end, study.run.dt_out) = (4000.0, 0.5);
    })
}

/// Longest stretch below a hundredth of the top speed.
fn longest_rest(study: &Study) -> f64 {
    let dataset = run(study);
    let (times, speeds) = (column(&dataset, "t"), column(&dataset, "speed"));
    let top = speeds.iter().copied().fold(0.0, f64::max);
    let mut rests = vec![0.0];
    for (pair, speed) in times.windows(2).zip(speeds) {
        if *speed < 0.01 * top {
            *rests.last_mut().unwrap() += pair[1] - pair[0];
        } else {
            rests.push(0.0);
        }
    }
    rests.into_iter().fold(0.0, f64::max)
}

/// lambda_+ = 0.1836: noise of amplitude eta ends a rest after about ln(1/eta) / lambda_+, and a few 1/lambda_+ more.
#[test]
fn noise_ends_the_rests() {
    let quiet = longest_rest(&rectangular(0.0, 1));
    let strong = longest_rest(&rectangular(1e-3, 1));
    let weak = longest_rest(&rectangular(1e-6, 1));
    assert!(strong < 70.0 && weak < 110.0 && quiet > 150.0, "{strong} {weak} {quiet}");
    assert!(weak > strong + 20.0, "{strong} {weak}");
}

#[test]
fn the_same_seed_gives_the_same_bits() {
    let [a, b, c] = [1, 1, 2].map(|seed| run(&rectangular(1e-4, seed)));
    assert!(same_bits(&a.trajectory, &b.trajectory));
    assert!(!same_bits(&a.trajectory, &c.trajectory));
    assert_ne!(a.manifest.plan_hash, run(&rectangular(0.0, 1)).manifest.plan_hash);
}

#[test]
fn noise_is_refused_where_it_has_no_meaning() {
    let plan = Plan::new(&rectangular(1e-4, 1)).unwrap();
    let refused = analyse::classify(&plan, 0.0, &()).unwrap_err().to_string();
    assert!(refused.contains("noise = 0.0001") && refused.contains("set it to 0"), "{refused}");
    let negative = Plan::new(&rectangular(-1.0, 1)).unwrap_err().to_string();
    assert!(negative.contains("noise = -1"), "{negative}");
}
