//! Places where branches cross, and where they nearly do.

use super::between::{Step, between};
use super::brackets::{BESIDE, Test};
use super::branch_point::branch_point;
use super::correct::{crossing, product, scaled, seen};
use super::locate::{kind, value};
use super::place::Place;
use super::problem::Problem;
use super::special::Special;
use super::tracer::TOLERANCE;

/// Returns `true` if the equations leave two directions to first order.
pub(super) fn crosses<P: Problem>(problem: &P, at: &Place<P::Local>) -> bool {
    !crossing(problem, &at.local, &problem.weights(&at.x)).is_empty()
}

/// The second smallest part of the equations beside those that do not see a family, and the next one: at a crossing the former vanishes, at
/// a fold it does not.
fn second<P: Problem>(problem: &P, at: &Place<P::Local>) -> Option<(f64, f64)> {
    let all = seen(problem.linear(&at.local), &problem.weights(&at.x));
    let family = problem.family().len();
    Some((all.get(1 + family)?.0, all.get(2 + family)?.0))
}

/// Where the second part is smaller than this part of the next one, two branches may cross nearby.
const NEARLY: f64 = 1e-3;

/// Below this part of the largest one a part of the equations is 0: where several directions are critical at once, the next one is no
/// scale.
const NOTHING: f64 = 1e-12;

/// Beside a crossing where branches do not touch the second part is so many times as large on both sides; beside a fold it changes by less
/// than this part of itself.
const RISES: f64 = 2.0;
const STEADY: f64 = 0.01;

/// Returns `true` if the equations leave one direction only, and clearly so: no other branch crosses here. Over a wide range the next part
/// is no scale: a small second part is judged by itself, by its course along the branch.
pub(super) fn is_alone<P: Problem>(step: &Step<'_, P>, at: &Place<P::Local>) -> bool {
    let problem = step.problem;
    let all = seen(problem.linear(&at.local), &problem.weights(&at.x));
    let largest = all.last().map_or(0.0, |part| part.0);
    let Some((size, next)) = second(problem, at).filter(|parts| parts.0 > NOTHING * largest) else {
        return false;
    };
    let s = at.arclength - step.old.arclength;
    let beside =
        |side: f64| Some(second(problem, &between(step, s + side * BESIDE * step.length).ok()?)?.0 / size);
    size > SUSPECT * next
        || match (beside(-1.0), beside(1.0)) {
            (Some(low), Some(high)) if size > NEARLY * next => low.min(high) < RISES,
            (Some(low), Some(high)) => (low - 1.0).abs().max((high - 1.0).abs()) < STEADY,
            _ => size > NEARLY * next,
        }
}

/// The same where the branch seems to turn back, or a level that seems to be that of a branch point vanishes: tests may be 0 within their
/// errors up to a distance from a crossing of high order.
const SUSPECT: f64 = 0.05;

/// Returns `true` if the place where a branch turns back may be beside a crossing. Solutions are exact to about the tolerance of the
/// equations, but next to a crossing, at a distance s, the slope is known up to the tolerance divided by s: the place where it vanishes is
/// off by the root of the tolerance.
pub(super) fn nearly_crosses<P: Problem>(step: &Step<'_, P>, at: &Place<P::Local>, test: Test) -> bool {
    let nearly = |(second, next): (f64, f64)| second < SUSPECT * next;
    let may_cross = || test == Test::Slope || kind(step, at, test) == Special::BranchPoint;
    !crosses(step.problem, at) && second(step.problem, at).is_some_and(nearly) && may_cross()
}

/// If a test changes by at most this many of its errors between its zero and a crossing nearby, it vanishes because of the crossing. The
/// error of the slope is the tolerance over the distance.
const NOISE: f64 = 10.0;

/// Part of the step by which a crossing may lie outside: about it the slope at the ends of steps may be that of round-off.
const BEYOND: f64 = 1.0;

/// The crossing near a place: there the second part of the equations vanishes, in proportion to the distance on both sides, and exactly so.
/// (The crossing may lie beyond the distances that are looked at: where a pitchfork is of high order the slope vanishes over a range.)
pub(super) fn at_crossing<P: Problem>(
    step: &Step<'_, P>,
    (near, test): (&Place<P::Local>, Test),
) -> Option<Place<P::Local>> {
    let problem = step.problem;
    let start = near.arclength - step.old.arclength;
    let mut s = start;
    for part in [1e-2, 1e-3, 1e-5] {
        let (from, to) = (s - part * step.length, s + part * step.length);
        let size = |s: f64| second(problem, &between(step, s).ok()?).map(|pair| pair.0);
        let (a, middle, b) = (size(from)?, size(s)?, size(to)?);
        let mean = |b: f64| 0.5 * (a + b).abs();
        let beyond = (middle - mean(b)).abs() < (middle - mean(-b)).abs();
        s = from + (to - from) * a / if beyond { a - b } else { a + b };
        let middle = 0.5 * step.length;
        if (s - middle).abs() > middle + BEYOND * step.length {
            return None;
        }
    }
    // farther away the test vanishes by itself
    let change = || {
        let value =
            |side: f64| Some(value(step, &between(step, start + side * BESIDE * step.length).ok()?, test));
        Some((value(1.0)? - value(-1.0)?).abs() / (2.0 * BESIDE * step.length) * (s - start).abs())
    };
    let width = problem.weights(&near.x).last().map_or(f64::NAN, |weight| 1.0 / weight.sqrt());
    let error = match test {
        Test::Slope => TOLERANCE * width / (s - start).abs(),
        Test::Level(..) => problem.noise(&near.levels),
    };
    let explained = change()? <= NOISE * error;
    between(step, s).ok().filter(|at| explained && crosses(problem, at))
}

/// Gives a point where branches cross the tangent of this one, which the equations there do not tell from that of the other: the mean of
/// those at both ends of the step, or, where the branch turns back, of those on both sides.
pub(super) fn keep_course<P: Problem>(step: &Step<'_, P>, (test, at): (Test, &mut Place<P::Local>)) {
    let s = at.arclength - step.old.arclength;
    let mean = |a: &[f64], b: &[f64], part: f64| a.iter().zip(b).map(|(a, b)| a + part * (b - a)).collect();
    let mean = if test == Test::Slope {
        let side = |side: f64| between(step, s + side * BESIDE * step.length);
        let (Ok(low), Ok(high)) = (side(-1.0), side(1.0)) else { return };
        mean(&low.tangent, &high.tangent, 0.5)
    } else {
        mean(&step.old.tangent, &step.new.tangent, s / step.length)
    };
    if let Some(tangent) = scaled(mean, &step.problem.weights(&at.x)) {
        at.tangent = tangent;
    }
}

/// Part of the step by which the equations of a branch point may move it.
const MOVED: f64 = 0.1;

/// The place where branches cross, solved for; `None` where that fails. (For orbits the second derivatives would cost more than they
/// bring.)
pub(super) fn solved<P: Problem>(step: &Step<'_, P>, at: &Place<P::Local>) -> Option<Place<P::Local>> {
    let problem = step.problem;
    if problem.time().is_some() || !problem.family().is_empty() {
        return None;
    }
    let weights = problem.weights(&at.x);
    let x = branch_point(problem, &at.x, step.watch)?;
    let between = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<f64>>();
    let (moved, chord) = (between(&x, &at.x), between(&step.new.x, &step.old.x));
    let part = product(&weights, &chord, &moved) / product(&weights, &chord, &chord);
    let arclength = at.arclength + part * step.length;
    let local = problem.local(&x, step.watch).ok()?;
    let levels = problem.levels(&x, &local)?;
    let inside = (step.old.arclength..=step.new.arclength).contains(&arclength);
    let near = product(&weights, &moved, &moved).sqrt() < MOVED * step.length;
    let tangent = at.tangent.clone();
    (inside && near).then_some(Place { x, local, levels, arclength, tangent, certificate: None })
}
