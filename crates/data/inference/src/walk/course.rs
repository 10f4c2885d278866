//! The course of the innovations of a walk over the record: their sums, which are the displacements over long times, and their sizes.

use super::filter::Step;
use std::f64::consts::{PI, TAU};

/// The cosines of the squares of the innovations that a change over the record has, and all that are looked at.
const SLOW: usize = 2;
const ALL: usize = 16;
/// Innovations for each cosine.
const PER_COSINE: usize = 8;

/// Significance of a largest square among all.
const LARGEST: f64 = 1e-3;

/// The mean over all lags of the mean-square displacement of the sums of the innovations, over that of independent ones: 1 on average
/// for the walk itself, below 1 where the path is held back.
///
/// `spread = 3 sum |X_k - X|^2/(n (n + 2))`,   X_k the sum of the first k of n innovations, X the mean of these sums
///
/// The mean of `|X_i - X_j|^2` over all pairs is twice the mean of `|X_k - X|^2`. Innovations are in units of their own mean square.
pub(super) fn spread(steps: &[Step]) -> f64 {
    let unit = 0.5 * squares(steps).iter().sum::<f64>() / steps.len() as f64;
    if unit.is_nan() || unit <= 0.0 {
        return 1.0;
    }
    let (mut at, mut sum, mut square) = ([0.0; 2], [0.0; 2], 0.0);
    for step in steps {
        for k in 0..2 {
            at[k] += step.innovation[k];
            sum[k] += at[k];
            square += at[k] * at[k];
        }
    }
    let n = steps.len() as f64;
    let about = square - (sum[0] * sum[0] + sum[1] * sum[1]) / (n + 1.0);
    3.0 * about / (unit * n * (n + 2.0))
}

/// Probabilities of a spread of at most, and at least, this one for independent innovations.
///
/// A third of the spread is the sum over j of `x_j/(pi j)^2` with x_j chi-square with two degrees of freedom (the expansion of Karhunen
/// and Loeve of two Brownian motions about their means): four times Watson's U^2, whose distribution is that of Kolmogorov.
///
/// Source: Watson (1961), Biometrika 48, 109.
pub(super) fn tails(spread: f64) -> [f64; 2] {
    let x = 0.5 * PI * (spread / 3.0).sqrt();
    if x > 1.0 {
        let term = |k: i32| libm::exp(-2.0 * f64::from(k * k) * x * x);
        let above = 2.0 * (term(1) - term(2) + term(3) - term(4));
        return [1.0 - above, above];
    }
    let term = |k: i32| libm::exp(-f64::from(k * k) * PI * PI / (8.0 * x * x));
    let below = if x > 0.0 { TAU.sqrt() / x * (term(1) + term(3) + term(5)) } else { 0.0 };
    [below, 1.0 - below]
}

/// Probability of a change of the size of the innovations over the record as large as this one: the two slowest cosines of their squares
/// beside the next ones. Without a change all have the same variance, also where the squares have a memory that is short beside the
/// record (stop and go), and the ratio of their mean squares is that of Fisher with 2 degrees of freedom above. 1 of short records.
pub(super) fn steady(steps: &[Step]) -> f64 {
    let count = (steps.len() / PER_COSINE).min(ALL);
    if count < 3 * SLOW {
        return 1.0;
    }
    let squares = squares(steps);
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    let cosine = |j: usize| {
        let angle = |k: usize| PI * j as f64 * (k as f64 + 0.5) / squares.len() as f64;
        squares.iter().enumerate().map(|(k, square)| (square - mean) * libm::cos(angle(k))).sum::<f64>()
    };
    let power: Vec<f64> = (1..=count).map(|j| cosine(j) * cosine(j)).collect();
    let below = (count - SLOW) as f64;
    let (slow, fast) = (power[..SLOW].iter().sum::<f64>(), power[SLOW..].iter().sum::<f64>() / below);
    let ratio = slow / (SLOW as f64 * fast.max(f64::MIN_POSITIVE));
    libm::pow(1.0 + 2.0 * ratio / below, -0.5 * below)
}

/// The number of steps that share the changes of the velocity: `2 (sum s)^2/sum s^2` of the squares s of the innovations, as many as there
/// are steps for normal ones. All of them where the largest square may be one of normal innovations (Fisher's test).
pub(super) fn changes(steps: &[Step]) -> f64 {
    let squares = squares(steps);
    let (sum, n) = (squares.iter().sum::<f64>(), squares.len() as f64);
    let largest = squares.iter().copied().fold(0.0, f64::max);
    if sum <= 0.0 || n * libm::pow(1.0 - largest / sum, n - 1.0) > LARGEST {
        return f64::INFINITY;
    }
    2.0 * sum * sum / squares.iter().map(|square| square * square).sum::<f64>()
}

/// The squares of the innovations.
fn squares(steps: &[Step]) -> Vec<f64> {
    steps.iter().map(|Step { innovation: [x, y], .. }| x * x + y * y).collect()
}
