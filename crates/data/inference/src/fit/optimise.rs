//! First steps: Fisher scoring with the damping of Levenberg and Marquardt, covariances taken as fixed.

use crate::filter::{Evaluation, NO_CENTRE_NOISE, NOISES, Problem, Theta, Want, evaluate};
use motiform_dynamics::Watch;
use nalgebra::{Cholesky, DVector};
use serde::{Deserialize, Serialize};

/// Bounds of `ln s`, `ln eta_v` and `ln eta_shape` in natural units, and of the logarithm of the centre's own noise.
const BOUNDS: [[f64; 2]; NOISES] = [[-4.6, 4.6], [-9.2, 2.3], [-9.2, 2.3], [NO_CENTRE_NOISE, 20.0]];
/// Standard deviation of a prior about 0 for coefficients in natural units, where they are of order 1. Without it a search runs away along
/// combinations that the motion does not fix; a combination with a standard error of 0.4 is moved by 0.2 %.
pub(crate) const PRIOR: f64 = 10.0;
/// Largest step of a logarithm.
const LONGEST_LOG_STEP: f64 = 1.2;

/// Damping from which on first steps are given up: their derivatives are not exact, and the last ones go on from there.
const GIVEN_UP: f64 = 1e2;

/// Share of the slope at the end of a step, downwards, from which on it went too far.
const OVERSHOT: f64 = 0.3;

/// The ending of the search for the maximum.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", tag = "ending")]
pub enum Ending {
    /// At a maximum.
    Converged {
        /// Evaluations with exact derivatives.
        evaluations: usize,
    },
    /// Before.
    Stopped {
        /// The reason.
        reason: String,
    },
}

/// A point of the search.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    pub(crate) theta: Theta,
    pub(crate) evaluation: Evaluation,
    pub(crate) ending: Ending,
}

/// The damped step and its predicted gain; parameters that push against a bound stay.
fn step(at: &Evaluation, held: &[bool], damping: f64) -> Option<(Vec<f64>, f64)> {
    let (mut information, mut gradient) = (at.information.clone(), at.gradient.clone());
    let n = gradient.len();
    for i in 0..n {
        information[(i, i)] += damping * (information[(i, i)] + 1e-3) + 1e-9;
        if held[i] {
            gradient[i] = 0.0;
            information.row_mut(i).fill(0.0);
            information.column_mut(i).fill(0.0);
            information[(i, i)] = 1.0;
        }
    }
    let step: DVector<f64> = Cholesky::new(information)?.solve(&gradient);
    let gain = 0.5 * step.dot(&gradient);
    Some((step.iter().copied().collect(), gain))
}

pub(super) fn held(theta: &Theta, gradient: &DVector<f64>) -> Vec<bool> {
    let n = theta.coefficients.len();
    let mut held = vec![false; n + NOISES];
    for i in 0..NOISES {
        let (value, push) = (theta.logs[i], gradient[n + i]);
        held[n + i] = (value <= BOUNDS[i][0] && push < 0.0) || (value >= BOUNDS[i][1] && push > 0.0);
    }
    held
}

/// The noise parameters at a bound.
pub(crate) fn at_bounds(theta: &Theta) -> [bool; NOISES] {
    std::array::from_fn(|i| theta.logs[i] <= BOUNDS[i][0] || theta.logs[i] >= BOUNDS[i][1])
}

/// `theta` after a step whose logarithms are limited.
pub(super) fn moved(theta: &Theta, mut step: Vec<f64>) -> Theta {
    let n = theta.coefficients.len();
    for log in &mut step[n..] {
        *log = log.clamp(-LONGEST_LOG_STEP, LONGEST_LOG_STEP);
    }
    let mut next = theta.stepped(&step);
    for (log, [low, high]) in next.logs.iter_mut().zip(BOUNDS) {
        *log = log.clamp(low, high);
    }
    next
}

/// The log-likelihood with the prior; scores of frames are without it.
pub(super) fn objective(problem: &Problem, theta: &Theta, want: Want) -> Evaluation {
    let mut found = evaluate(problem, theta, want, want == Want::Exact);
    found.value -= prior(theta);
    for (i, c) in theta.coefficients.iter().enumerate() {
        found.gradient[i] -= c / (PRIOR * PRIOR);
        found.information[(i, i)] += 1.0 / (PRIOR * PRIOR);
    }
    found
}

/// Minus the logarithm of the prior.
pub(super) fn prior(theta: &Theta) -> f64 {
    0.5 * theta.coefficients.iter().map(|c| c * c).sum::<f64>() / (PRIOR * PRIOR)
}

/// The point after a step. Where the slope along the step has turned round (the expected information is less
/// than the curvature), the point where the slope between is 0 is tried too: without it steps go to and fro.
fn advance(
    problem: &Problem,
    want: Want,
    theta: &Theta,
    evaluation: &Evaluation,
    step: &[f64],
) -> (Theta, Evaluation) {
    let next = moved(theta, step.to_vec());
    let trial = objective(problem, &next, want);
    let slope = |at: &Evaluation| at.gradient.iter().zip(step).map(|(g, d)| g * d).sum::<f64>();
    let (before, after) = (slope(evaluation), slope(&trial));
    if trial.value.is_finite() && after < -OVERSHOT * before {
        let part = before / (before - after);
        let between = moved(theta, step.iter().map(|d| part * d).collect());
        let other = objective(problem, &between, want);
        if other.value > trial.value {
            return (between, other);
        }
    }
    (next, trial)
}

/// Goes uphill from `theta` for at most `most` evaluations, until a step promises less than `enough`.
pub(crate) fn climb(problem: &Problem, theta: &Theta, enough: f64, most: usize, watch: &dyn Watch) -> Point {
    let want = Want::Rough;
    let mut evaluation = objective(problem, theta, want);
    let (mut theta, mut damping, mut evaluations) = (theta.clone(), 1e-3, 1);
    let mut ending = Ending::Stopped { reason: "after first steps".to_owned() };
    while evaluation.value.is_finite() && evaluations < most && damping < GIVEN_UP && !watch.stopped() {
        let held = held(&theta, &evaluation.gradient);
        let Some((step, gain)) = step(&evaluation, &held, damping) else { break };
        if gain < enough {
            ending = Ending::Converged { evaluations };
            break;
        }
        let (next, trial) = advance(problem, want, &theta, &evaluation, &step);
        evaluations += 1;
        if trial.value > evaluation.value {
            (theta, evaluation) = (next, trial);
            damping = (0.1 * damping).max(1e-9);
        } else {
            damping = (10.0 * damping).max(1e-3);
        }
    }
    Point { theta, evaluation, ending }
}

/// First steps from a start.
pub(crate) fn roughly(problem: &Problem, theta: &Theta, watch: &dyn Watch) -> Point {
    climb(problem, theta, 1.0, 24, watch)
}
