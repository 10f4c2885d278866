//! Families of solutions with one value of the parameter, along which a branch does not move.

use super::correct::{Corrected, TIGHT, correct, normal, product, scaled, seen, unseen};
use super::levels::{CLEAR, zeros};
use super::problem::{Border, Problem};
use super::tracer::Tracer;
use motiform_analysis::linear::add;
use motiform_analysis::singular::svd;
use motiform_dynamics::sample::sort_by_number;

/// Lengths of the steps in which a family is walked along, in the units of the unknowns, the longest first: a small family bends more.
const STEPS: [f64; 5] = [0.05, 0.015, 0.005, 0.0015, 0.0005];

/// Number of such steps.
const WALKED: usize = 3;

/// Residual of the equations, in errors of solutions, below which a place is a solution.
const SOLVED: f64 = 100.0;

/// Least part of the parameter in the direction of a branch: where it turns back nothing tells it from the directions of a family.
const MOVES: f64 = 1e-6;

/// A branch through a family: its direction, and those along the family, normal to it and to each other.
struct Directions {
    branch: Vec<f64>,
    family: Vec<Vec<f64>>,
}

impl Directions {
    /// From the directions `unseen` that the equations leave to first order; along a family the parameter stays.
    fn of(unseen: &[Vec<f64>], weights: &[f64]) -> Option<Self> {
        let moves = |v: &Vec<f64>| v.last().copied().unwrap_or(0.0);
        let steepest = unseen.iter().max_by(|a, b| moves(a).abs().total_cmp(&moves(b).abs()))?;
        let width = weights.last().map_or(f64::NAN, |weight| 1.0 / weight.sqrt());
        if unseen.len() < 2 || moves(steepest).abs() < MOVES * width {
            return None;
        }
        let others = unseen.iter().filter(|v| !std::ptr::eq(*v, steepest)).map(|v| {
            let mut along = v.clone();
            add(&mut along, -moves(v) / moves(steepest), steepest);
            along
        });
        let family = orthonormal(others, &[], weights)?;
        let branch = orthonormal(std::iter::once(steepest.clone()), &family, weights)?.pop()?;
        Some(Self { branch, family })
    }
}

/// The vectors made normal to `fixed`, which are orthonormal, and to each other, with length 1.
fn orthonormal(
    vectors: impl Iterator<Item = Vec<f64>>,
    fixed: &[Vec<f64>],
    weights: &[f64],
) -> Option<Vec<Vec<f64>>> {
    let mut out: Vec<Vec<f64>> = Vec::new();
    for mut vector in vectors {
        for other in fixed.iter().chain(&out) {
            let part = product(weights, &vector, other);
            add(&mut vector, -part, other);
        }
        out.push(scaled(vector, weights)?);
    }
    Some(out)
}

/// The borders of the equations at `x` that hold these directions of a family: the rows that fix them, and the combinations of equations
/// that the family makes dependent.
fn borders<P: Problem>(
    problem: &P,
    local: &P::Local,
    family: &[Vec<f64>],
    weights: &[f64],
) -> Option<Vec<Border>> {
    let svd = svd(problem.linear(local).matrix.clone())?;
    let mut places: Vec<usize> = (0..svd.singular_values.len()).collect();
    sort_by_number(&mut places, |&a| svd.singular_values[a]);
    let left = svd.u?;
    let border = |(direction, &place): (&Vec<f64>, &usize)| Border {
        left: left.column(place).iter().copied().collect(),
        row: normal(direction, weights),
    };
    Some(family.iter().zip(&places).map(border).collect())
}

/// The family through a solution: its directions, with the equations bordered by it; none where there is none. (The equations are left
/// without a border where this returns `None`.)
fn enter<P: Problem>(problem: &mut P, x: &[f64]) -> Option<Directions> {
    problem.set_family(Vec::new());
    let weights = problem.weights(x);
    let local = problem.local(x, &()).ok()?;
    let found = Directions::of(&unseen(problem, &local, &weights), &weights)?;
    let all = borders(problem, &local, &found.family, &weights)?;
    problem.set_family(all);
    let is_family = found.family.iter().all(|direction| {
        STEPS.iter().any(|step| walks(problem, x, direction, *step) && walks(problem, x, direction, -step))
    });
    if !is_family {
        problem.set_family(Vec::new());
    }
    is_family.then_some(found)
}

/// Returns `true` if some steps along a direction lead from one solution to the next, with the same value of the parameter.
fn walks<P: Problem>(problem: &P, x: &[f64], direction: &[f64], step: f64) -> bool {
    let mut fixed = vec![0.0; x.len()];
    fixed.last_mut().into_iter().for_each(|last| *last = 1.0);
    let (mut here, mut along) = (x.to_vec(), direction.to_vec());
    for _ in 0..WALKED {
        let guess: Vec<f64> = here.iter().zip(&along).map(|(x, d)| x + step * d).collect();
        let Ok(found) = correct(problem, guess, &fixed, TIGHT, &()) else { return false };
        if !is_solved(problem, &found) {
            return false;
        }
        let weights = problem.weights(&here);
        let moved: Vec<f64> = found.x.iter().zip(&here).map(|(a, b)| (a - b) * step.signum()).collect();
        let Some(next) = scaled(moved, &weights) else { return false };
        (here, along) = (found.x, next);
    }
    true
}

/// Returns `true` if the equations hold: those with a border may be solved where they do not.
fn is_solved<P: Problem>(problem: &P, found: &Corrected<P::Local>) -> bool {
    let residual = problem.local(&found.x, &()).map(|local| problem.residual(&found.x, &local));
    residual.is_ok_and(|residual| residual < SOLVED * problem.accuracy().max(TIGHT))
}

/// Borders the equations at a solution from which a branch starts, where it lies in a family: without them they are singular.
pub(super) fn border_at_start<P: Problem>(problem: &mut P, x: &[f64]) {
    let _ = enter(problem, x);
}

/// Returns `true` if the equations held before the last step of Newton's method, up to that step.
pub(super) fn holds<P: Problem>(problem: &P, found: &Corrected<P::Local>, tolerance: f64) -> bool {
    problem.family().is_empty() || problem.residual(&found.x, &found.local) < SOLVED * tolerance
}

impl<P: Problem> Tracer<'_, P> {
    /// Looks for a family of solutions with the value of the parameter, of which the present one is a member, and which goes on along the
    /// branch: one step ahead there must be another one of the same dimension. (At a bifurcation there may be one for one value.)
    /// Its directions have no part in what the branch does: the equations are bordered by them, and their levels left out.
    pub(super) fn find_family(&mut self) {
        let dimension = self.problem.family().len();
        // levels are those of the last but one solution of Newton's method
        if dimension == 0 && zeros(&self.problem, &self.place.levels, CLEAR) == 0 {
            return;
        }
        let course = self.place.tangent.clone();
        let goes_on = enter(&mut self.problem, &self.place.x).is_some_and(|found| {
            self.take_course(&found.branch);
            self.goes_on()
        });
        if !goes_on {
            self.problem.set_family(Vec::new());
            self.place.tangent = course; // that of the border is none of the branch
        }
        if dimension > 0 || goes_on {
            self.renew_levels();
            self.before = None; // its levels are others
        }
    }

    /// Returns `true` if one step ahead there is a family of the same dimension. Beside a special point places off the branch are solutions
    /// within the tolerance; levels tell more, and are 0 at that point alone.
    fn goes_on(&mut self) -> bool {
        let Ok((ahead, _)) = self.attempt(self.step, &()) else { return false };
        let (here, dimension) = (self.problem.family().to_vec(), self.problem.family().len());
        let same = enter(&mut self.problem, &ahead.x).is_some_and(|found| found.family.len() == dimension);
        self.problem.set_family(Vec::new());
        let all =
            self.problem.local(&ahead.x, &()).ok().and_then(|local| self.problem.levels(&ahead.x, &local));
        let neutral = all.is_some_and(|levels| zeros(&self.problem, &levels, CLEAR) >= dimension);
        self.problem.set_family(here);
        same && neutral
    }

    /// Gives the present place the direction `branch`, on the side that it had.
    fn take_course(&mut self, branch: &[f64]) {
        let weights = self.problem.weights(&self.place.x);
        let side = product(&weights, &self.place.tangent, branch);
        self.place.tangent = branch.iter().map(|t| t * 1.0_f64.copysign(side)).collect();
    }

    fn renew_levels(&mut self) {
        if let Ok(local) = self.problem.local(&self.place.x, &())
            && let Some(levels) = self.problem.levels(&self.place.x, &local)
        {
            (self.place.local, self.place.levels) = (local, levels);
        }
    }

    /// Borders the equations by the directions of the family at the present place.
    pub(super) fn follow_family(&mut self) {
        let dimension = self.problem.family().len();
        if dimension == 0 {
            return self.find_family();
        }
        let weights = self.problem.weights(&self.place.x);
        let near = seen(self.problem.linear(&self.place.local), &weights).into_iter().take(dimension + 1);
        let mut near: Vec<Vec<f64>> = near.map(|one| one.1).collect();
        let lies_along = |v: &Vec<f64>| product(&weights, v, &self.place.tangent).abs();
        sort_by_number(&mut near, lies_along);
        near.truncate(dimension);
        let found = orthonormal(near.into_iter(), std::slice::from_ref(&self.place.tangent), &weights)
            .and_then(|family| borders(&self.problem, &self.place.local, &family, &weights));
        if let Some(found) = found {
            self.problem.set_family(found);
        }
    }
}
