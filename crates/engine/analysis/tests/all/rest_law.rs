//! The law of noisy rests: what the paper calls random is decided by noise, and how long by its logarithm.

#![allow(clippy::unwrap_used, reason = "a test may fail")]

use crate::common;

use motiform_analysis::{Ends, Estimate, PathSample, legs, rests, series_mean};
use motiform_dynamics::steppers::RK4;
use motiform_dynamics::{
    InPlane, Noise, NoisyOrbit, Normal, Orbit, Request, Shape, StepControl, Trajectory, drive::drive,
};

/// kappa2 and gamma of `reference/tensor.toml`.
fn place() -> (f64, f64) {
    let all: toml::Table = include_str!("../../../../../reference/tensor.toml").parse().unwrap();
    let number = |key: &str| all["rectangular"][key].as_float().unwrap();
    (number("kappa2"), number("gamma"))
}

/// Rests per amplitude: 25 000 time units hold 160 to 360 of them, which give the slope to 1.4 %.
const TIME: f64 = 25_000.0;

struct Run {
    mean: Estimate,
    left: f64,
    turns: f64,
    /// Largest deviation of a turn from a right angle (rad).
    askew: f64,
}

fn run(amplitude: f64, stream: u64) -> Run {
    let model = common::reduced(place().0, place().1);
    let body = InPlane(model.clone());
    let start = [0.01, 0.0, 0.005, 0.0015, 0.0, 0.0, 0.0, 0.0];
    let orbit = Orbit::new(&body, &RK4, StepControl::Fixed { step: 0.2 }, 0.0, &start).unwrap();
    let noise = Noise::on(&model, amplitude, amplitude, 0.2);
    let mut noisy = NoisyOrbit::new(orbit, noise, Normal::new(2010, stream)).unwrap();
    let mut trajectory = Trajectory::new(8);
    let request = Request { sample_every: Some(0.2), watched: 6, ..Request::until(TIME, 8) };
    assert!(drive(&mut noisy, &request, &mut trajectory).unwrap().is_complete());
    let sample = |(t, u): (f64, &[f64])| {
        let [vx, vy] = Shape::<f64>::velocity(&model, &u[..6]);
        PathSample { t, x: u[6], y: u[7], vx, vy }
    };
    let path: Vec<PathSample> = trajectory.iter().filter(|(t, _)| *t > 500.0).map(sample).collect();
    let speeds: Vec<f64> = path.iter().map(|s| s.vx.hypot(s.vy)).collect();
    let times: Vec<f64> = path.iter().map(|s| s.t).collect();
    let found = rests(&times, &speeds, 0.1).unwrap().rests;
    let mean = series_mean(&found.iter().map(|rest| rest.duration).collect::<Vec<f64>>()).unwrap();
    let turns = legs(&path, Ends::Open).unwrap().heading_turns;
    let askew = turns.iter().map(|turn| (turn.abs() - std::f64::consts::FRAC_PI_2).abs()).fold(0.0, f64::max);
    let left = turns.iter().filter(|turn| **turn > 0.0).count() as f64;
    Run { mean, left, turns: turns.len() as f64, askew }
}

/// Mean rest = -ln(eta)/lambda_+ + const, lambda_+ = gamma + 2 a1 r2, r2^2 = -kappa2/(8 b3); both turns equally likely.
///
/// Source: Stone and Holmes (1990), SIAM J. Appl. Math. 50, 726.
#[test]
fn mean_rests_grow_with_the_logarithm_of_the_noise_and_turns_have_no_side() {
    let (kappa2, gamma) = place();
    let growth = gamma + 2.0 * (-kappa2 / 8.0).sqrt();
    let amplitudes = [1e-4, 1e-6, 1e-8, 1e-10_f64];
    let runs: Vec<Run> = amplitudes.iter().zip(0..).map(|(&eta, stream)| run(eta, stream)).collect();
    // the straight line of least squares, each point with its own error
    let (mut weights, mut sx, mut sy, mut sxx, mut sxy) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (eta, run) in amplitudes.iter().zip(&runs) {
        println!(
            "{eta:.0e}: {:?}, {} of {} to the left, askew {:.1e}",
            run.mean, run.left, run.turns, run.askew
        );
        let (x, y, weight) = (eta.ln(), run.mean.value, run.mean.error.powi(-2));
        weights += weight;
        sx += weight * x;
        sy += weight * y;
        sxx += weight * x * x;
        sxy += weight * x * y;
    }
    let spread = sxx - sx * sx / weights;
    let slope = Estimate { value: (sxy - sx * sy / weights) / spread, error: spread.sqrt().recip() };
    println!("slope {slope:?}, expected {}", -1.0 / growth);
    assert!(slope.covers(-1.0 / growth), "{slope:?} is not {}", -1.0 / growth);
    assert!(slope.error < 0.02 / growth, "the test can tell 2 % from nothing");
    for run in &runs {
        // a fair coin: four standard errors
        assert!((run.left / run.turns - 0.5).abs() < 2.0 / run.turns.sqrt(), "{} of {}", run.left, run.turns);
    }
    // right angles, but for what the noise adds to the velocity on the way
    assert!(runs[3].askew < 1e-3, "{}", runs[3].askew);
}
