//! Newton's method in a plane across a branch, and the directions of branches.

use super::elimination::newton_step;
use super::point::Obstruction;
use super::problem::{Equations, Failure, Linear};
use motiform_analysis::singular::svd;
use motiform_dynamics::Watch;
use motiform_dynamics::sample::sort_by_number;

/// Steps that Newton's method may take.
const STEPS: usize = 10;

/// Newton's tolerance where special points are looked for, and so the error of equilibria there, in the units of the unknowns.
pub(super) const TIGHT: f64 = 1e-11;

/// A solution, and how it was reached.
pub(super) struct Corrected<L> {
    /// The unknowns.
    pub(super) x: Vec<f64>,
    /// Results computed beside them: one Newton step, shorter than the tolerance, lies between.
    pub(super) local: L,
    /// Length of the first step.
    pub(super) first: f64,
    /// A direction of the branch there, on the side of the plane's normal.
    pub(super) direction: Vec<f64>,
}

/// `sum_i weight_i a_i b_i`.
pub(super) fn product(weights: &[f64], a: &[f64], b: &[f64]) -> f64 {
    weights.iter().zip(a).zip(b).map(|((w, x), y)| w * x * y).sum()
}

/// The solution near `guess` in the plane through it that is normal to `row`. Has converged with the first step shorter than
/// `tolerance` or than the resolution of the equations, or where round-off stops the progress not far above it.
pub(super) fn correct<P: Equations>(
    problem: &P,
    guess: Vec<f64>,
    row: &[f64],
    tolerance: f64,
    watch: &dyn Watch,
) -> Result<Corrected<P::Local>, Failure> {
    let weights = problem.weights(&guess);
    let tolerance = tolerance.max(problem.resolution());
    let mut x = guess;
    problem.tidy(&mut x);
    let (mut first, mut last) = (f64::INFINITY, f64::INFINITY);
    for count in 0..STEPS {
        if !problem.is_sound(&x) {
            break;
        }
        let local = problem.local(&x, watch)?;
        let (step, direction) = newton_step(problem.linear(&local), row).ok_or(SINGULAR)?;
        let size = product(&weights, &step, &step).sqrt();
        for (value, change) in x.iter_mut().zip(&step) {
            *value += change;
        }
        if count == 0 {
            first = size;
        }
        let stalled = size < 1e3 * tolerance && size > 0.1 * last;
        if size <= tolerance || stalled {
            problem.tidy(&mut x);
            return Ok(Corrected { x, local, first, direction });
        }
        if !size.is_finite() || count >= 2 && size > 0.5 * last {
            break;
        }
        last = size;
    }
    Err(Failure::Obstructed(Obstruction::Newton))
}

const SINGULAR: Failure = Failure::Obstructed(Obstruction::Singular);

/// Directions with the part of the equations that sees them to first order (a singular value), smallest first.
pub(super) fn seen(linear: &Linear, weights: &[f64]) -> Vec<(f64, Vec<f64>)> {
    let dim = linear.matrix.ncols();
    let mut square = linear.matrix.clone().resize_vertically(dim, 0.0);
    for (j, weight) in weights.iter().enumerate() {
        square.column_mut(j).scale_mut(1.0 / weight.sqrt());
    }
    let Some(svd) = svd(square) else { return Vec::new() };
    let Some(rows) = svd.v_t else { return Vec::new() };
    let unscaled = |i: usize| rows.row(i).iter().zip(weights).map(|(v, w)| v / w.sqrt()).collect();
    let mut all: Vec<(f64, Vec<f64>)> = (0..dim).map(|i| (svd.singular_values[i], unscaled(i))).collect();
    sort_by_number(&mut all, |a| a.0);
    all
}

/// Directions, those first that the equations see least: one of them not at all where a branch is alone.
pub(super) fn directions(linear: &Linear, weights: &[f64]) -> Vec<Vec<f64>> {
    seen(linear, weights).into_iter().map(|one| one.1).collect()
}

/// The distance of two places in the units of their unknowns.
pub(super) fn distance(weights: &[f64], a: &[f64], b: &[f64]) -> f64 {
    let apart: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
    product(weights, &apart, &apart).sqrt()
}

/// Directions that the equations do not see where branches cross, at least two beside those of a family; empty where one branch is alone.
pub(super) fn crossing<P: Equations>(problem: &P, local: &P::Local, weights: &[f64]) -> Vec<Vec<f64>> {
    let found = unseen(problem, local, weights);
    if found.len() > 1 + problem.linear(local).family.len() { found } else { Vec::new() }
}

/// Directions that the equations do not see, where there are two at least; empty where there is one. The unseen parts are
/// told from the others by the widest gap between them: a part that would be small beside the rates of fast modes is large beside those of
/// slow ones.
pub(super) fn unseen<P: Equations>(problem: &P, local: &P::Local, weights: &[f64]) -> Vec<Vec<f64>> {
    let all = seen(problem.linear(local), weights);
    let count = count_unseen(&all, problem.resolution());
    all.into_iter().take(count).map(|one| one.1).collect()
}

/// Number of these directions that are unseen, 0 where one branch is alone. Round-off of the equations, of relative size `resolution`,
/// parts the branches: at their place what is not seen is as large as its root.
pub(super) fn count_unseen(all: &[(f64, Vec<f64>)], resolution: f64) -> usize {
    let least = GAP.min(BLURRED / resolution.sqrt());
    let round_off = all.last().map_or(0.0, |last| f64::EPSILON * last.0);
    let gap = |count: usize| all.get(count).map_or(0.0, |next| next.0 / all[count - 1].0.max(round_off));
    let widest = (2..all.len().min(MOST_UNSEEN + 1)).max_by(|&a, &b| gap(a).total_cmp(&gap(b)));
    widest.filter(|&count| gap(count) > least).unwrap_or(0)
}

/// Most directions that are unseen at once: that of a branch, and those of a deviation and its rotated copies.
const MOST_UNSEEN: usize = 4;

/// Least ratio of a part that is seen to one that is not; with round-off, in its inverse roots.
const GAP: f64 = 1e5;
const BLURRED: f64 = 0.1;

/// The same direction with length 1.
pub(super) fn scaled(mut direction: Vec<f64>, weights: &[f64]) -> Option<Vec<f64>> {
    let length = product(weights, &direction, &direction).sqrt();
    direction.iter_mut().for_each(|x| *x /= length);
    direction.iter().all(|x| x.is_finite()).then_some(direction)
}

/// `weights_i direction_i`: the row whose plane is normal to a direction.
pub(super) fn normal(direction: &[f64], weights: &[f64]) -> Vec<f64> {
    direction.iter().zip(weights).map(|(x, w)| w * x).collect()
}
