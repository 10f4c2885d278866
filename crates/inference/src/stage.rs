//! A velocity of the stage as a nuisance parameter of a fit.
//!
//! Laws that keep their form under rotations have no velocity that does not turn with the cell: what is seen
//! of one is the stage, or a flow. In the equations it is `x' = Re z1 + u_x, y' = -Im z1 + u_y`, which is the
//! same as the law for `(x, y) - u t`.

use crate::chi_square::chi_square_tail;
use crate::filter::{Evaluation, Frame, NOISES, Problem, Want, evaluate};
use crate::fit::{problem, refit};
use crate::{Fit, Result, Settings, Track, observation};
use motiform_dynamics::Watch;
use nalgebra::{DMatrix, DVector, Matrix2, Vector2};
use serde::{Deserialize, Serialize};

/// Step of the differences, in natural units of the velocity.
const STEP: f64 = 1e-3;
/// Most steps to the velocity of highest likelihood, and the gain of log-likelihood below which they end.
const MOST_STEPS: usize = 8;
const ENOUGH: f64 = 1e-2;
/// The factor by which a step that went too far is shortened.
const SHORTER: f64 = 0.4;
/// Relative addition to the products of scores, where these do not determine a regression.
const RIDGE: f64 = 1e-9;
/// Share of the information on the velocity that the coefficients must leave: below, it cannot be told from the cell's own motion.
const LEAST_LEFT: f64 = 1e-6;

/// A velocity beside the motion of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StageVelocity {
    /// One step of the scoring method from 0 (length/time).
    pub velocity: [f64; 2],
    /// Its standard errors, the coefficients estimated together with it.
    pub errors: [f64; 2],
    /// Probability of such a velocity, or a larger one, where there is none.
    pub p_value: f64,
}

/// The velocity of the stage of each track, by the score test: no fit is made.
///
/// With the scores `s_k = dl_k/du` of the frames at `u = 0`, and the rest `r_k` that their regression on the
/// scores of coefficients and noise leaves, `V = sum r_k r_k^T`: the sum `S` of `s_k` gives `S^T V^-1 S`,
/// chi-square with two degrees of freedom, and `u = V^-1 S`. Derivatives by `u` are differences of
/// likelihoods and of squares of innovations. `None` where the motion of the cell takes any velocity up, or
/// the filter diverges.
///
/// Source: Berndt, Hall, Hall and Hausman (1974), Ann. Econ. Soc. Meas. 3, 653 (information from products of
/// scores); Godfrey (1988), Misspecification Tests in Econometrics, ch. 1.
///
/// # Units   length/time of the tracks
/// # Errors    of the input, as [`crate::fit()`]
/// # Checked by  `tests/all/stage.rs`: velocities that were added, and p-values without one
pub fn stage_velocities(tracks: &[Track], fit: &Fit) -> Result<Vec<Option<StageVelocity>>> {
    observation::check(tracks, fit.library.modes)?;
    Ok(tracks.iter().map(|track| Score::of(track, fit)?.velocity(fit)).collect())
}

/// A fit with the velocities of the stage that have the highest likelihood.
#[derive(Clone, Debug, PartialEq)]
pub struct WithStage {
    /// One for each track (length/time).
    pub velocities: Vec<[f64; 2]>,
    /// The tracks without them.
    pub tracks: Vec<Track>,
    /// The fit to these.
    pub fit: Fit,
}

/// Fits the velocities of the stage together with the terms of a fit, from there.
///
/// # Errors    of the input; [`crate::Error::Interrupted`]
/// # Checked by  `tests/all/stage.rs`: a velocity that was added, within its errors
pub fn with_stage(tracks: &[Track], fit: &Fit, watch: &dyn Watch) -> Result<WithStage> {
    let settings = Settings { library: fit.library.clone(), handed: fit.handed, starts: Vec::new() };
    let mut best =
        WithStage { velocities: vec![[0.0; 2]; tracks.len()], tracks: tracks.to_vec(), fit: fit.clone() };
    let mut share = 1.0;
    for _ in 0..MOST_STEPS {
        let mut next = best.clone();
        for (k, found) in stage_velocities(&best.tracks, &best.fit)?.into_iter().enumerate() {
            let Some(StageVelocity { velocity, .. }) = found else { continue };
            let step = velocity.map(|v| share * v);
            next.tracks[k] = best.tracks[k].without_velocity(step);
            next.velocities[k] = [0, 1].map(|i| best.velocities[k][i] + step[i]);
        }
        next.fit = refit(&next.tracks, &settings, &fit.scales, &best.fit.theta(), watch)?;
        let gained = next.fit.log_likelihood - best.fit.log_likelihood;
        if gained.is_nan() || gained <= 0.0 {
            share *= SHORTER; // too far
            continue;
        }
        best = next;
        if gained < ENOUGH {
            break;
        }
    }
    Ok(best)
}

/// The p-value of the likelihood ratio of complex against real coefficients where both have the velocity of a stage beside them.
///
/// # Errors    of the input; [`crate::Error::Interrupted`]
/// # Checked by  `tests/all/stage.rs`: a circle on a stage that drifts
pub fn handed_beside_stage(tracks: &[Track], real: &Fit, handed: &Fit, watch: &dyn Watch) -> Result<f64> {
    let [real_there, handed_there] = [real, handed].map(|fit| with_stage(tracks, fit, watch));
    let ratio = 2.0 * (handed_there?.fit.log_likelihood - real_there?.fit.log_likelihood);
    Ok(chi_square_tail(ratio.max(0.0), handed.coefficients.len() - real.coefficients.len()))
}

/// The scores of a track at no velocity, in natural units.
struct Score {
    /// Derivative of the log-likelihood by the velocity.
    slope: Vector2<f64>,
    /// Its information on the velocity, without what coefficients and noise take up.
    left: Matrix2<f64>,
    /// All of it.
    information: Matrix2<f64>,
}

impl Score {
    fn of(track: &Track, fit: &Fit) -> Option<Self> {
        let settings = Settings { library: fit.library.clone(), handed: fit.handed, starts: Vec::new() };
        let (still, theta) = (problem(std::slice::from_ref(track), &settings, &fit.scales), fit.theta());
        let at = |u: [f64; 2], want| {
            let found = evaluate(&moved(&still, u), &theta, want, true);
            (found.value.is_finite() && still.frames() > 0).then_some(found)
        };
        let middle = at([0.0, 0.0], Want::Exact)?;
        let [x, y] = [[STEP, 0.0], [0.0, STEP]].map(|u| {
            let sides = [at(u, Want::Value)?, at(u.map(|v| -v), Want::Value)?];
            let slope = (sides[0].value - sides[1].value) / (2.0 * STEP);
            Some((slope, frames(&sides)))
        });
        let (x, y) = (x?, y?);
        let own = DMatrix::from_columns(&[DVector::from_vec(x.1), DVector::from_vec(y.1)]);
        let n = fit.coefficients.len();
        let free = |i: &usize| *i < n || !fit.noise.at_bound[i - n];
        let free: Vec<usize> = (0..n + NOISES).filter(free).collect();
        let scores: Vec<&DVector<f64>> = middle.scores.iter().flatten().collect();
        let others = DMatrix::from_fn(scores.len(), free.len(), |k, i| scores[k][free[i]]);
        let mut products = others.transpose() * &others;
        for i in 0..products.nrows() {
            products[(i, i)] *= 1.0 + RIDGE;
        }
        let regression = products.cholesky()?.solve(&(others.transpose() * &own));
        let rest = &own - others * regression;
        let square = |of: &DMatrix<f64>| {
            let products = of.transpose() * of;
            Matrix2::from_fn(|i, j| products[(i, j)])
        };
        Some(Self { slope: Vector2::new(x.0, y.0), left: square(&rest), information: square(&own) })
    }

    fn velocity(&self, fit: &Fit) -> Option<StageVelocity> {
        let inverse = self.left.cholesky()?.inverse();
        if self.left.symmetric_eigenvalues().min() < LEAST_LEFT * self.information.trace() {
            return None;
        }
        let step = inverse * self.slope;
        let unit = fit.scales.amplitudes[0];
        Some(StageVelocity {
            velocity: [0, 1].map(|k| unit * step[k]),
            errors: [0, 1].map(|k| unit * inverse[(k, k)].sqrt()),
            p_value: libm::exp(-0.5 * self.slope.dot(&step)),
        })
    }
}

/// The derivative of each frame's log-likelihood by a velocity, from evaluations on both sides: that of the
/// squares of its standardised innovations. The determinant of their covariance hardly changes.
fn frames([up, down]: &[Evaluation; 2]) -> Vec<f64> {
    let square = |e: &Vec<f64>| e.iter().map(|x| x * x).sum::<f64>();
    let of = |found: &Evaluation| found.innovations.iter().flatten().map(square).collect::<Vec<f64>>();
    let (up, down) = (of(up), of(down));
    up.iter().zip(down).map(|(up, down)| -0.5 * (up - down) / (2.0 * STEP)).collect()
}

/// The same frames on a stage that does not have this velocity.
fn moved(problem: &Problem, u: [f64; 2]) -> Problem {
    let mut moved = problem.clone();
    for frame in moved.stretches.iter_mut().flatten() {
        let Frame { t, y, .. } = frame;
        y[0] -= u[0] * *t;
        y[1] -= u[1] * *t;
    }
    moved
}

impl Track {
    /// The same track without a motion of the stage of this velocity.
    #[must_use]
    pub fn without_velocity(&self, velocity: [f64; 2]) -> Self {
        let mut frames = self.0.clone();
        let first = frames.first().map_or(0.0, |frame| frame.t);
        for frame in &mut frames {
            for k in 0..2 {
                frame.y[k] -= velocity[k] * (frame.t - first);
            }
        }
        Self(frames)
    }
}
