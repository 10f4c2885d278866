//! Where tests change their signs twice on a step, come to 0 and back, or fall towards a gap in the branch.

use super::brackets::{Bracket, Signs, Stretch, Test};
use super::correct::{correct, normal, product};
use super::dip::{Look, dip};
use super::levels::{CLEAR, Level};
use super::place::Place;
use super::problem::Problem;
use super::smooth::Number;
use super::steps::SAME;
use super::tracer::TOLERANCE;

/// A level that lies beyond 0 by no more than this part of its values at both ends touches 0: so it does where branches cross at which it
/// is an even function of the length.
const TOUCHES: f64 = 1e-5;

/// A function of the slope and of the levels.
type Value<'v> = dyn Fn(f64, &[Vec<Level>]) -> Number + 'v;

/// The signs of tests between two places where they are the same.
struct Looks<'l, 's, P: Problem> {
    stretch: &'l Stretch<'s, P>,
    tests: &'l [Test],
    found: Vec<Bracket>,
    /// The least value of a level within its error: its length, its test and its size.
    nearest: Option<(f64, Test, f64)>,
    /// No solution was found at a length where one was looked for.
    gap: bool,
}

impl<P: Problem> Looks<'_, '_, P> {
    /// The slope and the levels at a length, where no test has changed its sign.
    fn at(&mut self, s: f64) -> Option<Option<(f64, Vec<Vec<Level>>)>> {
        let stretch = self.stretch;
        let Some((slope, levels, exact)) = stretch.seen(s) else {
            self.gap = true;
            return None;
        };
        for &test in self.tests {
            let [low, high] = [stretch.low, stretch.high].map(|(s, place)| (s, test.of(place)));
            let middle = (s, test.read(slope, &levels));
            if low.1 * high.1 <= 0.0 || low.1.abs() <= stretch.noise() {
                continue;
            }
            let ends = low.1.abs().min(high.1.abs());
            let least = stretch.least(test, (&levels, exact), ends);
            if middle.1.abs() > least && middle.1 * low.1 < 0.0 {
                self.found.push(Bracket { test, low, high: middle });
                self.found.push(Bracket { test, low: middle, high });
            } else if middle.1.abs() <= least
                && ends > CLEAR * stretch.unclear()
                && self.nearest.is_none_or(|one| middle.1.abs() < one.2)
            {
                self.nearest = Some((s, test, middle.1.abs()));
            }
        }
        Some(self.found.is_empty().then_some((slope, levels)))
    }
}

impl<P: Problem> Stretch<'_, P> {
    /// A level below this may have either sign. Where branches cross the solutions are those of singular equations.
    fn least(&self, test: Test, (levels, exact): (&[Vec<Level>], bool), ends: f64) -> f64 {
        let Test::Level(class, rank) = test else { return 0.0 };
        let steady =
            levels.get(class).and_then(|levels| levels.get(rank)).is_some_and(|one| one.angle == 0.0);
        if steady && class == 0 && !exact { self.noise().max(TOUCHES * ends) } else { self.unclear() }
    }

    /// Tests that have the same signs at both ends and others between: where `value`, which vanishes with them, seems to change its sign
    /// twice.
    pub(super) fn twice(&self, value: &Value<'_>, tests: &[Test], out: &mut Signs) {
        let of = |place: &Place<P::Local>| value(place.slope(), &place.levels);
        let unit = of(self.low.1);
        let relative = |number: Number| number.0 * unit.0 * libm::exp(number.1 - unit.1);
        let mut looks = Looks { stretch: self, tests, found: Vec::new(), nearest: None, gap: false };
        let mut look = |s: f64| {
            Some(match looks.at(s)? {
                Some((slope, levels)) => Look::Value(relative(value(slope, &levels))),
                None => Look::Beyond,
            })
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
        let Looks { mut found, nearest, gap, .. } = looks;
        if found.is_empty() {
            out.touches.extend(nearest.map(|(s, test, _)| (s, test)));
            out.gaps.extend(self.smallest(tests).filter(|_| gap && self.step.problem.time().is_none()));
        }
        out.brackets.append(&mut found);
    }

    /// Returns `true` if a place between the ends is on another branch: a real level that keeps the symmetry is smaller there than at both
    /// ends, and along the tangent there the equations lead to other places than the ends. (Of equilibria: see
    /// [`is_near_crossing`](super::tracer::Tracer).)
    pub(super) fn strays(&self, place: &Place<P::Local>) -> bool {
        let levels = [self.low.1, place, self.high.1].map(|place| place.levels.first());
        let [Some(low), Some(here), Some(high)] = levels else { return false };
        let falls = |k: usize| {
            let [a, b, c] =
                [low, here, high].map(|levels| levels.get(k).map_or(f64::NAN, |one| one.growth.abs()));
            here[k].angle == 0.0 && b < a.min(c)
        };
        let is_singular = self.step.problem.time().is_none() && (0..here.len()).any(falls);
        is_singular && [self.low.1, self.high.1].iter().any(|end| self.misses(place, end))
    }

    /// Returns `true` if the solution along the tangent at `place` is another one than `end`.
    fn misses(&self, place: &Place<P::Local>, end: &Place<P::Local>) -> bool {
        let weights = self.step.problem.weights(&place.x);
        let row = normal(&place.tangent, &weights);
        let apart = |x: &[f64]| end.x.iter().zip(x).map(|(a, b)| a - b).collect::<Vec<f64>>();
        let along = product(&weights, &place.tangent, &apart(&place.x));
        let guess = place.x.iter().zip(&place.tangent).map(|(x, t)| x + along * t).collect();
        correct(self.step.problem, guess, &row, TOLERANCE, self.step.watch).is_ok_and(|found| {
            let off = apart(&found.x);
            product(&weights, &off, &off).sqrt() > SAME * TOLERANCE
        })
    }

    /// The level of these that is closest to 0 at the ends.
    fn smallest(&self, tests: &[Test]) -> Option<Test> {
        let size = |test: &Test| test.of(self.low.1).abs().min(test.of(self.high.1).abs());
        let levels = tests.iter().copied().filter(|test| *test != Test::Slope);
        levels.min_by(|a, b| size(a).total_cmp(&size(b)))
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
