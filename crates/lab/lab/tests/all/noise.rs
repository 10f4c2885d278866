//! Noise in a study: seeded, felt, and refused where only the flow without it has an answer.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use common::{column, preset, run};
use motiform_lab::analyse;
use motiform_models::ModelInfo;
use motiform_store::table::same_bits;
use motiform_study::{RunPlan, Study};

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
    let plan = RunPlan::new(&rectangular(1e-4, 1)).unwrap();
    let refused = analyse::classify(&plan, 0.0, &()).unwrap_err().to_string();
    assert!(refused.contains("noise = 0.0001") && refused.contains("set it to 0"), "{refused}");
    let negative = RunPlan::new(&rectangular(-1.0, 1)).unwrap_err().to_string();
    assert!(negative.contains("noise = -1"), "{negative}");
}

/// A study of a model with these parameters and this noise, recorded from its start.
fn noisy(model: &str, parameters: &[(&str, f64)], noise: f64, (t_end, dt_out): (f64, f64)) -> Study {
    let mut study = Study::of_model(ModelInfo::find(model).unwrap());
    parameters.iter().for_each(|(name, value)| study.set(name, *value).unwrap());
    study.random = Some(0.0.into()); // at rest: what moves is the noise
    (study.run.noise, study.run.seed) = (noise, 3);
    (study.run.t_end, study.run.dt_out) = (t_end, dt_out);
    study
}

fn mean_square(values: &[f64]) -> f64 {
    values.iter().map(|x| x * x).sum::<f64>() / values.len() as f64
}

/// A cell too short to move: every mode is an Ornstein-Uhlenbeck process of its own, with variance eta^2/(2 |sigma_n|), and the
/// body creeps at speeds of order eta^2. (Once its rows lay mid-step after a kick: speed 3.4e8.)
#[test]
fn modes_of_a_resting_cell_have_their_stationary_variances() {
    let eta = 1e-4;
    // rows on the steps of the noise (2^-4) and between them
    for dt_out in [0.25, 0.1] {
        let dataset = run(&noisy("cell", &[("length", 5.0)], eta, (400.0, dt_out)));
        assert!(dataset.manifest.outcome.is_complete());
        let settled = (10.0 / dt_out) as usize;
        let k = std::f64::consts::TAU / 5.0;
        for n in 1..=12_i32 {
            let square = (k * f64::from(n)).powi(2);
            let sigma = square * square * (1.0 - square);
            let [c, s] = ["c", "s"].map(|kind| &column(&dataset, &format!("{kind}{n}"))[settled..]);
            let variance = 0.5 * (mean_square(c) + mean_square(s)) / (eta * eta / (2.0 * sigma.abs()));
            // mode 1: two series of 390 time units, squares correlated over 1/(2 |sigma|) = 0.34: 1100 independent ones, 4.2 %;
            // the others: at least 1560 rows each, 2.5 %; four of them
            assert!((variance - 1.0).abs() < if n == 1 { 0.17 } else { 0.1 }, "{dt_out} {n} {variance}");
        }
        let fastest = column(&dataset, "speed").iter().copied().fold(0.0, f64::max);
        assert!(fastest < 1e-6 && fastest > 1e-11, "{fastest}");
        // the velocity is read off rough modes: once a turning rate of 1e8 was shown
        assert!(column(&dataset, "turning_rate").iter().all(|rate| rate.is_nan()));
        for name in ["x", "y"] {
            let furthest = column(&dataset, name).iter().map(|x| x.abs()).fold(0.0, f64::max);
            assert!(furthest < 1e-5, "{furthest}");
        }
    }
}

/// With weak noise at L = 13.2 the cell rests and moves on as without it. (Once the noise of stiff modes was taken for motion: the
/// median speed was 1.8e-4.) A rest ends when deviations of some 1e-6 have grown: the slowest twentieth is near 8e-8.
#[test]
fn a_cell_under_weak_noise_still_rests() {
    let speeds = |noise: f64| {
        let mut study = noisy("cell", &[("length", 13.2)], noise, (1000.0, 0.7));
        (study.random, study.run.transient) = (None, 1000.0);
        let dataset = run(&study);
        let mut speeds = column(&dataset, "speed").to_vec();
        speeds.sort_by(f64::total_cmp);
        [speeds[speeds.len() / 20], speeds[speeds.len() - 1]]
    };
    let (noisy, quiet) = (speeds(1e-7), speeds(0.0));
    assert!(noisy[0] < 1e-6, "{noisy:?} {quiet:?}");
    assert!((noisy[1] / quiet[1] - 1.0).abs() < 0.1, "{noisy:?} {quiet:?}");
}

/// Each block of the tensor model at rest: eta^2/(2 rate), kappa3 = 20 included, where 45 % of the variance was lost once.
#[test]
fn blocks_of_a_resting_tensor_body_have_their_stationary_variances() {
    let parameters = [("gamma", -1.0), ("kappa2", 2.0), ("kappa3", 20.0)];
    let mut study = noisy("tensor", &parameters, 1e-3, (4000.0, 0.5));
    study.run.noise_velocity = Some(2e-3);
    let dataset = run(&study);
    for (names, eta, rate) in
        [(["v1", "v2"], 2e-3_f64, 1.0), (["s11", "s12"], 1e-3, 2.0), (["u111", "u222"], 1e-3, 20.0)]
    {
        for name in names {
            let variance = mean_square(column(&dataset, name)) / (eta * eta / (2.0 * rate));
            // 8000 rows, squares correlated over 1/(2 rate) <= one row: at least 4000 independent ones, 2.2 %; four of them
            assert!((variance - 1.0).abs() < 0.09, "{name} {variance}");
        }
    }
}

/// The path depends on seed and model, not on the rows that are asked for.
#[test]
fn the_path_does_not_depend_on_the_rows() {
    for (model, parameters) in [
        ("tensor", &[("gamma", 0.1), ("kappa2", -0.1), ("a1", 1.0), ("b1", 0.5)][..]),
        ("cell", &[("length", 13.2)]),
    ] {
        let rows = |dt_out: f64| run(&noisy(model, parameters, 1e-2, (60.0, dt_out)));
        let (rare, dense) = (rows(0.3), rows(0.1));
        // the turning rate is a difference between rows
        for column in rare.trajectory.columns.iter().filter(|column| column.name != "turning_rate") {
            let all = &dense.trajectory.get(&column.name).unwrap();
            let largest = column.values.iter().map(|x| x.abs()).fold(0.0, f64::max);
            for (row, value) in column.values.iter().enumerate().filter(|(_, value)| value.is_finite()) {
                let off = (all[3 * row] - value).abs();
                assert!(off <= 1e-9 * largest + 1e-14, "{model} {} row {row}: {off}", column.name);
            }
        }
        assert!(column(&rare, "speed").iter().any(|speed| *speed > 1e-6));
    }
}

/// Noise that is far below every digit gives the motion without it, where no instability makes it grow.
#[test]
fn vanishing_noise_leaves_the_motion_alone() {
    for (model, name) in [("tensor", "fig5a"), ("cell", "fig6c")] {
        let rows = |noise: f64| {
            let mut study = preset(name, |study| {
                (study.run.transient, study.run.t_end, study.run.dt_out) = (0.0, 40.0, 0.7);
                (study.run.noise, study.run.rtol) = (noise, 1e-9);
                (study.initial, study.random) = (Vec::new(), Some(0.3.into()));
            });
            study.run.seed = 4;
            run(&study)
        };
        let (quiet, noisy) = (rows(0.0), rows(1e-15));
        for name in ["x", "y", "speed"] {
            let size = column(&quiet, name).iter().map(|x| x.abs()).fold(0.0, f64::max);
            for (a, b) in column(&quiet, name).iter().zip(column(&noisy, name)) {
                // the cell's path is the trapezoidal rule under noise, h = 2^-5
                assert!((a - b).abs() < 1e-4 * size, "{model} {name}: {a} {b}");
            }
        }
    }
}

#[test]
fn the_plan_says_what_the_noise_is() {
    let settings = |study: &Study| RunPlan::new(study).unwrap().computation.noise.unwrap();
    let mut study = noisy("tensor", &[("gamma", 1.0)], 0.5, (10.0, 0.5));
    let both = settings(&study);
    assert_eq!((both.velocity, both.shape), (0.5, 0.5));
    study.run.dt_out = 2.0;
    assert_eq!(settings(&study).step, both.step, "the step is the dynamics' own");
    study.run.dt_out = 0.001;
    assert_eq!(settings(&study).step, 2.0_f64.powi(-10), "a step has one bridge, and so one sample");
    study.run.dt_out = 2.0;
    study.run.noise_velocity = Some(0.0);
    assert_eq!(settings(&study).velocity, 0.0);
    (study.run.noise, study.run.noise_velocity) = (0.0, Some(0.25));
    assert_eq!((settings(&study).velocity, settings(&study).shape), (0.25, 0.0));
    study.run.noise_velocity = Some(-1.0);
    let refused = RunPlan::new(&study).unwrap_err().to_string();
    assert!(refused.contains("noise_velocity = -1"), "{refused}");
    let mut cell = noisy("cell", &[], 0.5, (10.0, 0.5));
    assert_eq!((settings(&cell).velocity, settings(&cell).shape), (0.0, 0.5));
    cell.run.noise_velocity = Some(0.1);
    let refused = RunPlan::new(&cell).unwrap_err().to_string();
    assert!(refused.contains("noise_velocity = 0.1") && refused.contains("read off its shape"), "{refused}");
}

const IN_EQUATIONS: &str = r#"
[model.amplitudes]
modes = [1, 2]
[model.amplitudes.parameters]
D = 0.3
s = 0.2
[model.amplitudes.equations]
z1 = "(1 - |z1|^2)*z1"
z2 = "-2*z2"
[model.amplitudes.noise]
z1 = "s*z1"
z2 = "D"
[initial]
v1 = 1.0
[run]
t_end = 3000
dt_out = 0.3
"#;

/// Noise as a part of the equations: read and written, reproducible, with the variance `D^2/(2 kappa2)` of an Ornstein-Uhlenbeck process.
#[test]
fn noise_in_the_equations_is_that_of_the_run() {
    let study = Study::parse(IN_EQUATIONS, "text", "test").unwrap();
    let back = Study::parse(&study.to_toml().unwrap(), "text", "test").unwrap();
    assert_eq!(back, study);
    let plan = RunPlan::new(&study).unwrap();
    assert!(plan.computation.noise.is_some());
    let read: RunPlan = serde_json::from_str(&serde_json::to_string(&plan).unwrap()).unwrap();
    assert_eq!(read, plan);
    let table = |plan| motiform_lab::simulate::simulate(plan, &()).unwrap().trajectory;
    let (one, again) = (table(&plan), table(&plan));
    assert_eq!(one.get("z2_re").unwrap(), again.get("z2_re").unwrap());
    let z2 = one.get("z2_re").unwrap();
    let variance = z2.iter().map(|x| x * x).sum::<f64>() / z2.len() as f64;
    // 3000 time units with the correlation time 1/4 of squares: 2 % standard error
    assert!((variance / (0.3 * 0.3 / 4.0) - 1.0).abs() < 0.08, "{variance}");
    let speed: Vec<f64> =
        one.get("v1").unwrap().iter().zip(one.get("v2").unwrap()).map(|(a, b)| libm::hypot(*a, *b)).collect();
    let mean = speed.iter().sum::<f64>() / speed.len() as f64;
    let spread = speed.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / speed.len() as f64;
    // near speed 1: dv = -2 (v - 1) dt + s v dW
    assert!((spread / (0.2 * 0.2 / 4.0) - 1.0).abs() < 0.15, "{spread}");
    let silent = Study::parse(&IN_EQUATIONS.replace("0.3\ns = 0.2", "0.0\ns = 0.0"), "text", "test");
    assert!(RunPlan::new(&silent.unwrap()).unwrap().computation.noise.is_none());
}
