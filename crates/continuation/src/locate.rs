//! Special points between two points of a branch.

use super::between::{Step, TIGHT, between};
use super::branch_point::branch_point;
use super::certificate::{Certificate, Passing, TestFunction};
use super::correct::{crossing, product, scaled, seen};
use super::dip::dip;
use super::levels::Level;
use super::normal_form::{NormalForm, asked};
use super::place::Place;
use super::point::Obstruction;
use super::problem::{Failure, Problem};
use super::special::Special;
use motiform_dynamics::Watch;

/// Most solutions on the way to a special point.
const TRIES: usize = 60;

/// What changes on a step.
pub(super) struct Changes<L> {
    /// The special points, in their order.
    pub(super) found: Vec<(Place<L>, Special)>,
    /// The names of the changes that were seen but not located.
    pub(super) missed: Vec<&'static str>,
}

/// The watch stopped the computation.
pub(super) struct Stopped;

/// What vanishes at a special point.
#[derive(Clone, Copy)]
pub(super) enum Test {
    /// `dp/ds`.
    Slope,
    /// The growth of the level of this class and rank. Ranked by size they are continuous along the branch.
    Level(usize, usize),
}

impl Test {
    pub(super) fn of<L>(self, place: &Place<L>) -> f64 {
        self.value(&place.tangent, &place.levels)
    }

    pub(super) fn value(self, tangent: &[f64], levels: &[Vec<Level>]) -> f64 {
        match self {
            Self::Slope => tangent.last().copied().unwrap_or(f64::NAN),
            Self::Level(class, rank) => {
                levels.get(class).and_then(|levels| levels.get(rank)).map_or(f64::NAN, |level| level.growth)
            }
        }
    }
}

/// A test changes its sign between two lengths, with these values.
struct Bracket {
    test: Test,
    low: (f64, f64),
    high: (f64, f64),
}

/// The special points on a step.
pub(super) fn locate<P: Problem>(
    problem: &P,
    step: &Step<'_, P::Local>,
    watch: &dyn Watch,
) -> Result<Changes<P::Local>, Stopped> {
    let mut changes = Changes { found: Vec::new(), missed: Vec::new() };
    for bracket in brackets(problem, step, watch) {
        match solve(problem, step, &bracket, watch) {
            Ok(at) => {
                let crossing = nearly_crosses(problem, &at, bracket.test)
                    .then(|| at_crossing(problem, step, &at, watch))
                    .flatten();
                let at = crossing.unwrap_or(at);
                let special = kind(problem, &at, bracket.test);
                let mut at =
                    if special == Special::BranchPoint { solved(problem, step, at, watch) } else { at };
                if special == Special::BranchPoint && !matches!(bracket.test, Test::Slope) {
                    keep_course(problem, step, &mut at);
                }
                let certificate = certified(problem, step, bracket.test, &at, watch).map(|certificate| {
                    Certificate { normal_form: normal_form(problem, &at.x, special), ..certificate }
                });
                let at = Place { certificate, ..at };
                if !is_known(&changes.found, &at, special, step.length) {
                    changes.found.push((at, special));
                }
            }
            Err(Failure::Stopped) => return Err(Stopped),
            Err(Failure::Obstructed(_)) => {
                let seen = kind(problem, step.new, bracket.test).name();
                if !changes.missed.contains(&seen) {
                    changes.missed.push(seen); // both of a complex pair are one change
                }
            }
        }
    }
    changes.found.sort_by(|a, b| a.0.arclength.total_cmp(&b.0.arclength));
    without_folds(&mut changes.found);
    Ok(changes)
}

/// Gives a point where branches cross the tangent of this one, which the equations there do not tell from that of the other: the mean of those at
/// both ends of the step.
fn keep_course<P: Problem>(problem: &P, step: &Step<'_, P::Local>, at: &mut Place<P::Local>) {
    let part = (at.arclength - step.old.arclength) / step.length;
    let mean = step.old.tangent.iter().zip(&step.new.tangent).map(|(a, b)| a + part * (b - a)).collect();
    if let Some(tangent) = scaled(mean, &problem.weights(&at.x)) {
        at.tangent = tangent;
    }
}

/// Part of the step by which the equations of a branch point may move it.
const MOVED: f64 = 0.1;

/// The place where branches cross, solved for; as it is, where that fails. (For orbits the second derivatives would cost more than they bring.)
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

/// Part of a step at which a solution beside a special point is looked at.
const BESIDE: f64 = 1e-3;

/// What shows that a test vanishes at a place.
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
    let passing =
        |place: &Place<P::Local>| Passing { s: place.arclength, value: test.of(place), slope: place.slope() };
    let (kind, noise) = match test {
        Test::Slope => (TestFunction::Slope, problem.accuracy()),
        Test::Level(..) => (TestFunction::Growth, problem.noise(&at.levels)),
    };
    let width = problem.weights(&at.x).last().map_or(f64::NAN, |weight| 1.0 / weight.sqrt());
    Some(Certificate::of(kind, passing(at), passing(&near), noise, problem.accuracy().max(TIGHT) * width))
}

/// The leading coefficient of the normal form at a special point.
fn normal_form<P: Problem>(problem: &P, x: &[f64], special: Special) -> Option<NormalForm> {
    asked(special).map(|(order, doubled)| problem.normal_form(x, order, doubled))
}

/// At a fold a level vanishes as well: each fold of a step takes the nearest vanishing level that seems to be a branch point. (Where a branch is
/// stiff the two tests place one point at lengths that differ by far more than the solutions' accuracy.)
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

fn kind<P: Problem>(problem: &P, at: &Place<P::Local>, test: Test) -> Special {
    match test {
        // where two branches cross there are two directions; the one that turns back is not at a fold
        Test::Slope if crosses(problem, at) => Special::BranchPoint,
        Test::Slope => Special::Fold,
        Test::Level(class, rank) => problem.classify(&at.x, at.levels[class][rank], class),
    }
}

/// Whether the equations leave two directions to first order.
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

/// Whether the place where a branch turns back may be beside a crossing. Solutions are exact to about the tolerance of the equations, but next to a
/// crossing, at a distance s, the slope is known up to the tolerance divided by s: the place where it vanishes is off by the root of the tolerance.
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

/// Whether another test has led to the same point.
fn is_known<L>(found: &[(Place<L>, Special)], at: &Place<L>, special: Special, length: f64) -> bool {
    found.iter().any(|(other, kind)| {
        let same = kind.name() == special.name();
        same && (other.arclength - at.arclength).abs() < 1e-4 * length
    })
}

/// What changes its sign on the way; the slope first. Where a test seems to change it twice, solutions between decide.
fn brackets<P: Problem>(problem: &P, step: &Step<'_, P::Local>, watch: &dyn Watch) -> Vec<Bracket> {
    let ranks = |(class, (a, b)): (usize, (&Vec<_>, &Vec<_>))| {
        let ranks = if a.len() == b.len() { a.len() } else { 0 };
        (0..ranks).map(move |rank| Test::Level(class, rank)).collect::<Vec<Test>>()
    };
    let levels = step.old.levels.iter().zip(&step.new.levels).enumerate().flat_map(ranks);
    let noise = problem.noise(&step.old.levels).max(problem.noise(&step.new.levels));
    let unclear = |test: Test| {
        matches!(test, Test::Level(..))
            && [step.old, step.new].iter().all(|place| test.of(place).abs() <= noise)
    };
    let mut out = Vec::new();
    for test in std::iter::once(Test::Slope).chain(levels) {
        let (low, high) = ((0.0, test.of(step.old)), (step.length, test.of(step.new)));
        if unclear(test) {
            continue; // towards a point of more symmetry levels vanish as powers of the distance, and their signs are those of rounding
        }
        if low.1 * high.1 < 0.0 {
            out.push(Bracket { test, low, high });
        } else if let Some(middle) = dip(problem, step, test, watch) {
            out.push(Bracket { test, low, high: middle });
            out.push(Bracket { test, low: middle, high });
        }
    }
    if is_level(problem, step) && out.iter().all(|bracket| matches!(bracket.test, Test::Slope)) {
        out.clear(); // where a branch turns back a level vanishes as well
    }
    out
}

/// Slopes below so many times the accuracy of the solutions may be noise: towards a connection the parameter converges and the branch goes on.
const LEVEL: f64 = 10.0;

/// Whether the parameter hardly changes over a step.
fn is_level<P: Problem>(problem: &P, step: &Step<'_, P::Local>) -> bool {
    let slope = step.old.slope().abs().max(step.new.slope().abs());
    let width = problem.weights(&step.old.x).last().map_or(f64::NAN, |weight| 1.0 / weight.sqrt());
    slope < LEVEL * problem.accuracy() * width
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
        if value.abs() <= 1e-12 * scale || (s - last).abs() <= 1e-10 * step.length {
            return Ok(at);
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
