//! The persistent random walk with errors of the positions: the first null of every law of motion.

mod course;
mod extra_diffusion;
mod filter;
mod misfit;
mod ridge;
mod table;
mod together;

use crate::warnings::ljung_box;
use extra_diffusion::{ExtraDiffusion, Number, Scores};
use filter::Law;
pub use misfit::{Misfit, WalkTests};
use serde::Serialize;
use table::{Known, Table};
pub use together::{WalkTogether, walk_together};

/// Fewest steps between places: three numbers and their intervals are estimated from two coordinates of each.
const LEAST_STEPS: usize = 12;

/// A place at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fix {
    /// Time, increasing.
    pub t: f64,
    /// The place.
    pub at: [f64; 2],
}

/// A value with the ends of its 95 % interval; `None`: the places set no bound on this side.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Bounded {
    /// The value of highest likelihood.
    pub value: f64,
    /// The lower end.
    pub low: Option<f64>,
    /// The upper end.
    pub high: Option<f64>,
}

/// A persistent random walk as the places show it.
///
/// # Units   of the places and times
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PersistentWalk {
    /// Persistence time P: the velocity forgets its direction like exp(-t/P).
    pub persistence: Bounded,
    /// Root mean square speed S of the walk itself.
    pub speed: Bounded,
    /// Diffusion coefficient D = S^2 P/2.
    pub diffusion: Bounded,
    /// Standard deviation of the error of a coordinate.
    pub error: Bounded,
    /// Its variance; below 0 where the places are means over a time, such as an exposure, and so the displacements from place to place
    /// smaller than those of a walk.
    pub error_variance: Bounded,
    /// `true` if the places are as likely, within the intervals, without any motion: then there is no lower end to speed and diffusion
    /// coefficient, and the persistence time has no bound.
    pub rests: bool,
    /// Tests of the walk against its path.
    pub tests: WalkTests,
}

/// Standard deviation of [`WalkTests::spread`] of a walk: three times `sqrt(4 sum over j of (pi j)^-4)`.
pub const SPREAD_SCATTER: f64 = 0.632_455_532_033_675_9;

impl PersistentWalk {
    /// The mean-square displacement after a time `lag`, without the errors of the places.
    pub fn displacement(&self, lag: f64) -> f64 {
        let p = self.persistence.value;
        4.0 * self.diffusion.value * (lag + p * libm::expm1(-lag / p))
    }

    /// Returns `true` if the walk describes the places: its innovations are white, isotropic, of one size, turn neither way, their sums
    /// go as far as those of independent ones, and its errors are not larger than the lengths of displacements allow.
    pub fn describes(&self) -> bool {
        self.misfit().is_none()
    }

    /// The reason why the walk does not describe the places; `None` where it does.
    pub fn misfit(&self) -> Option<Misfit> {
        self.tests.misfit()
    }
}

/// The persistent random walk of highest likelihood through these pieces of a record, whatever their gaps.
///
/// dr = v dt,   dv = -v/P dt + sqrt(S^2/P) dW (each coordinate),   places = r + e, e normal and independent
///
/// so that <|r(t) - r(0)|^2> = 2 S^2 P (t - P (1 - e^{-t/P})) + 4 sigma^2. The process is linear: a Kalman
/// filter with the exact transition gives the exact likelihood at any spacing of the times. It depends on a
/// scale that is known in closed form, on P, and on the ratio of error and motion (below 0 where places are means over an exposure, of
/// which independent errors are the opposite in the covariance of displacements): the best ratio is found at each of some P, which narrow,
/// and the best walk from there in steps that shrink; intervals are those of the profile of the likelihood (1.92 below its maximum, more
/// of short records) over these P and ratios around the best one of each.
///
/// `None` with fewer than 12 steps, or where nothing moves at all.
///
/// Source: Fuerth (1920), Z. Phys. 2, 244; Kalman (1960), J. Basic Eng. 82, 35; profile: Venzon and Moolgavkar (1988), Appl. Stat. 37, 87.
///
/// # Units   of the places and times
/// # Not     for motion that turns one way, has a direction or repeats: [`PersistentWalk::misfit`] says so
/// # Checked by  tests/all/walk.rs: likelihood against the multivariate normal density; coverage with gaps and errors; limits of P
pub fn persistent_walk(pieces: &[Vec<Fix>]) -> Option<PersistentWalk> {
    let steps: usize = pieces.iter().map(|piece| piece.len().saturating_sub(1)).sum();
    let moves = pieces.iter().any(|piece| piece.windows(2).any(|pair| pair[0].at != pair[1].at));
    if steps < LEAST_STEPS || !moves {
        return None;
    }
    let table = Table::of(pieces)?;
    let best = table.best();
    let scores = Scores::of(pieces, best.law, best.sums.scale(), table::shortest(pieces));
    let extra = ExtraDiffusion::of(scores);
    let number = |known, number| extra.wider(number, table.bounded(known));
    let persistence = number(Known::Persistence, Number::Persistence);
    let speed = number(Known::Speed, Number::Speed);
    let diffusion = number(Known::Diffusion, Number::Diffusion);
    let error_variance = number(Known::Error, Number::Error);
    let root = |square: f64| square.max(0.0).sqrt();
    let found = filter::steps(pieces, best.law);
    let tests = WalkTests {
        steps,
        log_likelihood: table.highest(),
        p_value: ljung_box(&filter::by_coordinate(&found, pieces.len())).1,
        diffusion_score: extra.score(),
        length_score: misfit::length_score(pieces, error_variance.low.unwrap_or(0.0).max(0.0)),
        ..WalkTests::of(&found, best.law.error)
    };
    let rests = table.rests();
    let moves = |end: Option<f64>| end.filter(|_| !rests);
    Some(PersistentWalk {
        persistence: Bounded { low: moves(persistence.low), high: moves(persistence.high), ..persistence },
        speed: Bounded {
            low: moves(speed.low),
            high: speed.high.filter(|_| persistence.low.is_some()),
            ..speed
        },
        diffusion: Bounded {
            low: moves(diffusion.low),
            high: diffusion.high.filter(|_| persistence.high.is_some()),
            ..diffusion
        },
        error: Bounded {
            value: root(error_variance.value),
            low: error_variance.low.map(root),
            high: error_variance.high.map(root),
        },
        error_variance,
        rests,
        tests,
    })
}

/// Log-likelihood of these places, after the first of each piece, under a walk of given numbers.
///
/// # Units   `persistence`: time; `speed`: length/time; `error`: length
/// # Checked by  tests/all/walk.rs: the multivariate normal density of the places
pub fn walk_likelihood(pieces: &[Vec<Fix>], persistence: f64, speed: f64, error: f64) -> f64 {
    let variance = 0.5 * speed * speed;
    let law = Law { persistence, error: error * error / variance, diffusion: 0.0 };
    filter::sums(pieces, law).log_likelihood(variance)
}
