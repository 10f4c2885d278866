//! Where tests change their signs on a step.

use super::between::{Step, between, between_exact};
use super::levels::{Level, unclear};
use super::place::{Before, Place};
use super::problem::Problem;
use super::smooth::{Number, Smooth};
use std::cell::RefCell;

/// The function that vanishes at a special point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Test {
    /// `dp/ds`.
    Slope,
    /// The growth of the level of this class and rank. Ranked by size they are continuous along the branch.
    Level(usize, usize),
}

impl Test {
    pub(super) fn of<L>(self, place: &Place<L>) -> f64 {
        self.read(place.slope(), &place.levels)
    }

    pub(super) fn before(self, before: &Before) -> f64 {
        self.read(before.tangent.last().copied().unwrap_or(f64::NAN), &before.levels)
    }

    pub(super) fn read(self, slope: f64, levels: &[Vec<Level>]) -> f64 {
        match self {
            Self::Slope => slope,
            Self::Level(class, rank) => {
                levels.get(class).and_then(|levels| levels.get(rank)).map_or(f64::NAN, |level| level.growth)
            }
        }
    }
}

/// A test changes its sign between two lengths, with these values.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bracket {
    pub(super) test: Test,
    pub(super) low: (f64, f64),
    pub(super) high: (f64, f64),
}

/// The course of the tests on a step.
#[derive(Default)]
pub(super) struct Signs {
    /// Their sign changes.
    pub(super) brackets: Vec<Bracket>,
    /// Lengths at which a level comes so close to 0, and back, that its error decides on which side it is.
    pub(super) touches: Vec<(f64, Test)>,
    /// Tests that fall towards 0 where there is no solution between the ends of the step.
    pub(super) gaps: Vec<Test>,
}

/// Part of the step that stretches keep from special points.
pub(super) const BESIDE: f64 = 1e-3;

/// The sign changes between special points that are known, at these lengths: as many deviations must grow before each of them as beyond the
/// one before, and the slope must have the same sign. The slope comes first. Where a test seems to change its sign twice, solutions between
/// decide.
pub(super) fn brackets<P: Problem>(step: &Step<'_, P>, known: &[f64]) -> Signs {
    let beside = |s: f64| Some((s, between(step, s).ok()?));
    let apart = BESIDE * step.length;
    let sides: Vec<_> = known.iter().map(|s| (beside(s - apart), beside(s + apart))).collect();
    let mut out = Signs::default();
    let mut low = Some((0.0, step.old));
    for place in 0..=sides.len() {
        let high = match sides.get(place) {
            Some((before, _)) => before.as_ref().map(|(s, place)| (*s, place)),
            None => Some((step.length, step.new)),
        };
        if let (Some(low), Some(high)) = (low, high)
            && low.0 < high.0
        {
            let is_whole = known.is_empty();
            Stretch { step, low, high, is_whole, seen: RefCell::default() }.add(&mut out);
        }
        low = sides.get(place).and_then(|(_, beyond)| beyond.as_ref().map(|(s, place)| (*s, place)));
    }
    out.brackets.sort_by_key(|bracket| !matches!(bracket.test, Test::Slope));
    out
}

/// Part of a step.
pub(super) struct Stretch<'s, P: Problem> {
    pub(super) step: &'s Step<'s, P>,
    pub(super) low: (f64, &'s Place<P::Local>),
    pub(super) high: (f64, &'s Place<P::Local>),
    pub(super) is_whole: bool,
    /// Solutions between them: several functions are evaluated in the same places.
    pub(super) seen: RefCell<Vec<(f64, Option<Seen>)>>,
}

/// The slope and the levels at a place, and whether it is solved for there.
pub(super) type Seen = (f64, Vec<Vec<Level>>, bool);

impl<P: Problem> Stretch<'_, P> {
    /// The sign changes on it.
    fn add(&self, out: &mut Signs) {
        let before = out.brackets.len();
        for class in 0..self.low.1.levels.len() {
            self.add_class(class, out);
        }
        // where a branch turns back a level vanishes as well: where the slope is that of round-off the level tells the place
        let level = [self.step.old, self.step.new].map(|end| is_level(self.step.problem, end));
        let folds = &out.brackets[before..];
        let told = !folds.is_empty() && folds.iter().all(|found| self.is_fold(found));
        if level == [true; 2] && folds.is_empty() || level.contains(&true) && told {
            return;
        }
        match self.bracket(Test::Slope) {
            Some(bracket) => out.brackets.push(bracket),
            None => self.twice(&|slope, _| number(slope), &[Test::Slope], out),
        }
    }

    /// Returns `true` if the level that changes its sign is one that vanishes where a branch turns back.
    fn is_fold(&self, found: &Bracket) -> bool {
        let Test::Level(class, rank) = found.test else { return false };
        let real = |place: &Place<P::Local>| place.levels[class][rank].angle == 0.0;
        class == 0 && (real(self.low.1) || real(self.high.1))
    }

    fn bracket(&self, test: Test) -> Option<Bracket> {
        let [low, high] = [self.low, self.high].map(|(s, place)| (s, test.of(place)));
        (low.1 * high.1 < 0.0).then_some(Bracket { test, low, high })
    }

    fn add_class(&self, class: usize, out: &mut Signs) {
        let [count, other] =
            [self.low, self.high].map(|(_, place)| place.levels.get(class).map_or(0, Vec::len));
        if count != other {
            return;
        }
        let tests: Vec<Test> = (0..count).map(|rank| Test::Level(class, rank)).collect();
        let noise = self.noise();
        // towards a point of more symmetry levels vanish as powers of the distance, and their signs are those of rounding
        let clear = |bracket: &Bracket| {
            let sizes = [bracket.low.1.abs(), bracket.high.1.abs()];
            if self.is_whole { sizes[0].max(sizes[1]) > noise } else { sizes[0].min(sizes[1]) > noise }
        };
        let before = out.brackets.len();
        out.brackets.extend(tests.iter().filter_map(|&test| self.bracket(test)).filter(clear));
        let orbits = self.step.problem.time().is_some();
        for smooth in Smooth::all(orbits) {
            if out.brackets.len() > before {
                return;
            }
            let of = |levels: &Vec<Level>| smooth.value(levels, orbits);
            self.twice(&|_, levels| levels.get(class).map_or((1.0, f64::NAN), of), &tests, out);
        }
    }

    /// The error of levels; the slope has none that is known.
    pub(super) fn noise(&self) -> f64 {
        self.step.problem.noise(&self.low.1.levels).max(self.step.problem.noise(&self.high.1.levels))
    }

    /// The growth below which a level may have either sign at an ordinary place.
    pub(super) fn unclear(&self) -> f64 {
        let of = |place: &Place<P::Local>| unclear(self.step.problem, &place.levels);
        of(self.low.1).max(of(self.high.1))
    }

    /// The solution at a length; nothing where there is none.
    pub(super) fn seen(&self, s: f64) -> Option<Seen> {
        let known = self.seen.borrow().iter().find(|one| one.0 == s).map(|one| one.1.clone());
        known.unwrap_or_else(|| {
            let place = between_exact(self.step, s).ok();
            let found = place
                .filter(|(place, _)| !self.strays(place))
                .map(|(place, exact)| (place.slope(), place.levels, exact));
            self.seen.borrow_mut().push((s, found.clone()));
            found
        })
    }
}

fn number(value: f64) -> Number {
    (value.signum(), value.abs().ln())
}

/// Slopes of orbits below so many times the accuracy of the solutions may be noise: towards a connection the parameter converges and the
/// branch goes on.
pub(super) const LEVEL: f64 = 10.0;

/// Returns `true` if the parameter of orbits hardly changes at a place: the sign of the slope there may be that of round-off.
fn is_level<P: Problem>(problem: &P, place: &Place<P::Local>) -> bool {
    let width = problem.weights(&place.x).last().map_or(f64::NAN, |weight| 1.0 / weight.sqrt());
    problem.time().is_some() && place.slope().abs() < LEVEL * problem.accuracy() * width
}
