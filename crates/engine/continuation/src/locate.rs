//! Special points between two points of a branch.

use super::between::{Step, between};
use super::brackets::{BESIDE, Bracket, Test, brackets};
use super::branch_point::blurred;
use super::certificate::{Certificate, Passing, TestFunction};
use super::coefficient::leading_coefficient;
use super::correct::TIGHT;
use super::crossings::{at_crossing, crosses, is_alone, keep_course, nearly_crosses, solved};
use super::levels::Level;
use super::one_point::is_known;
use super::place::Place;
use super::problem::{Failure, Problem};
use super::special::Special;
use super::touch::touching;
use super::zero::solve;
use motiform_dynamics::sample::sort_by_number;

/// The changes on a step.
pub(super) struct Changes<L> {
    /// The special points, in their order.
    pub(super) found: Vec<(Place<L>, Special)>,
    /// The names of the changes that were seen but not located.
    pub(super) missed: Vec<&'static str>,
}

/// The watch stopped the computation.
pub(super) struct Stopped;

/// Rounds of examination between special points.
const ROUNDS: usize = 6;

/// The special points on a step: until as many deviations grow before each of them as beyond the one before.
pub(super) fn locate<P: Problem>(step: &Step<'_, P>) -> Result<Changes<P::Local>, Stopped> {
    let mut changes = Changes { found: Vec::new(), missed: Vec::new() };
    let mut touches = Vec::new();
    for round in 0..ROUNDS {
        let known: Vec<f64> = changes.found.iter().map(|(at, _)| at.arclength - step.old.arclength).collect();
        if round > 0 && known.is_empty() {
            break;
        }
        let signs = brackets(step, &known);
        for bracket in &signs.brackets {
            add(step, bracket, &mut changes)?;
        }
        if round == 0 {
            touches = touching(step, &signs);
            let seen = signs.gaps.iter().map(|&test| kind(step, step.new, test).name());
            changes.missed.extend(seen.take(1));
        }
        sort_by_number(&mut changes.found, |a| a.0.arclength);
        if changes.found.len() == known.len() || !changes.missed.is_empty() {
            break;
        }
    }
    without_folds(step.problem, &mut changes.found);
    name_folds(step, &mut changes.found);
    // beside a special point a growth may come to 0 because of it
    if changes.found.is_empty() {
        changes.found = touches;
    }
    Ok(changes)
}

/// The special point at which a test changes its sign, unless it is known.
fn add<P: Problem>(
    step: &Step<'_, P>,
    bracket: &Bracket,
    changes: &mut Changes<P::Local>,
) -> Result<(), Stopped> {
    let problem = step.problem;
    let at = match solve(step, bracket) {
        Ok(at) => at,
        Err(Failure::Stopped) => return Err(Stopped),
        Err(Failure::Obstructed(_)) => {
            let seen = kind(step, step.new, bracket.test).name();
            if !changes.missed.contains(&seen) {
                changes.missed.push(seen); // both of a complex pair are one change
            }
            return Ok(());
        }
    };
    let crossing =
        nearly_crosses(step, &at, bracket.test).then(|| at_crossing(step, (&at, bracket.test))).flatten();
    let at = crossing.unwrap_or(at);
    let special = kind(step, &at, bracket.test);
    let crosses = special == Special::BranchPoint && !is_alone(step, &at);
    let better = if crosses { solved(step, &at) } else { None };
    let blur = match &better {
        _ if !crosses || problem.time().is_some() => 0.0,
        Some(_) => blurred(problem),
        None => problem.resolution().sqrt(),
    };
    let mut at = better.unwrap_or(at);
    if crosses {
        keep_course(step, (bracket.test, &mut at));
    }
    let certificate = certified(step, (bracket.test, blur), &at).map(|found| Certificate {
        normal_form: leading_coefficient(step, &at, special, found.error),
        ..found
    });
    let at = Place { certificate, ..at };
    if !is_known(step, &changes.found, (&at, bracket.test), special) {
        changes.found.push((at, special));
    }
    Ok(())
}

/// The value of a test, of a level that of the critical one.
pub(super) fn value<P: Problem>(step: &Step<'_, P>, at: &Place<P::Local>, test: Test) -> f64 {
    match test {
        Test::Slope => test.of(at),
        Test::Level(class, rank) => critical(step, at, (class, rank)).map_or(f64::NAN, |level| level.growth),
    }
}

/// The evidence that a test vanishes at a place; `blur` is the error by round-off of the equations that the growth has
/// where branches cross: that of the place if it is solved for, its root on the way along a branch.
fn certified<P: Problem>(
    step: &Step<'_, P>,
    (test, blur): (Test, f64),
    at: &Place<P::Local>,
) -> Option<Certificate> {
    let problem = step.problem;
    let s = at.arclength - step.old.arclength;
    let apart = if s < 0.5 * step.length { BESIDE } else { -BESIDE };
    let near = between(step, s + apart * step.length).ok()?;
    let passing = |place: &Place<P::Local>| Passing {
        s: place.arclength,
        value: value(step, place, test),
        slope: place.slope(),
    };
    let here = match test {
        // where branches cross the equations do not tell the tangent of this one: its slope is the mean of those on both sides
        Test::Slope if crosses(problem, at) => {
            let far = between(step, s - apart * step.length).ok()?;
            let slope = 0.5 * (near.slope() + far.slope());
            Passing { s: at.arclength, value: slope, slope }
        }
        _ => passing(at),
    };
    let (kind, noise) = match test {
        Test::Slope => (TestFunction::Slope, problem.accuracy()),
        Test::Level(..) => (TestFunction::Growth, problem.noise(&at.levels).max(blur * problem.rate())),
    };
    let width = problem.weights(&at.x).last().map_or(f64::NAN, |weight| 1.0 / weight.sqrt());
    let solved = problem.accuracy().max(TIGHT) * width;
    let time = problem.time().map_or(0.0, |place| at.tangent[place]);
    let found = Certificate::of(kind, (here, time), passing(&near), noise, solved);
    // between the ends of the step the test changes its sign
    let far = [step.old, step.new].map(|end| (end.parameter() - at.parameter()).abs());
    let is_between = (step.old.arclength..=step.new.arclength).contains(&at.arclength);
    let error = if is_between { found.error.min(far[0].max(far[1]) + solved) } else { found.error };
    let time_error = problem.time().map_or(0.0, |place| {
        let far = [step.old, step.new].map(|end| (end.x[place] - at.x[place]).abs());
        let found = if is_between { found.time_error.min(far[0].max(far[1])) } else { found.time_error };
        found + problem.accuracy() * at.x[place]
    });
    Some(Certificate { error, time_error, ..found })
}

/// At a fold a level vanishes as well: each fold of a step takes the nearest vanishing level that seems to be a branch point, unless
/// branches do cross there. (Where a branch is stiff the two tests place one point at lengths that differ by far more than the solutions'
/// accuracy.)
fn without_folds<P: Problem>(problem: &P, found: &mut Vec<(Place<P::Local>, Special)>) {
    let folds: Vec<f64> =
        found.iter().filter(|one| one.1 == Special::Fold).map(|one| one.0.arclength).collect();
    for fold in folds {
        let seems =
            |one: &(Place<P::Local>, Special)| one.1 == Special::BranchPoint && !crosses(problem, &one.0);
        let points = found.iter().enumerate().filter(|(_, one)| seems(one));
        let distance = |place: usize| (found[place].0.arclength - fold).abs();
        let nearest = points.map(|one| one.0).min_by(|&a, &b| distance(a).total_cmp(&distance(b)));
        if let Some(nearest) = nearest {
            found.remove(nearest);
        }
    }
}

/// Where a level vanishes and the equations leave one direction only, no branches cross: that direction leaves the parameter as it is, and
/// the branch turns back. (Along a canard the slope is smaller than its error over most of the branch: there the level shows the fold, and
/// the sign of the slope may not.)
fn name_folds<P: Problem>(step: &Step<'_, P>, found: &mut [(Place<P::Local>, Special)]) {
    for (at, special) in found.iter_mut().filter(|one| one.1 == Special::BranchPoint) {
        if is_alone(step, at) {
            *special = Special::Fold;
        }
    }
}

/// The critical level at a place. A circle has no neutral direction, so it has one level more than the shapes near it, and other ranks:
/// there the level closest to 0 is taken.
fn critical<P: Problem>(
    step: &Step<'_, P>,
    at: &Place<P::Local>,
    (class, rank): (usize, usize),
) -> Option<Level> {
    let levels = at.levels.get(class)?;
    if step.new.levels.get(class).is_some_and(|usual| usual.len() == levels.len()) {
        return levels.get(rank).copied();
    }
    levels.iter().copied().min_by(|a, b| a.growth.abs().total_cmp(&b.growth.abs()))
}

pub(super) fn kind<P: Problem>(step: &Step<'_, P>, at: &Place<P::Local>, test: Test) -> Special {
    match test {
        // where two branches cross there are two directions; the one that turns back is not at a fold
        Test::Slope if crosses(step.problem, at) => Special::BranchPoint,
        Test::Slope => Special::Fold,
        Test::Level(class, rank) => {
            let none = Level { growth: f64::NAN, angle: 0.0 }; // a place with fewer levels: that of a real one
            step.problem.classify(&at.x, critical(step, at, (class, rank)).unwrap_or(none), class)
        }
    }
}
