//! Tests of a path for what no persistent random walk has.

use super::filter::Step;
use super::{Fix, course};
use serde::Serialize;
use std::fmt::{Display, Formatter};

/// Significance below which innovations are not white.
const COLOURED: f64 = 1e-3;

/// Significance below which a path turns one way. A walk that keeps turning has a far smaller diffusion coefficient than S^2 P/2 long
/// before its innovations are coloured.
const TURNS: f64 = 0.01;

/// Significance below which a path has a direction.
const DIRECTED: f64 = 1e-3;

/// Significance below which a path is held back, or keeps a direction: a share of the walks has that by chance, and loses its numbers.
const HELD: f64 = 0.02;
const KEEPS: f64 = 1e-3;

/// Significance below which the changes of the velocity are not as large over the whole record.
const UNSTEADY: f64 = 1e-3;

/// Above this score additional diffusion is significant: p = 0.03.
const EXTRA: f64 = 2.17;

/// Below this score lengths of displacements scatter too little for the errors of the walk: p = 1e-3.
const EVEN: f64 = -3.0;

/// Fewest steps among which the changes of the velocity may be shared out.
const FEWEST: f64 = 16.0;

/// The reason why a persistent random walk does not describe a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Misfit {
    /// The velocity turns the same way again and again.
    Turns,
    /// The changes of the velocity have a direction: to and fro, along a channel, between walls.
    Directed,
    /// The changes of the velocity have a memory: circling, zigzagging, alternating.
    Coloured,
    /// The path stays closer to one place than the walk: in a trap, between walls all around.
    Held,
    /// The path goes further than the walk.
    Keeps,
    /// The changes of the velocity have another size in one part of the record than in another: slowing down, coming to rest.
    Unsteady,
    /// Displacements from frame to frame scatter more than those of the walk with errors of the places: there is additional diffusion.
    Diffuses,
    /// They scatter less: places are means over a time, or were smoothed.
    Smoothed,
    /// The velocity changes in a few steps alone: straight, and at rest from some time on.
    Rare,
    /// Displacements have so nearly one length that errors of the places as large as those of the walk would show: turns at one speed.
    Even,
}

impl Display for Misfit {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Turns => "the velocity keeps turning one way",
            Self::Directed => {
                "the changes of the velocity, or the errors of the places, have a direction of their own"
            }
            Self::Coloured => "the changes of the velocity are not independent",
            Self::Held => {
                "over long times the mean-square displacement is smaller than that of the walk: the cell is held back, or comes back"
            }
            Self::Keeps => {
                "over long times the mean-square displacement is larger than that of the walk: the cell keeps a direction"
            }
            Self::Unsteady => {
                "the record is not stationary: the changes of the velocity have another size in one part of it than in another"
            }
            Self::Diffuses => {
                "displacements from frame to frame scatter more than those of the walk, and errors of the places do not explain it: the \
                 cell diffuses in addition to its walk, or its velocity has a second, shorter memory"
            }
            Self::Smoothed => {
                "displacements from frame to frame scatter less than those of the walk: the places are means over an exposure, or smoothed"
            }
            Self::Rare => "the velocity changes in a few steps alone: too few to determine persistence and diffusion",
            Self::Even => {
                "displacements differ less in length than errors of the places as large as those of the walk would make them: what looks \
                 like errors is sharp turns at a steady speed"
            }
        })
    }
}

/// Tests of the walk of highest likelihood against its path, and against what it does not have.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct WalkTests {
    /// Steps between places.
    pub steps: usize,
    /// Log-likelihood of the places after the first of each piece.
    pub log_likelihood: f64,
    /// Probability of autocorrelations of the innovations as large as these, if the walk describes the places (Ljung and Box).
    pub p_value: f64,
    /// Score of additional diffusion: for a walk with errors of the places a normal number of variance 1. Above 0 displacements from
    /// place to place scatter more than those of the walk, without the return of an error; below 0 less.
    pub diffusion_score: f64,
    /// Score of a turn of the velocity one way (anticlockwise above 0): for such a walk a normal number of variance 1.
    pub turning_score: f64,
    /// Probability that the changes of the velocity of such a walk have an axis as clear as these.
    pub direction_p_value: f64,
    /// The mean over all lags of the mean-square displacement of the path over that of the walk, as sums of innovations show it: 1 on
    /// average, with a standard deviation of [`SPREAD_SCATTER`](super::SPREAD_SCATTER); below 1 the path is held back.
    pub spread: f64,
    /// Probability of a change of the size of the innovations over the record as large as this one, of such a walk.
    pub steady_p_value: f64,
    /// The number of steps that share the changes of the velocity; infinite where it cannot be told from all of them.
    #[serde(skip)]
    pub changes: f64,
    /// Score of the scatter of the lengths of displacements above the least one that the errors of the walk leave; below 0 it is less.
    pub length_score: f64,
}

/// See [`WalkTests::length_score`]. Displacements d with normal errors of variance 2 s^2 in each coordinate have
///
/// <d^4> - <d^2>^2 >= 8 s^2 (<d^2> - 2 s^2)
///
/// whatever the motion is, with equality where it has one speed. The score is the difference over its standard error.
pub(super) fn length_score(pieces: &[Vec<Fix>], error_variance: f64) -> f64 {
    let pairs = pieces.iter().flat_map(|piece| piece.windows(2));
    let squares: Vec<f64> =
        pairs.map(|pair| (0..2).map(|k| (pair[1].at[k] - pair[0].at[k]).powi(2)).sum()).collect();
    let (n, square) = (squares.len() as f64, squares.iter().sum::<f64>() / squares.len() as f64);
    let scatter: Vec<f64> = squares.iter().map(|x| (x - square) * (x - square)).collect();
    let variance = scatter.iter().sum::<f64>() / n;
    let error = libm::sqrt(scatter.iter().map(|x| (x - variance) * (x - variance)).sum::<f64>()) / n;
    over(variance - 8.0 * error_variance * (square - 2.0 * error_variance), error)
}

fn over(a: f64, b: f64) -> f64 {
    if b > 0.0 { a / b } else { 0.0 }
}

impl WalkTests {
    /// Those of the steps alone; likelihood, whiteness, additional diffusion and lengths are 0 here. Of the standardised innovations e,
    /// with the velocity v that the walk expects before each:
    ///
    /// turning: `sum v x e / sqrt(sum (v x e)^2)`, normal, for e is independent of what was before;
    /// direction: `|sum e^2|^2 / sum |e|^4` of e as complex numbers, exponential, for every direction of e is as likely.
    ///
    /// Both are sums over independent terms by their own squares, whatever the law of the innovations.
    ///
    /// Errors of places may have a direction (an elongated cell is placed better across): only steps count in whose innovation the motion
    /// is the larger part.
    pub(super) fn of(steps: &[Step], error: f64) -> Self {
        let (mut turning, mut turning_squares) = (0.0, 0.0);
        let (mut direction, mut fourth) = ([0.0; 2], 0.0);
        for Step { velocity: [vx, vy], innovation: [x, y], variance, .. } in steps {
            let across = vx * y - vy * x;
            turning += across;
            turning_squares += across * across;
            if *variance < 2.0 * error {
                continue;
            }
            direction[0] += x * x - y * y;
            direction[1] += 2.0 * x * y;
            fourth += (x * x + y * y) * (x * x + y * y);
        }
        let axis = over(direction[0] * direction[0] + direction[1] * direction[1], fourth);
        Self {
            steps: steps.len(),
            log_likelihood: 0.0,
            p_value: 0.0,
            diffusion_score: 0.0,
            turning_score: over(turning, turning_squares.sqrt()),
            direction_p_value: libm::exp(-axis),
            spread: course::spread(steps),
            steady_p_value: course::steady(steps),
            changes: course::changes(steps),
            length_score: 0.0,
        }
    }

    /// The misfit of a walk with these numbers, if there is one.
    pub(super) fn misfit(&self) -> Option<Misfit> {
        let [below, above] = course::tails(self.spread);
        let all = [
            (libm::erfc(self.turning_score.abs() * std::f64::consts::FRAC_1_SQRT_2) < TURNS, Misfit::Turns),
            (self.direction_p_value < DIRECTED, Misfit::Directed),
            (self.p_value < COLOURED, Misfit::Coloured),
            (self.changes < FEWEST, Misfit::Rare),
            (self.steady_p_value < UNSTEADY, Misfit::Unsteady),
            (below < HELD, Misfit::Held),
            (above < KEEPS, Misfit::Keeps),
            (self.diffusion_score > EXTRA, Misfit::Diffuses),
            (self.diffusion_score < -EXTRA, Misfit::Smoothed),
            (self.length_score < EVEN, Misfit::Even),
        ];
        all.into_iter().find(|one| one.0).map(|one| one.1)
    }
}
