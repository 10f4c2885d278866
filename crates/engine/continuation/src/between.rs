//! Solutions between two points of a branch.

use super::correct::{TIGHT, correct, normal, product, scaled};
use super::place::{Before, Place, place};
use super::point::Obstruction;
use super::problem::{Failure, Problem};
use motiform_dynamics::Watch;

/// Part of a step that solutions keep from a place where the equations are singular: what the branch bends on it is below [`TIGHT`].
pub(super) const APART: f64 = 1e-4;

/// Multiples of this distance at which solutions are looked for: round-off fills the more of a step, the longer the orbits are and the more
/// slowly deviations grow beyond the place. (What is found has to solve the equations.)
const WIDER: [f64; 3] = [1.0, 10.0, 100.0];

/// Errors of solutions by which the equations may be off in the middle of two of them.
const UNSOLVED: f64 = 10.0;

/// A solution is given up where the first correction is longer than this part of the step: what is found there may belong to another branch
/// that comes near.
pub(super) const ASTRAY: f64 = 0.1;

/// The step of a problem from `old` to `new`, and the place before it.
pub(super) struct Step<'s, P: Problem> {
    pub(super) problem: &'s P,
    pub(super) watch: &'s dyn Watch,
    pub(super) old: &'s Place<P::Local>,
    pub(super) new: &'s Place<P::Local>,
    pub(super) before: Option<&'s Before>,
    pub(super) length: f64,
}

/// The solution at the length `s` after the beginning of a step. Where branches cross the equations are singular, and Newton's method finds
/// nothing in a neighbourhood that round-off fills: there it is the middle of the solutions on both sides.
pub(super) fn between<P: Problem>(step: &Step<'_, P>, s: f64) -> Result<Place<P::Local>, Failure> {
    between_exact(step, s).map(|found| found.0)
}

/// The same, and whether it is a solution of Newton's method, not the middle of two.
pub(super) fn between_exact<P: Problem>(
    step: &Step<'_, P>,
    s: f64,
) -> Result<(Place<P::Local>, bool), Failure> {
    match solution(step, s) {
        // a step of Newton's method that nothing bounds leads where there is no flow, either
        Err(Failure::Obstructed(why)) => {
            let mut found = Err(Failure::Obstructed(why));
            for wider in WIDER {
                found = middle(step, (s, wider * APART * step.length));
                if !matches!(found, Err(Failure::Obstructed(_))) {
                    break;
                }
            }
            found.map(|found| (found, false))
        }
        found => found.map(|found| (found, true)),
    }
}

/// The middle of the solutions on both sides of `s`.
fn middle<P: Problem>(step: &Step<'_, P>, (s, apart): (f64, f64)) -> Result<Place<P::Local>, Failure> {
    let problem = step.problem;
    let side = |sign: f64| solution(step, s + sign * apart);
    let (low, high) = (side(-1.0)?, side(1.0)?);
    let mean = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| 0.5 * (a + b)).collect::<Vec<f64>>();
    let broken = || Failure::Obstructed(Obstruction::Singular);
    let x = mean(&low.x, &high.x);
    let tangent = scaled(mean(&low.tangent, &high.tangent), &problem.weights(&x)).ok_or_else(broken)?;
    let local = problem.local(&x, step.watch)?;
    // over a gap between two branches it is no solution
    if problem.residual(&x, &local) > UNSOLVED * problem.accuracy().max(TIGHT) {
        return Err(broken());
    }
    let levels = problem.levels(&x, &local).ok_or_else(broken)?;
    Ok(Place { x, local, tangent, levels, arclength: step.old.arclength + s, certificate: None })
}

/// The solution of Newton's method there.
fn solution<P: Problem>(
    &Step { problem, watch, old, new, length, .. }: &Step<'_, P>,
    s: f64,
) -> Result<Place<P::Local>, Failure> {
    let weights = problem.weights(&old.x);
    let row = normal(&old.tangent, &weights);
    let turned = product(&weights, &old.tangent, &new.tangent);
    let x = s / length;
    // Hermite's cubic; both ends and their tangents are known
    let (h00, h10) = ((1.0 + 2.0 * x) * (1.0 - x) * (1.0 - x), x * (1.0 - x) * (1.0 - x) * length);
    let (h01, h11) = (x * x * (3.0 - 2.0 * x), x * x * (x - 1.0) * length / turned);
    let guess = (0..old.x.len())
        .map(|i| h00 * old.x[i] + h10 * old.tangent[i] + h01 * new.x[i] + h11 * new.tangent[i])
        .collect();
    let found = correct(problem, guess, &row, TIGHT, watch)?;
    // orbits beside connections are known to less than short steps are long
    if problem.time().is_none() && found.first > ASTRAY * length {
        return Err(Failure::Obstructed(Obstruction::Newton));
    }
    place(problem, found, &row, old.arclength + s)
}
