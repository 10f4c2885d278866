//! Where tests change their signs on a step.

use super::between::{Step, between};
use super::dip::{Look, dip};
use super::levels::Level;
use super::place::{Before, Place};
use super::problem::Problem;
use super::smooth::{Number, Smooth};
use motiform_dynamics::Watch;
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

    fn before(self, before: &Before) -> f64 {
        self.read(before.tangent.last().copied().unwrap_or(f64::NAN), &before.levels)
    }

    fn read(self, slope: f64, levels: &[Vec<Level>]) -> f64 {
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

/// Part of the step that stretches keep from special points.
pub(super) const BESIDE: f64 = 1e-3;

/// The sign changes between special points that are known, at these lengths: as many deviations must grow before each of them as beyond the
/// one before, and the slope must have the same sign. The slope comes first. Where a test seems to change its sign twice, solutions between
/// decide.
pub(super) fn brackets<P: Problem>(
    problem: &P,
    step: &Step<'_, P::Local>,
    known: &[f64],
    watch: &dyn Watch,
) -> Vec<Bracket> {
    let beside = |s: f64| Some((s, between(problem, step, s, watch).ok()?));
    let apart = BESIDE * step.length;
    let sides: Vec<_> = known.iter().map(|s| (beside(s - apart), beside(s + apart))).collect();
    let mut out = Vec::new();
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
            Stretch { problem, step, low, high, is_whole, watch, seen: RefCell::default() }.add(&mut out);
        }
        low = sides.get(place).and_then(|(_, beyond)| beyond.as_ref().map(|(s, place)| (*s, place)));
    }
    out.sort_by_key(|bracket| !matches!(bracket.test, Test::Slope));
    out
}

/// A level that lies beyond 0 by no more than this part of its values at both ends touches 0: so it does where branches cross at which it
/// is an even function of the length.
const TOUCHES: f64 = 1e-5;

/// Part of a step.
struct Stretch<'s, P: Problem> {
    problem: &'s P,
    step: &'s Step<'s, P::Local>,
    low: (f64, &'s Place<P::Local>),
    high: (f64, &'s Place<P::Local>),
    is_whole: bool,
    watch: &'s dyn Watch,
    /// Solutions between them: several functions are evaluated in the same places.
    seen: RefCell<Vec<(f64, Option<Seen>)>>,
}

/// The slope and the levels at a place.
type Seen = (f64, Vec<Vec<Level>>);

impl<P: Problem> Stretch<'_, P> {
    /// The sign changes on it.
    fn add(&self, out: &mut Vec<Bracket>) {
        let before = out.len();
        for class in 0..self.low.1.levels.len() {
            self.add_class(class, out);
        }
        // where a branch turns back a level vanishes as well: where the slope is that of round-off the level tells the place
        if is_level(self.problem, self.step) && out[before..].iter().all(|found| self.is_fold(found)) {
            return;
        }
        match self.bracket(Test::Slope) {
            Some(bracket) => out.push(bracket),
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

    fn add_class(&self, class: usize, out: &mut Vec<Bracket>) {
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
        let before = out.len();
        out.extend(tests.iter().filter_map(|&test| self.bracket(test)).filter(clear));
        let orbits = self.problem.time().is_some();
        for smooth in Smooth::all(orbits) {
            if out.len() > before {
                return;
            }
            let of = |levels: &Vec<Level>| smooth.value(levels, orbits);
            self.twice(&|_, levels| levels.get(class).map_or((1.0, f64::NAN), of), &tests, out);
        }
    }

    /// The error of levels; the slope has none that is known.
    fn noise(&self) -> f64 {
        self.problem.noise(&self.low.1.levels).max(self.problem.noise(&self.high.1.levels))
    }

    /// The solution at a length; nothing where there is none.
    fn seen(&self, s: f64) -> Option<Seen> {
        let known = self.seen.borrow().iter().find(|one| one.0 == s).map(|one| one.1.clone());
        known.unwrap_or_else(|| {
            let place = between(self.problem, self.step, s, self.watch).ok();
            let found = place.map(|place| (place.slope(), place.levels));
            self.seen.borrow_mut().push((s, found.clone()));
            found
        })
    }

    /// Tests that have the same signs at both ends and others between: where `value`, which vanishes with them, seems to change its sign
    /// twice.
    fn twice(&self, value: &Value<'_>, tests: &[Test], out: &mut Vec<Bracket>) {
        let of = |place: &Place<P::Local>| value(place.slope(), &place.levels);
        let unit = of(self.low.1);
        let relative = |number: Number| number.0 * unit.0 * libm::exp(number.1 - unit.1);
        let noise = self.noise();
        let mut found = Vec::new();
        let mut look = |s: f64| {
            let (slope, levels) = self.seen(s)?;
            for &test in tests {
                let [low, high] = [self.low, self.high].map(|(s, place)| (s, test.of(place)));
                let middle = (s, test.read(slope, &levels));
                let least = if test == Test::Slope {
                    0.0
                } else {
                    noise.max(TOUCHES * low.1.abs().min(high.1.abs()))
                };
                let sure = middle.1.abs() > least && low.1.abs() > noise;
                if sure && low.1 * high.1 > 0.0 && middle.1 * low.1 < 0.0 {
                    found.push(Bracket { test, low, high: middle });
                    found.push(Bracket { test, low: middle, high });
                }
            }
            Some(if found.is_empty() { Look::Value(relative(value(slope, &levels))) } else { Look::Beyond })
        };
        let middle = 0.5 * (self.low.0 + self.high.0);
        let before = self.step.before.filter(|_| self.low.0 == 0.0).map(|before| {
            let slope = before.tangent.last().copied().unwrap_or(f64::NAN);
            (-before.length, relative(value(slope, &before.levels)))
        });
        // beyond a special point the function has the other sign, and says nothing about its course here; near an end of the step the
        // vertex of a parabola from one step to the next may lie outside
        let near = self.near_end(tests);
        let third = before.filter(|third| third.1 > 0.0 && near.is_none()).or_else(|| {
            let s = near.unwrap_or(middle);
            match look(s) {
                Some(Look::Value(value)) => Some((s, value)),
                _ => None,
            }
        });
        if let Some(third) = third {
            let ends = [(self.low.0, 1.0), (self.high.0, relative(of(self.high.1)))];
            dip(ends, third, &mut look);
        }
        out.append(&mut found);
    }
}

/// A test that falls below this part of its value over a step may change its sign twice before the end; it is looked at this part of the
/// way.
const FALLS: f64 = 0.5;
const LATE: f64 = 0.9;

impl<P: Problem> Stretch<'_, P> {
    /// A place near an end at which a test may be beyond a sign change, and back at the end: where it would vanish if it went on as on the
    /// step before, or late on a step over which it falls.
    fn near_end(&self, tests: &[Test]) -> Option<f64> {
        let length = self.high.0 - self.low.0;
        let early = |&test: &Test| {
            let before = self.step.before.filter(|_| self.low.0 == 0.0)?;
            let (was, low, high) = (test.before(before), test.of(self.low.1), test.of(self.high.1));
            let s = before.length * low / (was - low);
            (was * low > 0.0 && low * high > 0.0 && s > 0.0 && s < length).then_some(s)
        };
        let falls = |test: &Test| {
            let (low, high) = (test.of(self.low.1), test.of(self.high.1));
            low * high > 0.0 && high.abs() < FALLS * low.abs()
        };
        let first = tests.iter().filter_map(early).fold(f64::INFINITY, f64::min);
        let late = tests.iter().any(falls).then_some(self.low.0 + LATE * length);
        if first.is_finite() { Some(first) } else { late }
    }
}

/// A function of the slope and of the levels.
type Value<'v> = dyn Fn(f64, &[Vec<Level>]) -> Number + 'v;

fn number(value: f64) -> Number {
    (value.signum(), value.abs().ln())
}

/// Slopes of orbits below so many times the accuracy of the solutions may be noise: towards a connection the parameter converges and the
/// branch goes on.
const LEVEL: f64 = 10.0;

/// Returns `true` if the parameter of orbits hardly changes at an end of a step: a sign of the slope there may be that of round-off.
fn is_level<P: Problem>(problem: &P, step: &Step<'_, P::Local>) -> bool {
    let slope = step.old.slope().abs().min(step.new.slope().abs());
    let width = problem.weights(&step.old.x).last().map_or(f64::NAN, |weight| 1.0 / weight.sqrt());
    problem.time().is_some() && slope < LEVEL * problem.accuracy() * width
}
