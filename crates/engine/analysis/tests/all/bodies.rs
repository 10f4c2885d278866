//! Angles and rests of the paper's bodies: the zigzag of the full model, the rectangular motion of the reduced one.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

use motiform_analysis::{CornerKind, Ends, PathSample, legs, rests};
use motiform_dynamics::steppers::DOP853;
use motiform_dynamics::{
    InPlane, Integration, Model, Orbit, Request, Shape, StepControl, Trajectory, drive::drive,
};
use motiform_models::tensor::{Tensor, TensorParameters};
use std::f64::consts::FRAC_PI_2;

const CONTROL: StepControl = StepControl::Adaptive { rtol: 1e-11, atol: 1e-14 };

fn number(table: &str, key: &str) -> f64 {
    let all: toml::Table = include_str!("../../../../../reference/tensor.toml").parse().unwrap();
    all[table][key].as_float().unwrap()
}

/// The body's path from `from` on.
fn path(orbit: &mut dyn Integration, model: &Tensor, t_end: f64, every: f64, from: f64) -> Vec<PathSample> {
    let mut trajectory = Trajectory::new(8);
    let request = Request { sample_every: Some(every), watched: 6, ..Request::until(t_end, 8) };
    let outcome = drive(orbit, &request, &mut trajectory).unwrap();
    assert!(outcome.is_complete(), "{outcome}");
    let sample = |(t, u): (f64, &[f64])| {
        let [vx, vy] = Shape::<f64>::velocity(model, &u[..6]);
        PathSample { t, x: u[6], y: u[7], vx, vy }
    };
    trajectory.iter().filter(|(t, _)| *t >= from).map(sample).collect()
}

fn start(model: &Tensor, components: [f64; 6]) -> Vec<f64> {
    let mut u = vec![0.0; 8];
    model.encode(&components, &mut u[..6]);
    u
}

/// The heading swings by about 80 degrees; the legs of the path turn by 61, which is the paper's "about 60".
#[test]
fn the_zigzag_swings_by_eighty_degrees_and_its_legs_turn_by_less() {
    let p = TensorParameters::full(0.9, 0.1);
    let model = Tensor::new(&p);
    let body = InPlane(model.clone());
    let u = start(&model, [-0.5, 0.001, 0.0, 0.0, 0.0, 0.0]);
    let mut orbit = Orbit::new(&body, &DOP853, CONTROL, 0.0, &u).unwrap();
    let seen = legs(&path(&mut orbit, &model, 1400.0, 0.02, 1000.0), Ends::Open).unwrap();
    let degrees: Vec<f64> = seen.turns.iter().map(|turn| turn.to_degrees()).collect();
    println!("swing {}, {:?}, turns {degrees:?}", seen.swing.to_degrees(), seen.kind);
    assert!((seen.swing.to_degrees() - number("zigzag", "swing_degrees")).abs() < 5.0);
    assert!(
        seen.turns.windows(2).all(|pair| (pair[0] + pair[1]).abs() < 0.02),
        "to the left and the right alike"
    );
    assert!((degrees[0].abs() - number("zigzag", "turn_degrees")).abs() < 1e-2, "{degrees:?}");
    let period = seen.corners[2] - seen.corners[0];
    assert!((period - number("zigzag", "period")).abs() < 2.0, "{period}");
}

fn rectangular() -> TensorParameters {
    let (gamma, kappa2) = (number("rectangular", "gamma"), number("rectangular", "kappa2"));
    TensorParameters { gamma, kappa2, kappa3: 1.0, a1: 1.0, b1: 0.5, b3: 1.0, ..TensorParameters::default() }
}

#[test]
fn rectangular_motion_turns_by_right_angles_and_rests_longer_each_time() {
    let model = Tensor::new(&rectangular());
    let body = InPlane(model.clone());
    let u = start(&model, [0.3, 0.001, 0.1, 0.0, 0.0, 0.0]);
    let control = StepControl::Adaptive { rtol: 1e-12, atol: 1e-60 }; // small velocities matter
    let mut orbit = Orbit::new(&body, &DOP853, control, 0.0, &u).unwrap();
    let path = path(&mut orbit, &model, 1500.0, 0.1, 0.0);
    let seen = legs(&path, Ends::Open).unwrap();
    println!("{:?}: {:?}", seen.kind, seen.heading_turns);
    assert_eq!(seen.kind, Some(CornerKind::Stop));
    assert!(seen.heading_turns.len() >= 3);
    assert!(seen.heading_turns.iter().skip(1).all(|turn| (turn.abs() - FRAC_PI_2).abs() < 0.02));
    let speeds: Vec<f64> = path.iter().map(|s| s.vx.hypot(s.vy)).collect();
    let times: Vec<f64> = path.iter().map(|s| s.t).collect();
    let seen = rests(&times, &speeds, 0.1).unwrap();
    let growth = seen.growth();
    println!("{:?} {growth:?}", seen.ratios());
    // three rests after the start, before round-off ends their growth at about 210
    assert!((growth[1] - number("rectangular", "ratio")).abs() < 2e-3, "{growth:?}");
    assert!(seen.rests.iter().all(|rest| rest.duration < 230.0));
}
