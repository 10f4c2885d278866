//! To the maximum by exact gradients: a quadratic model within a trusted radius.
//!
//! The curvature is the expected information plus a correction `A` that is learned from the gradients on the
//! way: where the noise is not as the model has it (real cells), the expected information is not the
//! curvature, and steps made with it alone go to and fro. After a step `s` from the point 0 to the point 1
//! with gradients `g_0, g_1`,
//!
//! ```text
//! r = (g_0 - g_1) - I_1 s - A s,      A <- A + r r^T/(r . s)       (symmetric rank one)
//! ```
//!
//! Lengths of steps are those of the coefficients in natural units and of the logarithms of the noise, all of order 1.
//!
//! Source: Dennis, Gay and Welsch (1981), ACM Trans. Math. Softw. 7, 348 (a correction beside the expected
//! part); Nocedal and Wright (2006), Numerical Optimization, ch. 4 and 6.2 (radius, symmetric rank one).

use super::optimise::{Ending, Point, held, moved, objective};
use super::trust::Model;
use crate::filter::{Evaluation, NOISES, Problem, Theta, Want};
use motiform_dynamics::Watch;
use nalgebra::{DMatrix, DVector};

/// Predicted gain of log-likelihood below which a fit has converged: 0.02 standard errors.
const CONVERGED: f64 = 2e-4;
/// Most evaluations.
pub(crate) const MOST: usize = 200;
/// Most steps of the integration in all of them, for each frame: the first, between the two limits, or the second. Cells that follow
/// the equations need 2 to 100 for each frame and real ones up to 1700; equations that blow up between
/// frames, which have no maximum, take 16 times the steps of others.
const MOST_STEPS: [usize; 2] = [2_000, 1_000];
const LIMITS: (usize, usize) = (300_000, 1_000_000);
/// Most steps, for each frame but not below the least limit, in evaluations of equations that are too fast for the frames.
const MOST_TOO_FAST: (usize, usize) = (400, 50_000);
const TOO_FAST: &str = "the search leads to equations that are too fast for the interval between frames";
/// First radius and the largest one.
const RADII: [f64; 2] = [2.0, 8.0];
/// Radius below which no step can improve the likelihood beyond round-off.
const SMALLEST: f64 = 1e-7;
/// Promised gain that is within the accuracy of the integration: 0.14 standard errors.
const ROUND: f64 = 1e-2;
/// Predicted variance of a velocity or mode, in natural units, from which on nothing is predicted: five times the usual size.
const VAGUE: f64 = 25.0;
/// Steps with a smaller part of `r` along `s` teach nothing.
const LEAST_ANGLE: f64 = 1e-8;

/// The estimate of the curvature beyond the expected information.
struct Correction(DMatrix<f64>);

impl Correction {
    fn learn(&mut self, step: &DVector<f64>, from: &Evaluation, to: &Evaluation) {
        let missing = &from.gradient - &to.gradient - &to.information * step - &self.0 * step;
        let along = missing.dot(step);
        if along.is_finite() && along.abs() > LEAST_ANGLE * missing.norm() * step.norm() {
            self.0.ger(1.0 / along, &missing, &missing, 1.0);
        }
    }

    /// The model of the free parameters: those that do not push against a bound.
    fn model(&self, at: &Evaluation, free: &[usize]) -> Option<Model> {
        let n = free.len();
        let entry = |i: usize, j: usize| {
            let (i, j) = (free[i], free[j]);
            at.information[(i, j)] + self.0[(i, j)]
        };
        let gradient = DVector::from_fn(n, |i, _| at.gradient[free[i]]);
        Model::new(&DMatrix::from_fn(n, n, entry), &gradient)
    }

    /// Forgets everything.
    fn forget(&mut self) {
        self.0.fill(0.0);
    }

    /// The gain of a step according to the model.
    fn gain(&self, at: &Evaluation, step: &DVector<f64>) -> f64 {
        at.gradient.dot(step) - 0.5 * step.dot(&(&at.information * step + &self.0 * step))
    }
}

/// A climb under way.
struct Climb<'a> {
    problem: &'a Problem,
    theta: Theta,
    at: Evaluation,
    correction: Correction,
    radius: f64,
    evaluations: usize,
    /// Steps of the integration in all of them.
    steps: usize,
    /// Those in evaluations of equations that are too fast for the frames.
    too_fast: usize,
    /// Natural unit of time.
    time: f64,
    /// Predicted gain of log-likelihood below which it ends, and the most evaluations.
    enough: f64,
    most: usize,
}

fn difference(to: &Theta, from: &Theta) -> DVector<f64> {
    let coefficients = to.coefficients.iter().zip(&from.coefficients).map(|(b, a)| b - a);
    let logs = to.logs.iter().zip(&from.logs).map(|(b, a)| b - a);
    DVector::from_iterator(from.coefficients.len() + NOISES, coefficients.chain(logs))
}

impl Climb<'_> {
    fn free(&self) -> Vec<usize> {
        let held = held(&self.theta, &self.at.gradient);
        (0..held.len()).filter(|&i| !held[i]).collect()
    }

    /// A step and its consequences.
    fn advance(&mut self, model: &Model, free: &[usize]) {
        let mut step = vec![0.0; self.at.gradient.len()];
        for (&i, part) in free.iter().zip(model.step(self.radius).iter()) {
            step[i] = *part;
        }
        let next = moved(&self.theta, step);
        let step = difference(&next, &self.theta);
        let (length, promised) = (step.norm(), self.correction.gain(&self.at, &step));
        let trial = objective(self.problem, &next, Want::Exact);
        self.evaluations += 1;
        self.steps += trial.steps;
        self.too_fast += if trial.too_fast { trial.steps } else { 0 };
        if !trial.value.is_finite() {
            self.radius = 0.25 * length;
            return;
        }
        let gained = trial.value - self.at.value;
        self.correction.learn(&step, &self.at, &trial);
        let ratio = gained / promised.abs().max(f64::MIN_POSITIVE);
        if ratio < 0.25 {
            self.radius = 0.25 * length;
        } else if ratio > 0.75 && length > 0.8 * self.radius {
            self.radius = (2.0 * self.radius).min(RADII[1]);
        }
        if gained > 0.0 {
            (self.theta, self.at) = (next, trial);
        }
    }

    /// Returns `true` if the point is a maximum: the model promises nothing more, nor does the expected
    /// information alone.
    fn arrived(&self, model: &Model, free: &[usize]) -> bool {
        let expected = Correction(DMatrix::zeros(self.at.gradient.len(), self.at.gradient.len()));
        let promise = |model: Option<f64>| model.is_some_and(|gain| gain < self.enough);
        promise(model.promise()) && promise(expected.model(&self.at, free).and_then(|model| model.promise()))
    }

    fn run(&mut self, watch: &dyn Watch) -> Ending {
        let stopped = |reason: &str| Ending::Stopped { reason: reason.to_owned() };
        if !self.at.value.is_finite() {
            return stopped("the filter diverges at the start");
        }
        let mut again = false;
        loop {
            let free = self.free();
            let Some(model) = self.correction.model(&self.at, &free) else {
                return stopped("the information matrix is not finite");
            };
            if self.arrived(&model, &free) {
                return Ending::Converged { evaluations: self.evaluations };
            }
            if watch.stopped() {
                return stopped("interrupted");
            }
            if self.evaluations >= self.most {
                return stopped(&self.why(&format!("{} evaluations were not enough", self.most)));
            }
            if self.too_fast >= (MOST_TOO_FAST.0 * self.problem.frames()).max(MOST_TOO_FAST.1) {
                return stopped(&self.why(TOO_FAST));
            }
            if self.steps >= self.most_steps() {
                return stopped(&self.why(&format!("{} steps of the filter were not enough", self.steps)));
            }
            if self.radius < SMALLEST {
                if again {
                    return self.stuck(&free);
                }
                again = true;
                self.correction.forget();
                self.radius = RADII[0];
            }
            self.advance(&model, &free);
        }
    }

    fn most_steps(&self) -> usize {
        let [few, many] = MOST_STEPS.map(|each| each * self.problem.frames());
        few.clamp(LIMITS.0, LIMITS.1).max(many)
    }

    /// The end where no step improves the likelihood: a maximum within the accuracy of the integration, or none.
    fn stuck(&self, free: &[usize]) -> Ending {
        let n = self.at.gradient.len();
        let expected =
            Correction(DMatrix::zeros(n, n)).model(&self.at, free).and_then(|model| model.promise());
        if expected.is_some_and(|gain| gain < ROUND) {
            return Ending::Converged { evaluations: self.evaluations };
        }
        Ending::Stopped { reason: self.why("no step improves the likelihood") }
    }

    /// The reason of a search without end. Where a frame is hardly predicted at all, the likelihood rises up
    /// to equations that blow up before it. A search that ends among equations that are too fast says so.
    fn why(&self, what: &str) -> String {
        let (variance, t) = self.at.vaguest;
        if variance < VAGUE {
            return if self.at.too_fast { TOO_FAST } else { what }.to_owned();
        }
        let after = (1e4 * t * self.time).round() / 1e4;
        format!(
            "the likelihood rises towards equations that blow up between frames, before {after} after the \
            first frame of a cell: sudden jumps there, wrong outlines, or noise that is not white"
        )
    }
}

/// To the maximum with exact derivatives; `time` is the natural unit of time.
pub(crate) fn polish(problem: &Problem, theta: &Theta, time: f64, watch: &dyn Watch) -> Point {
    polish_within(problem, theta, time, CONVERGED, MOST, watch)
}

/// As [`polish`], until the model promises a gain of log-likelihood below `enough`, by at most `most` evaluations.
pub(crate) fn polish_within(
    problem: &Problem,
    theta: &Theta,
    time: f64,
    enough: f64,
    most: usize,
    watch: &dyn Watch,
) -> Point {
    let n = problem.len();
    let mut climb = Climb {
        problem,
        theta: theta.clone(),
        at: objective(problem, theta, Want::Exact),
        correction: Correction(DMatrix::zeros(n, n)),
        radius: RADII[0],
        evaluations: 1,
        steps: 0,
        too_fast: 0,
        time,
        enough,
        most,
    };
    let ending = climb.run(watch);
    Point { theta: climb.theta, evaluation: climb.at, ending }
}
