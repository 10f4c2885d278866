//! Special points between two points of a branch.

use super::between::{APART, Step, between};
use super::brackets::{BESIDE, Bracket, Test, brackets};
use super::branch_point::branch_point;
use super::certificate::{Certificate, Passing, TestFunction};
use super::correct::{TIGHT, crossing, product, scaled, seen};
use super::levels::Level;
use super::normal_form::{NormalForm, asked};
use super::place::Place;
use super::point::Obstruction;
use super::problem::{Failure, Problem};
use super::special::Special;
use motiform_dynamics::Watch;

/// Most solutions on the way to a special point.
const TRIES: usize = 60;

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
pub(super) fn locate<P: Problem>(
    problem: &P,
    step: &Step<'_, P::Local>,
    watch: &dyn Watch,
) -> Result<Changes<P::Local>, Stopped> {
    let mut changes = Changes { found: Vec::new(), missed: Vec::new() };
    for round in 0..ROUNDS {
        let known: Vec<f64> = changes.found.iter().map(|(at, _)| at.arclength - step.old.arclength).collect();
        if round > 0 && known.is_empty() {
            break;
        }
        for bracket in brackets(problem, step, &known, watch) {
            add(problem, step, &bracket, &mut changes, watch)?;
        }
        changes.found.sort_by(|a, b| a.0.arclength.total_cmp(&b.0.arclength));
        if changes.found.len() == known.len() || !changes.missed.is_empty() {
            break;
        }
    }
    without_folds(&mut changes.found);
    name_folds(problem, &mut changes.found);
    Ok(changes)
}

/// The special point at which a test changes its sign, unless it is known.
fn add<P: Problem>(
    problem: &P,
    step: &Step<'_, P::Local>,
    bracket: &Bracket,
    changes: &mut Changes<P::Local>,
    watch: &dyn Watch,
) -> Result<(), Stopped> {
    let at = match solve(problem, step, bracket, watch) {
        Ok(at) => at,
        Err(Failure::Stopped) => return Err(Stopped),
        Err(Failure::Obstructed(_)) => {
            let seen = kind(problem, step, step.new, bracket.test).name();
            if !changes.missed.contains(&seen) {
                changes.missed.push(seen); // both of a complex pair are one change
            }
            return Ok(());
        }
    };
    let crossing =
        nearly_crosses(problem, &at, bracket.test).then(|| at_crossing(problem, step, &at, watch)).flatten();
    let at = crossing.unwrap_or(at);
    let special = kind(problem, step, &at, bracket.test);
    let crosses = special == Special::BranchPoint && !is_alone(problem, &at);
    let mut at = if crosses { solved(problem, step, at, watch) } else { at };
    if crosses && !matches!(bracket.test, Test::Slope) {
        keep_course(problem, step, &mut at);
    }
    let certificate = certified(problem, step, bracket.test, &at, watch)
        .map(|certificate| Certificate { normal_form: normal_form(problem, &at.x, special), ..certificate });
    let at = Place { certificate, ..at };
    if !is_known(problem, &changes.found, &at, special, step.length) {
        changes.found.push((at, special));
    }
    Ok(())
}

/// Gives a point where branches cross the tangent of this one, which the equations there do not tell from that of the other: the mean of
/// those at both ends of the step.
fn keep_course<P: Problem>(problem: &P, step: &Step<'_, P::Local>, at: &mut Place<P::Local>) {
    let part = (at.arclength - step.old.arclength) / step.length;
    let mean = step.old.tangent.iter().zip(&step.new.tangent).map(|(a, b)| a + part * (b - a)).collect();
    if let Some(tangent) = scaled(mean, &problem.weights(&at.x)) {
        at.tangent = tangent;
    }
}

/// Part of the step by which the equations of a branch point may move it.
const MOVED: f64 = 0.1;

/// The place where branches cross, solved for; as it is, where that fails. (For orbits the second derivatives would cost more than they
/// bring.)
fn solved<P: Problem>(
    problem: &P,
    step: &Step<'_, P::Local>,
    at: Place<P::Local>,
    watch: &dyn Watch,
) -> Place<P::Local> {
    if problem.time().is_some() {
        return at;
    }
    let weights = problem.weights(&at.x);
    let better = || {
        let x = branch_point(problem, &at.x, watch)?;
        let between = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<f64>>();
        let (moved, chord) = (between(&x, &at.x), between(&step.new.x, &step.old.x));
        let part = product(&weights, &chord, &moved) / product(&weights, &chord, &chord);
        let arclength = at.arclength + part * step.length;
        let local = problem.local(&x, watch).ok()?;
        let levels = problem.levels(&x, &local)?;
        let inside = (step.old.arclength..=step.new.arclength).contains(&arclength);
        let near = product(&weights, &moved, &moved).sqrt() < MOVED * step.length;
        (inside && near).then(|| Place {
            x,
            local,
            levels,
            arclength,
            tangent: at.tangent.clone(),
            certificate: None,
        })
    };
    better().unwrap_or(at)
}

/// The evidence that a test vanishes at a place.
fn certified<P: Problem>(
    problem: &P,
    step: &Step<'_, P::Local>,
    test: Test,
    at: &Place<P::Local>,
    watch: &dyn Watch,
) -> Option<Certificate> {
    let s = at.arclength - step.old.arclength;
    let apart = if s < 0.5 * step.length { BESIDE } else { -BESIDE };
    let near = between(problem, step, s + apart * step.length, watch).ok()?;
    let value = |place: &Place<P::Local>| match test {
        Test::Slope => test.of(place),
        Test::Level(class, rank) => {
            critical(step, place, (class, rank)).map_or(f64::NAN, |level| level.growth)
        }
    };
    let passing =
        |place: &Place<P::Local>| Passing { s: place.arclength, value: value(place), slope: place.slope() };
    let here = match test {
        // where branches cross the equations do not tell the tangent of this one: its slope is the mean of those on both sides
        Test::Slope if crosses(problem, at) => {
            let far = between(problem, step, s - apart * step.length, watch).ok()?;
            let slope = 0.5 * (near.slope() + far.slope());
            Passing { s: at.arclength, value: slope, slope }
        }
        _ => passing(at),
    };
    let (kind, noise) = match test {
        Test::Slope => (TestFunction::Slope, problem.accuracy()),
        Test::Level(..) => (TestFunction::Growth, problem.noise(&at.levels)),
    };
    let width = problem.weights(&at.x).last().map_or(f64::NAN, |weight| 1.0 / weight.sqrt());
    Some(Certificate::of(kind, here, passing(&near), noise, problem.accuracy().max(TIGHT) * width))
}

/// The leading coefficient of the normal form at a special point.
fn normal_form<P: Problem>(problem: &P, x: &[f64], special: Special) -> Option<NormalForm> {
    asked(special).map(|(order, doubled)| problem.normal_form(x, order, doubled))
}

/// At a fold a level vanishes as well: each fold of a step takes the nearest vanishing level that seems to be a branch point. (Where a
/// branch is stiff the two tests place one point at lengths that differ by far more than the solutions' accuracy.)
fn without_folds<L>(found: &mut Vec<(Place<L>, Special)>) {
    let folds: Vec<f64> =
        found.iter().filter(|one| one.1 == Special::Fold).map(|one| one.0.arclength).collect();
    for fold in folds {
        let points = found.iter().enumerate().filter(|(_, one)| one.1 == Special::BranchPoint);
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
fn name_folds<P: Problem>(problem: &P, found: &mut [(Place<P::Local>, Special)]) {
    for (at, special) in found.iter_mut().filter(|one| one.1 == Special::BranchPoint) {
        if is_alone(problem, at) {
            *special = Special::Fold;
        }
    }
}

/// The critical level at a place. A circle has no neutral direction, so it has one level more than the shapes near it, and other ranks:
/// there the level closest to 0 is taken.
fn critical<L>(step: &Step<'_, L>, at: &Place<L>, (class, rank): (usize, usize)) -> Option<Level> {
    let levels = at.levels.get(class)?;
    if step.new.levels.get(class).is_some_and(|usual| usual.len() == levels.len()) {
        return levels.get(rank).copied();
    }
    levels.iter().copied().min_by(|a, b| a.growth.abs().total_cmp(&b.growth.abs()))
}

fn kind<P: Problem>(problem: &P, step: &Step<'_, P::Local>, at: &Place<P::Local>, test: Test) -> Special {
    match test {
        // where two branches cross there are two directions; the one that turns back is not at a fold
        Test::Slope if crosses(problem, at) => Special::BranchPoint,
        Test::Slope => Special::Fold,
        Test::Level(class, rank) => {
            let level = critical(step, at, (class, rank)).unwrap_or(at.levels[class][rank]);
            problem.classify(&at.x, level, class)
        }
    }
}

/// Returns `true` if the equations leave two directions to first order.
fn crosses<P: Problem>(problem: &P, at: &Place<P::Local>) -> bool {
    !crossing(problem.linear(&at.local), &problem.weights(&at.x)).is_empty()
}

/// The second smallest part of the equations, and the next one: at a crossing the former vanishes, at a fold it does not.
fn second<P: Problem>(problem: &P, at: &Place<P::Local>) -> Option<(f64, f64)> {
    let all = seen(problem.linear(&at.local), &problem.weights(&at.x));
    Some((all.get(1)?.0, all.get(2)?.0))
}

/// Where the second part is smaller than this part of the next one, two branches may cross nearby.
const NEARLY: f64 = 1e-3;

/// Below this part of the largest one a part of the equations is 0: where several directions are critical at once, the next one is no
/// scale.
const NOTHING: f64 = 1e-12;

/// Returns `true` if the equations leave one direction only, and clearly so: no other branch crosses here.
fn is_alone<P: Problem>(problem: &P, at: &Place<P::Local>) -> bool {
    let all = seen(problem.linear(&at.local), &problem.weights(&at.x));
    let largest = all.last().map_or(0.0, |part| part.0);
    second(problem, at).is_some_and(|(second, next)| second > NEARLY * next && second > NOTHING * largest)
}

/// Returns `true` if the place where a branch turns back may be beside a crossing. Solutions are exact to about the tolerance of the
/// equations, but next to a crossing, at a distance s, the slope is known up to the tolerance divided by s: the place where it vanishes is
/// off by the root of the tolerance.
fn nearly_crosses<P: Problem>(problem: &P, at: &Place<P::Local>, test: Test) -> bool {
    let nearly = |(second, next): (f64, f64)| second < NEARLY * next;
    matches!(test, Test::Slope) && !crosses(problem, at) && second(problem, at).is_some_and(nearly)
}

/// The crossing near a place: there the second part of the equations vanishes, in proportion to the distance on both sides, and exactly so.
fn at_crossing<P: Problem>(
    problem: &P,
    step: &Step<'_, P::Local>,
    near: &Place<P::Local>,
    watch: &dyn Watch,
) -> Option<Place<P::Local>> {
    let mut s = near.arclength - step.old.arclength;
    for part in [1e-2, 1e-3, 1e-5] {
        let (from, to) = (s - part * step.length, s + part * step.length);
        let size = |s: f64| second(problem, &between(problem, step, s, watch).ok()?).map(|pair| pair.0);
        let (a, b) = (size(from)?, size(to)?);
        s = from + (to - from) * a / (a + b);
    }
    between(problem, step, s, watch).ok().filter(|at| crosses(problem, at))
}

/// Part of a step within which points of one kind are one.
const ONE: f64 = 1e-4;

/// Returns `true` if another test has led to the same point. (The length at which a point lies that was solved for is that of the place
/// from which it was.)
fn is_known<P: Problem>(
    problem: &P,
    found: &[(Place<P::Local>, Special)],
    at: &Place<P::Local>,
    special: Special,
    length: f64,
) -> bool {
    let weights = problem.weights(&at.x);
    found.iter().filter(|(_, kind)| kind.name() == special.name()).any(|(other, _)| {
        let between: Vec<f64> = other.x.iter().zip(&at.x).map(|(a, b)| a - b).collect();
        let apart = product(&weights, &between, &between).sqrt();
        apart.min((other.arclength - at.arclength).abs()) < ONE * length
    })
}

/// Least part of the values at both ends of a bracket that is not 0.
const VANISHING: f64 = 0.1;

/// Returns `true` if a test is small on both sides of `s`. Over a gap between two branches it changes its sign without passing 0. (Next to
/// a crossing the slope is that of round-off: then the sides tell.)
fn vanishes_beside<P: Problem>(
    problem: &P,
    step: &Step<'_, P::Local>,
    (test, s, scale): (Test, f64, f64),
    watch: &dyn Watch,
) -> bool {
    let small = |side: f64| {
        let at = between(problem, step, s + side * APART * step.length, watch);
        at.is_ok_and(|at| test.of(&at).abs() <= VANISHING * scale)
    };
    small(-1.0) && small(1.0)
}

/// The solution at which the test vanishes, by false position (the Illinois variant): every iterate is a solution of the equations.
fn solve<P: Problem>(
    problem: &P,
    step: &Step<'_, P::Local>,
    &Bracket { test, mut low, mut high }: &Bracket,
    watch: &dyn Watch,
) -> Result<Place<P::Local>, Failure> {
    let scale = low.1.abs().max(high.1.abs());
    let (mut kept_high, mut last) = (None, f64::INFINITY);
    for count in 1..=TRIES {
        let false_position = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
        let s = if count % 12 == 0 { 0.5 * (low.0 + high.0) } else { false_position };
        let at = between(problem, step, s, watch)?;
        let value = test.of(&at);
        if value.abs() <= 1e-12 * scale {
            return Ok(at);
        }
        if (s - last).abs() <= 1e-10 * step.length {
            let vanishes =
                value.abs() <= VANISHING * scale || vanishes_beside(problem, step, (test, s, scale), watch);
            return if vanishes { Ok(at) } else { Err(Failure::Obstructed(Obstruction::Newton)) };
        }
        last = s;
        if value * low.1 > 0.0 {
            low = (s, value);
            high.1 *= if kept_high == Some(true) { 0.5 } else { 1.0 };
            kept_high = Some(true);
        } else {
            high = (s, value);
            low.1 *= if kept_high == Some(false) { 0.5 } else { 1.0 };
            kept_high = Some(false);
        }
    }
    Err(Failure::Obstructed(Obstruction::Newton))
}
