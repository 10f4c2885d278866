//! One persistent random walk of many cells.

use super::extra_diffusion::{ALLOWED, Number, Scores};
use super::filter::{by_coordinate, steps};
use super::table::nearby;
use super::{Bounded, Fix, PersistentWalk};
use crate::warnings::ljung_box;
use motiform_dynamics::distributions::{NORMAL_95, student_quantile, unequal_freedom};
use motiform_dynamics::sample::median;
use nalgebra::{Matrix4, Vector4};

/// Fewest cells whose differences give intervals; of fewer they are those of their paths, as of one walk.
const CELLS: usize = 8;

/// The walk of highest likelihood of the paths of many cells, taken together: no bias of short records is in it.
#[derive(Debug, Clone, PartialEq)]
pub struct WalkTogether {
    /// Persistence time P.
    pub persistence: Bounded,
    /// Root mean square speed S of the walk.
    pub speed: Bounded,
    /// Diffusion coefficient D.
    pub diffusion: Bounded,
    /// Variance of the error of a coordinate, below 0 where places are means over a time.
    pub error_variance: Bounded,
    /// Probability of autocorrelations of the innovations as large as these, if one walk describes all paths (Ljung and Box).
    pub p_value: f64,
    /// Score of additional diffusion, from its scatter over cells: for walks a normal number of variance 1.
    pub diffusion_score: f64,
}

/// The walk of highest likelihood of these cells, each with the pieces of its path and its own walk.
///
/// Its innovations are uncorrelated whatever the law of the velocity, so that the scores of cells are independent with mean 0 where the
/// covariance is that of the walk: `cov = I^-1 (sum over cells of u u^T) I^-1`, u the score of a cell over 1 less its share of all steps,
/// with Student's t of `(sum n)^2/sum n^2 - 1` degrees of freedom, n the steps of a cell. From 8 cells on; of fewer `cov = I^-1`.
///
/// Source: Huber (1967), Proc. 5th Berkeley Symp. 1, 221; [`unequal_freedom`] for the degrees of freedom.
///
/// # Units   of the places and times
/// # Checked by  tests/all/together_walk.rs: walks of equal and of very different lengths, additional diffusion, means over exposures
pub fn walk_together(cells: &[(&[Vec<Fix>], &PersistentWalk)]) -> Option<WalkTogether> {
    let usual = |of: fn(&PersistentWalk) -> f64| median(cells.iter().map(|(_, walk)| of(walk)));
    let persistence = usual(|walk| walk.persistence.value)?;
    let error = usual(|walk| walk.error_variance.value / (0.5 * walk.speed.value * walk.speed.value))?;
    let pieces: Vec<Vec<Fix>> = cells.iter().flat_map(|(pieces, _)| pieces.iter().cloned()).collect();
    let (best, is_resolved) =
        nearby(&pieces, persistence, error).or_else(|| nearby(&pieces, persistence, 0.0))?;
    let (variance, interval) = (best.sums.scale(), super::table::shortest(&pieces));
    let scores = Scores::of(&pieces, best.law, variance, interval);
    let inverses = scores.inverses()?;
    let of_cells = by_cells(cells, &scores);
    let found = steps(&pieces, best.law);
    let own: Vec<f64> = of_cells.iter().map(|(score, _)| scores.own(&inverses, score)).collect();
    let squares: f64 = own.iter().map(|own| own * own).sum();
    let diffusion_score = match cells.len() < CELLS {
        true => scores.own(&inverses, &scores.sum()) * inverses[1][(3, 3)].sqrt(),
        false => own.iter().sum::<f64>() / squares.sqrt(),
    };
    let shift = inverses[1] * scores.sum();
    let (covariances, t) = covariances(&of_cells, &inverses);
    let bounded = |number: Number, value: f64| {
        let gradient = scores.gradient(number);
        let half =
            |which: usize| t * (gradient.transpose() * covariances[which] * gradient)[0].max(0.0).sqrt();
        let (mut low, mut high) = (-half(0), half(0));
        if diffusion_score.abs() > ALLOWED {
            let shift = gradient.dot(&shift);
            (low, high) = (low.min(shift - half(1)), high.max(shift + half(1)));
        }
        let end = |by: f64| match number {
            Number::Error => value + by,
            _ => value * libm::exp(by),
        };
        Bounded { value, low: Some(end(low)), high: Some(end(high)) }
    };
    let persistence = bounded(Number::Persistence, best.law.persistence);
    let speed = bounded(Number::Speed, (2.0 * variance).sqrt());
    Some(WalkTogether {
        persistence: Bounded { low: persistence.low.filter(|_| is_resolved), ..persistence },
        speed: Bounded { high: speed.high.filter(|_| is_resolved), ..speed },
        diffusion: bounded(Number::Diffusion, variance * best.law.persistence),
        error_variance: bounded(Number::Error, variance * best.law.error),
        p_value: ljung_box(&by_coordinate(&found, pieces.len())).1,
        diffusion_score,
    })
}

/// The score of each cell, and its steps.
fn by_cells(cells: &[(&[Vec<Fix>], &PersistentWalk)], scores: &Scores) -> Vec<(Vector4<f64>, f64)> {
    let mut pieces = scores.pieces.iter();
    let cell = |(of, _): &(&[Vec<Fix>], &PersistentWalk)| {
        let own = pieces.by_ref().take(of.len());
        own.fold((Vector4::zeros(), 0.0), |(sum, n), (score, steps)| (sum + score, n + steps))
    };
    cells.iter().map(cell).collect()
}

/// Covariances without and with additional diffusion, and the quantile that goes with them.
fn covariances(cells: &[(Vector4<f64>, f64)], inverses: &[Matrix4<f64>; 2]) -> ([Matrix4<f64>; 2], f64) {
    if cells.len() < CELLS {
        return (*inverses, NORMAL_95);
    }
    let all: f64 = cells.iter().map(|(_, steps)| steps).sum();
    let scatter: Matrix4<f64> = cells
        .iter()
        .map(|(score, steps)| score / (1.0 - steps / all))
        .map(|score| score * score.transpose())
        .sum();
    let freedom = unequal_freedom(cells.iter().map(|(_, steps)| *steps));
    (inverses.map(|inverse| inverse * scatter * inverse), student_quantile(freedom))
}
