//! A velocity of the stage as a nuisance parameter of a fit.
//!
//! Laws that keep their form under rotations have no velocity that does not turn with the cell: what is seen
//! of one is the stage, or a flow. In the equations it is `x' = Re z1 + u_x, y' = -Im z1 + u_y`, which is the
//! same as the law for `(x, y) - u t`.

use crate::filter::{Evaluation, Frame, NOISES, Problem, Want, evaluate};
use crate::fit::{problem, refit};
use crate::{Fit, Result, Settings, Track, observation};
use motiform_dynamics::Watch;
use motiform_dynamics::distributions::chi_square_tail;
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
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

/// Parameters that do not turn with a cell, and can be taken for its handedness.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beside {
    /// A velocity of the stage.
    Stage,
    /// Images that are stretched along one direction: the path is, by a small strain, and outlines have a
    /// constant elongation.
    Stretch,
}

impl Beside {
    /// The number of its parameters: two of a velocity; two of a strain (along x less along y, and along the
    /// diagonals) and two of a constant in z2.
    fn count(self) -> usize {
        match self {
            Self::Stage => 2,
            Self::Stretch => 4,
        }
    }

    /// The units of its parameters.
    fn units(self, fit: &Fit) -> Vec<f64> {
        let [speed, size] = [fit.scales.amplitudes[0], fit.scales.amplitudes[1]];
        match self {
            Self::Stage => vec![speed; 2],
            Self::Stretch => vec![1.0, 1.0, size, size],
        }
    }

    /// Takes this from an observation, this time after the first one, which was at the origin.
    fn subtract(self, by: &[f64], t: f64, origin: [f64; 2], y: &mut [f64]) {
        match self {
            Self::Stage => (0..2).for_each(|k| y[k] -= by[k] * t),
            Self::Stretch => {
                let [right, up] = [0, 1].map(|k| y[k] - origin[k]);
                y[0] -= by[0] * right + by[1] * up;
                y[1] -= by[1] * right - by[0] * up;
                y[2] -= by[2];
                y[3] -= by[3];
            }
        }
    }
}

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
/// scores of coefficients and noise leaves (over the frames of all tracks, `s_k` being 0 in the others),
/// `V = sum r_k r_k^T`: the sum `S` of `s_k` gives `S^T V^-1 S`,
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
    let Some(fitted) = Fitted::of(tracks, fit) else { return Ok(vec![None; tracks.len()]) };
    Ok((0..tracks.len()).map(|k| Score::of(&fitted, k, fit, Beside::Stage)?.velocity(fit)).collect())
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
    let (steps, tracks, fit) = with(Beside::Stage, tracks, fit, watch)?;
    let velocities = steps.iter().map(|step| [step[0], step[1]]).collect();
    Ok(WithStage { velocities, tracks, fit })
}

/// The parameters of highest likelihood of each track, together with the terms of a fit; the tracks without what they stand for; the
/// fit to these.
fn with(
    beside: Beside,
    tracks: &[Track],
    fit: &Fit,
    watch: &dyn Watch,
) -> Result<(Vec<Vec<f64>>, Vec<Track>, Fit)> {
    let settings = Settings { library: fit.library.clone(), handed: fit.handed, starts: Vec::new() };
    let mut best = (vec![vec![0.0; beside.count()]; tracks.len()], tracks.to_vec(), fit.clone());
    let mut share = 1.0;
    for _ in 0..MOST_STEPS {
        let Some(fitted) = Fitted::of(&best.1, &best.2) else { break };
        let mut next = best.clone();
        for (k, track) in best.1.iter().enumerate() {
            let Some(step) = Score::of(&fitted, k, &best.2, beside).and_then(|score| score.step()) else {
                continue;
            };
            let step: Vec<f64> =
                step.iter().zip(beside.units(fit)).map(|(x, unit)| share * x * unit).collect();
            next.1[k] = track.without(beside, &step);
            next.0[k].iter_mut().zip(step).for_each(|(sum, step)| *sum += step);
        }
        next.2 = refit(&next.1, &settings, &fit.scales, &best.2.theta(), watch)?;
        let gained = next.2.log_likelihood - best.2.log_likelihood;
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

/// The p-value of the likelihood ratio of complex against real coefficients where both models have beside
/// them what does not turn with the cell.
///
/// # Errors    of the input; [`crate::Error::Interrupted`]
/// # Checked by  `tests/all/stage.rs`: a circle on a stage that drifts; `tests/all/stretch.rs`: one in
/// stretched images
pub fn handed_beside(
    beside: Beside,
    tracks: &[Track],
    [real, handed]: [&Fit; 2],
    watch: &dyn Watch,
) -> Result<f64> {
    let [real_there, handed_there] = [real, handed].map(|fit| with(beside, tracks, fit, watch));
    let ratio = 2.0 * (handed_there?.2.log_likelihood - real_there?.2.log_likelihood);
    let more = handed.coefficients.len() - real.coefficients.len();
    Ok(chi_square_tail(ratio.max(0.0), more as f64))
}

/// The scores of coefficients and noise, frame by frame, of all tracks of a fit: they vanish in sum over all of them, not of each.
struct Fitted {
    tracks: Vec<Still>,
    /// Products of these scores, of all tracks.
    products: DMatrix<f64>,
    factor: Cholesky<f64, Dyn>,
}

/// A track with nothing beside its motion.
struct Still {
    problem: Problem,
    /// Scores of the parameters that are free: a row for each frame.
    scores: DMatrix<f64>,
}

impl Fitted {
    /// `None` where the filter diverges.
    fn of(tracks: &[Track], fit: &Fit) -> Option<Self> {
        let settings = Settings { library: fit.library.clone(), handed: fit.handed, starts: Vec::new() };
        let (n, theta) = (fit.coefficients.len(), fit.theta());
        let free: Vec<usize> = (0..n + NOISES).filter(|i| *i < n || !fit.noise.at_bound[*i - n]).collect();
        let still = |track: &Track| {
            let problem = problem(std::slice::from_ref(track), &settings, &fit.scales);
            let found = evaluate(&problem, &theta, Want::Exact, true);
            let scores: Vec<&DVector<f64>> = found.scores.iter().flatten().collect();
            let scores = DMatrix::from_fn(scores.len(), free.len(), |k, i| scores[k][free[i]]);
            (found.value.is_finite() && problem.frames() > 0).then_some(Still { problem, scores })
        };
        let tracks: Vec<Still> = tracks.iter().map(still).collect::<Option<_>>()?;
        let of = |still: &Still| still.scores.transpose() * &still.scores;
        let products = tracks.iter().map(of).reduce(|sum, own| sum + own)?;
        let mut ridged = products.clone();
        for i in 0..ridged.nrows() {
            ridged[(i, i)] *= 1.0 + RIDGE;
        }
        Some(Self { tracks, products, factor: ridged.cholesky()? })
    }
}

/// The scores of a track where there is nothing beside its motion, in natural units.
struct Score {
    /// Derivatives of the log-likelihood.
    slope: DVector<f64>,
    /// Its information on the parameters, without what coefficients and noise take up.
    left: DMatrix<f64>,
    /// All of it.
    information: DMatrix<f64>,
}

impl Score {
    /// Of one of the tracks of a fit. The regression is over the frames of all tracks, since all of them determine the coefficients: what
    /// the scores of one track alone take up, the others may not allow.
    fn of(fitted: &Fitted, track: usize, fit: &Fit, beside: Beside) -> Option<Self> {
        let Still { problem, scores } = &fitted.tracks[track];
        let (theta, count) = (fit.theta(), beside.count());
        let at = |u: &[f64]| {
            let found = evaluate(&moved(problem, beside, u), &theta, Want::Value, true);
            found.value.is_finite().then_some(found)
        };
        let of = |k: usize| {
            let aside = |by: f64| (0..count).map(|i| if i == k { by } else { 0.0 }).collect::<Vec<f64>>();
            let sides = [at(&aside(STEP))?, at(&aside(-STEP))?];
            Some(((sides[0].value - sides[1].value) / (2.0 * STEP), DVector::from_vec(frames(&sides))))
        };
        let all: Vec<(f64, DVector<f64>)> = (0..count).map(of).collect::<Option<_>>()?;
        let own = DMatrix::from_columns(&all.iter().map(|one| one.1.clone()).collect::<Vec<_>>());
        let regression = fitted.factor.solve(&(scores.transpose() * &own));
        let rest = &own - scores * &regression;
        let mut left = rest.transpose() * &rest;
        if fitted.tracks.len() > 1 {
            let others = &fitted.products - scores.transpose() * scores;
            left += regression.transpose() * others * &regression;
        }
        let slope = DVector::from_iterator(count, all.iter().map(|one| one.0));
        Some(Self { slope, left, information: own.transpose() * &own })
    }

    /// The inverse of the information that is left; `None` where the motion of the cell takes some parameter up.
    fn inverse(&self) -> Option<DMatrix<f64>> {
        let scale = |i: usize, j: usize| (self.information[(i, i)] * self.information[(j, j)]).sqrt();
        let n = self.slope.len();
        let relative = DMatrix::from_fn(n, n, |i, j| self.left[(i, j)] / scale(i, j));
        let least = relative.symmetric_eigenvalues().min();
        (least >= LEAST_LEFT).then(|| self.left.clone().cholesky())?.map(|factor| factor.inverse())
    }

    /// One step of the scoring method.
    fn step(&self) -> Option<DVector<f64>> {
        Some(self.inverse()? * &self.slope)
    }

    /// Of the stage.
    fn velocity(&self, fit: &Fit) -> Option<StageVelocity> {
        let (inverse, unit) = (self.inverse()?, fit.scales.amplitudes[0]);
        let step = &inverse * &self.slope;
        Some(StageVelocity {
            velocity: [0, 1].map(|k| unit * step[k]),
            errors: [0, 1].map(|k| unit * inverse[(k, k)].sqrt()),
            p_value: libm::exp(-0.5 * self.slope.dot(&step)),
        })
    }
}

/// The derivative of each frame's log-likelihood by a parameter, from evaluations on both sides: that of the
/// squares of its standardised innovations. The determinant of their covariance hardly changes.
fn frames([up, down]: &[Evaluation; 2]) -> Vec<f64> {
    let square = |e: &Vec<f64>| e.iter().map(|x| x * x).sum::<f64>();
    let of = |found: &Evaluation| found.innovations.iter().flatten().map(square).collect::<Vec<f64>>();
    let (up, down) = (of(up), of(down));
    up.iter().zip(down).map(|(up, down)| -0.5 * (up - down) / (2.0 * STEP)).collect()
}

/// The same frames without these parameters, in natural units.
fn moved(problem: &Problem, beside: Beside, by: &[f64]) -> Problem {
    let mut moved = problem.clone();
    for frame in moved.stretches.iter_mut().flatten() {
        let Frame { t, y, .. } = frame;
        beside.subtract(by, *t, [0.0; 2], y);
    }
    moved
}

impl Track {
    /// The same track without a motion of the stage of this velocity.
    pub fn without_velocity(&self, velocity: [f64; 2]) -> Self {
        self.without(Beside::Stage, &velocity)
    }

    /// The same track without what does not turn with the cell, of these parameters.
    fn without(&self, beside: Beside, by: &[f64]) -> Self {
        let mut frames = self.0.clone();
        let Some((first, origin)) = frames.first().map(|frame| (frame.t, [frame.y[0], frame.y[1]])) else {
            return self.clone();
        };
        for frame in &mut frames {
            beside.subtract(by, frame.t - first, origin, &mut frame.y);
        }
        Self(frames)
    }
}
