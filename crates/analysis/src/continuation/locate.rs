//! Special points between two points of a branch.

use super::correct::{correct, normal, product};
use super::place::{Place, place};
use super::point::Obstruction;
use super::problem::{Failure, Problem};
use super::special::Special;
use motiform_dynamics::Watch;

/// Newton's tolerance at special points.
const TIGHT: f64 = 1e-11;

/// Most solutions on the way to a special point.
const TRIES: usize = 60;

/// What vanishes at a special point.
#[derive(Clone, Copy)]
enum Test {
    /// `dp/ds`.
    Slope,
    /// The growth of the level of this class and rank. Ranked by size they are continuous along the branch.
    Level(usize, usize),
}

impl Test {
    fn of<L>(self, place: &Place<L>) -> f64 {
        match self {
            Self::Slope => place.slope(),
            Self::Level(class, rank) => place
                .levels
                .get(class)
                .and_then(|levels| levels.get(rank))
                .map_or(f64::NAN, |level| level.growth),
        }
    }
}

/// The special points between `old` and `new`, `length` apart, in their order.
pub(super) fn locate<P: Problem>(
    problem: &P,
    old: &Place<P::Local>,
    new: &Place<P::Local>,
    length: f64,
    watch: &dyn Watch,
) -> Vec<(Place<P::Local>, Special)> {
    let mut found: Vec<(Place<P::Local>, Special)> = Vec::new();
    for test in tests(old, new) {
        let Ok(at) = solve(problem, old, new, (test, length), watch) else { continue };
        let special = match test {
            Test::Slope => Special::Fold,
            Test::Level(class, rank) => problem.classify(&at.x, at.levels[class][rank], class),
        };
        let close = |other: &Place<P::Local>| (other.arclength - at.arclength).abs() < 1e-4 * length;
        let known = found.iter().any(|(other, kind)| {
            let same = kind.name() == special.name();
            close(other) && (same || *kind == Special::Fold && special == Special::BranchPoint)
        });
        if !known {
            found.push((at, special));
        }
    }
    found.sort_by(|a, b| a.0.arclength.total_cmp(&b.0.arclength));
    found
}

/// What changes its sign on the way; the slope first.
fn tests<L>(old: &Place<L>, new: &Place<L>) -> Vec<Test> {
    let ranks = |(class, (a, b)): (usize, (&Vec<_>, &Vec<_>))| {
        let ranks = if a.len() == b.len() { a.len() } else { 0 };
        (0..ranks).map(move |rank| Test::Level(class, rank)).collect::<Vec<Test>>()
    };
    let levels = old.levels.iter().zip(&new.levels).enumerate().flat_map(ranks);
    let changes = |test: &Test| test.of(old) * test.of(new) < 0.0;
    std::iter::once(Test::Slope).chain(levels).filter(changes).collect()
}

/// The solution at which the test vanishes, by false position (the Illinois variant): every iterate is a solution of the equations.
fn solve<P: Problem>(
    problem: &P,
    old: &Place<P::Local>,
    new: &Place<P::Local>,
    (test, length): (Test, f64),
    watch: &dyn Watch,
) -> Result<Place<P::Local>, Failure> {
    let (mut low, mut high) = ((0.0, test.of(old)), (length, test.of(new)));
    let scale = low.1.abs().max(high.1.abs());
    let (mut kept_high, mut last) = (None, f64::INFINITY);
    for count in 1..=TRIES {
        let false_position = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
        let s = if count % 12 == 0 { 0.5 * (low.0 + high.0) } else { false_position };
        let at = between(problem, old, new, (s, length), watch)?;
        let value = test.of(&at);
        if value.abs() <= 1e-12 * scale || (s - last).abs() <= 1e-10 * length {
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

/// The solution at the length `s` after `old`, on the way to `new`.
fn between<P: Problem>(
    problem: &P,
    old: &Place<P::Local>,
    new: &Place<P::Local>,
    (s, length): (f64, f64),
    watch: &dyn Watch,
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
    place(problem, found, &row, old.arclength + s)
}
