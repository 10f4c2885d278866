//! Steps along a branch.

use super::between::ASTRAY;
use super::correct::{correct, normal, product};
use super::families::holds;
use super::levels::Level;
use super::place::{Before, Place, place};
use super::point::{End, Obstruction};
use super::problem::{Failure, Problem};
use super::settings::Settings;
use super::tracer::{Tracer, neutral};
use motiform_dynamics::Watch;
use motiform_dynamics::sample::ascending;

/// Length of the first correction that the step is chosen for: the second is about its square. The first grows with the third power of
/// the step.
const CORRECTION: f64 = 1e-3;

/// Part of the largest of some levels by which the next one may differ from what they let expect, however small it is.
const EXPECTED: f64 = 0.1;

/// Part of the largest level below which a growth is as good as 0. Where all levels are below this part of the rate of the equations the
/// motion is far from where their units were taken, and what happens there is shorter than a step.
pub(super) const SLOW: f64 = 1e-5;

/// Part of the size of levels below which a real one says that another branch may be near.
const NEAR: f64 = 0.1;

/// Solutions that differ by more than this, in tolerances of Newton's method, are of different branches.
pub(super) const SAME: f64 = 30.0;

/// Ratios of two sizes that are about the same.
const ABOUT: std::ops::RangeInclusive<f64> = 0.3..=3.0;

/// Steps as short as this, in shortest ones, are taken as they are.
pub(super) const FINE: f64 = 100.0;

/// A step that fails is tried again with this part of its length. No power of 1.5 times a power of it is 1, so that growing and
/// shrinking steps do not come back to the same place.
pub(super) const SHORTER: f64 = 0.35;

/// Steps from one fold to the next one beside a saddle-focus.
const PER_FOLD: f64 = 4.0;

/// Least cosine of the angle between successive tangents.
pub(super) const STRAIGHT: f64 = 0.9;

/// The step after one of this length whose first correction had this one.
pub(super) fn next_step(length: f64, first: f64, settings: &Settings) -> f64 {
    let factor = libm::cbrt(CORRECTION / first.max(1e-12)).clamp(SHORTER, 1.5);
    (length * factor).clamp(settings.smallest_step, settings.largest_step)
}

impl<P: Problem> Tracer<'_, P> {
    /// The next solution and the length of the step to it.
    pub(super) fn reach(&mut self) -> Result<(Place<P::Local>, f64), End> {
        loop {
            self.step = self.step.min(self.longest()).max(self.settings.smallest_step);
            let length = self.step;
            let why = match self.attempt(length, self.watch) {
                Ok((place, first)) => {
                    self.step = next_step(length, first, &self.settings);
                    return Ok((place, length));
                }
                Err(Failure::Stopped) => return Err(End::Stopped),
                Err(Failure::Obstructed(why)) => why,
            };
            self.step = SHORTER * length;
            if self.step < self.settings.smallest_step {
                let why = if neutral(&self.problem, &self.place) > 0 { Obstruction::Singular } else { why };
                return Err(End::StepUnderflow { step: length, why });
            }
        }
    }

    /// The longest step over which the folds of a branch beside a saddle-focus are seen.
    fn longest(&self) -> f64 {
        let Some((time, half_turn)) = self.problem.time().zip(self.half_turn) else { return f64::INFINITY };
        half_turn / (PER_FOLD * self.place.tangent[time].abs())
    }

    pub(super) fn attempt(&self, length: f64, watch: &dyn Watch) -> Result<(Place<P::Local>, f64), Failure> {
        let (mut new, first) = self.solve(length, watch)?;
        self.keep_unclear_signs(&mut new);
        let weights = self.problem.weights(&self.place.x);
        let turned = product(&weights, &self.place.tangent, &new.tangent);
        if turned >= STRAIGHT
            && (self.is_fine(length)
                || self.is_expected(&new, length, watch)
                    && (!self.is_near_crossing(&new) || self.leads_back(&new, length, watch)))
        {
            return Ok((new, first));
        }
        Err(Failure::Obstructed(Obstruction::Newton))
    }

    /// Returns `true` for a step so short that it is taken as it is.
    pub(super) fn is_fine(&self, length: f64) -> bool {
        length.abs() <= FINE * self.settings.smallest_step
    }

    /// The solution expected after `length`, and the length of the first correction.
    fn solve(&self, length: f64, watch: &dyn Watch) -> Result<(Place<P::Local>, f64), Failure> {
        let old = &self.place;
        let weights = self.problem.weights(&old.x);
        let row = normal(&old.tangent, &weights);
        let guess = self.guess(length, &weights);
        let found = correct(&self.problem, guess, &row, self.settings.tolerance, watch)?;
        let first = found.first;
        if first > ASTRAY * length || !holds(&self.problem, &found, self.settings.tolerance) {
            return Err(Failure::Obstructed(Obstruction::Newton));
        }
        Ok((place(&self.problem, found, &row, old.arclength + length)?, first))
    }

    /// Returns `true` if the growths at `new` are about those that the last two places let expect, or so large that their signs are not in
    /// doubt; elsewhere if those in the middle are about those of a parabola. Then a step is short against the distances over which the
    /// equations change, whatever the width of the range. (Of equilibria.)
    pub(super) fn is_expected(&self, new: &Place<P::Local>, length: f64, watch: &dyn Watch) -> bool {
        let Some(before) = self.before.as_ref().filter(|_| self.problem.time().is_none()) else {
            return true;
        };
        let [before, old, new] =
            [(-before.length, &before.levels), (0.0, &self.place.levels), (length, &new.levels)];
        let alike = |a: &[Vec<Level>], b: &[Vec<Level>]| a.iter().map(Vec::len).eq(b.iter().map(Vec::len));
        if alike(before.1, old.1) && !alike(old.1, new.1) {
            return false; // a motion of another symmetry
        }
        let (half, largest) = (0.5 * length, self.largest());
        let unclear = self.problem.unclear(new.1, self.settings.tolerance).max(SLOW * largest);
        let middle = || self.solve(half, watch).map(|(middle, _)| middle.levels);
        follows(&[before, old], new, unclear)
            || largest > SLOW * self.problem.rate()
                && middle().is_ok_and(|middle| follows(&[before, old, new], (half, &middle), unclear))
    }

    /// The largest level at the last two places.
    fn largest(&self) -> f64 {
        let before = self.before.iter().flat_map(|before| &before.levels);
        let levels = before.chain(&self.place.levels).flatten();
        levels.fold(0.0, |most, level| level.growth.hypot(level.angle).max(most))
    }

    /// Gives growths within their error the signs that they have at the present place: they change where they are clear again. (Towards a
    /// motion of more symmetry growths vanish as powers of the distance, and have the same signs beyond.)
    fn keep_unclear_signs(&self, new: &mut Place<P::Local>) {
        // those of orbits are levels of the last but one solution of Newton's method
        let noise = self.problem.unclear(&new.levels, self.settings.tolerance);
        // the rate of the equations may have been far larger where a branch of equilibria began
        let known = if self.problem.time().is_some() { f64::INFINITY } else { SLOW * self.largest() };
        let noise = noise.min(known);
        for (levels, old) in new.levels.iter_mut().zip(&self.place.levels) {
            if levels.len() == old.len() {
                let unclear = levels.iter_mut().zip(old).filter(|(level, _)| level.growth.abs() <= noise);
                unclear.for_each(|(level, old)| level.growth = level.growth.abs().copysign(old.growth));
            }
        }
    }

    /// Returns `true` if a real level of deviations that keep the symmetry is so small that another branch may be near. (Of equilibria:
    /// long orbits are not known well enough for the step back.)
    fn is_near_crossing(&self, new: &Place<P::Local>) -> bool {
        if self.problem.time().is_some() {
            return false;
        }
        let near = |place: &Place<P::Local>| {
            let Some(levels) = place.levels.first() else { return false };
            let mut sizes: Vec<f64> =
                levels.iter().map(|level| libm::hypot(level.growth, level.angle)).collect();
            ascending(&mut sizes);
            let typical = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
            levels.iter().any(|level| level.angle == 0.0 && level.growth.abs() < NEAR * typical)
        };
        near(&self.place) || near(new)
    }

    /// Returns `true` if the step back from `new` finds the present place, however it is guessed. Where branches cross at a small angle, a
    /// step may lead from one to the other, whose directions are the same to within the correction of a step; the step back then stays on
    /// the other one. Where the branches are closer than the bend of the step, the guess that has it may find the present place from
    /// either, and the one along the tangent alone decides.
    fn leads_back(&self, new: &Place<P::Local>, length: f64, watch: &dyn Watch) -> bool {
        self.finds_back(new, 0.5 * length, watch)
            && (!self.rebounds(new, length) || self.finds_back(new, 0.0, watch))
    }

    /// The same from the tangent at `new`, with this much of its turn on the step.
    fn finds_back(&self, new: &Place<P::Local>, bend: f64, watch: &dyn Watch) -> bool {
        let old = &self.place;
        let weights = self.problem.weights(&old.x);
        let row = normal(&new.tangent, &weights);
        let turned = product(&weights, &old.tangent, &new.tangent);
        let mut guess: Vec<f64> = new
            .x
            .iter()
            .zip(new.tangent.iter().zip(&old.tangent))
            .map(|(x, (t, before))| x + bend * (t - before / turned))
            .collect();
        let apart = |x: &[f64]| old.x.iter().zip(x).map(|(a, b)| a - b).collect::<Vec<f64>>();
        // the length of the tangent is 1 in the units of its own place
        let along =
            product(&weights, &new.tangent, &apart(&guess)) / product(&weights, &new.tangent, &new.tangent);
        guess.iter_mut().zip(&new.tangent).for_each(|(x, t)| *x += along * t);
        match correct(&self.problem, guess, &row, self.settings.tolerance, watch) {
            Ok(found) => {
                let off = apart(&found.x);
                product(&weights, &off, &off).sqrt() <= SAME * self.settings.tolerance
            }
            Err(_) => true,
        }
    }

    /// Returns `true` if a real level that keeps the symmetry has the sign at `new` that it has at the present place, and about the size
    /// with which it would be beyond 0 if it went on as on the step before: two branches that cross have levels of opposite signs.
    fn rebounds(&self, new: &Place<P::Local>, length: f64) -> bool {
        let Some(before) = &self.before else { return false };
        let first = |levels: &'_ [Vec<Level>]| levels.first().cloned().unwrap_or_default();
        let all = [&before.levels, &self.place.levels, &new.levels].map(|levels| first(levels));
        let [was, now, then] = &all;
        let real = |rank: usize| all.iter().all(|levels| levels[rank].angle == 0.0);
        let turns = |rank: usize| {
            let [was, now, then] = [was, now, then].map(|levels| levels[rank].growth);
            let expected = now + (now - was) * length / before.length;
            now * then > 0.0 && ABOUT.contains(&(-expected / then))
        };
        was.len() == now.len()
            && now.len() == then.len()
            && (0..now.len()).any(|rank| real(rank) && turns(rank))
    }

    /// The place expected after `length`: the tangent turns on as it did on the last step. (A cubic through the last two places would
    /// be closer, but Newton's steps leave what it says along the neutral directions as it is, and its errors there would grow.)
    fn guess(&self, length: f64, weights: &[f64]) -> Vec<f64> {
        let Place { x, tangent, .. } = &self.place;
        let mut guess: Vec<f64> = x.iter().zip(tangent).map(|(x, t)| x + length * t).collect();
        if let Some(Before { x: before, tangent: slope, .. }) = &self.before {
            let moved: Vec<f64> = x.iter().zip(before).map(|(a, b)| a - b).collect();
            let (gone, turned) = (product(weights, tangent, &moved), product(weights, tangent, slope));
            if length < 2.0 * gone && turned > STRAIGHT {
                let bend = 0.5 * length * length / gone;
                for (i, value) in guess.iter_mut().enumerate() {
                    *value += bend * (tangent[i] - slope[i] / turned);
                }
            }
        }
        guess
    }

    /// The solution between the present one and `beyond` whose parameter is `edge`.
    pub(super) fn edge(&self, beyond: &Place<P::Local>, edge: f64) -> Result<Place<P::Local>, End> {
        let old = &self.place;
        let part = (edge - old.parameter()) / (beyond.parameter() - old.parameter());
        let mut guess: Vec<f64> = old.x.iter().zip(&beyond.x).map(|(a, b)| a + part * (b - a)).collect();
        let mut row = vec![0.0; guess.len()];
        if let (Some(last), Some(one)) = (guess.last_mut(), row.last_mut()) {
            (*last, *one) = (edge, 1.0);
        }
        let weights = self.problem.weights(&old.x);
        let side = normal(&old.tangent, &weights);
        let found = correct(&self.problem, guess, &row, self.settings.tolerance, self.watch)
            .and_then(|found| place(&self.problem, found, &side, 0.0));
        let mut new = found.map_err(|failure| match failure {
            Failure::Stopped => End::Stopped,
            Failure::Obstructed(why) => End::StepUnderflow { step: self.step, why },
        })?;
        if let Some(last) = new.x.last_mut() {
            *last = edge;
        }
        let moved: Vec<f64> = new.x.iter().zip(&old.x).map(|(a, b)| a - b).collect();
        new.arclength = old.arclength + product(&weights, &old.tangent, &moved);
        self.keep_unclear_signs(&mut new);
        Ok(new)
    }
}

/// Growths at a length along the branch, by class and rank.
type Course<'l> = (f64, &'l Vec<Vec<Level>>);

/// Returns `true` if growths are about those of the polynomials through the others; those that pass each other change their ranks.
pub(super) fn follows(others: &[Course<'_>], (s, levels): Course<'_>, unclear: f64) -> bool {
    let part = |t: f64| -> f64 {
        others.iter().filter(|one| one.0 != t).map(|one| (s - one.0) / (t - one.0)).product()
    };
    levels.iter().enumerate().all(|(class, levels)| {
        if others.iter().any(|(_, other)| other.get(class).map_or(0, Vec::len) != levels.len()) {
            return true;
        }
        let along = |rank: usize| others.iter().map(move |(t, other)| (*t, other[class][rank].growth));
        let mut expected: Vec<f64> =
            (0..levels.len()).map(|rank| along(rank).map(|(t, growth)| part(t) * growth).sum()).collect();
        ascending(&mut expected);
        levels.iter().zip(expected.iter().rev()).enumerate().all(|(rank, (level, expected))| {
            let largest = along(rank).fold(0.0, |most: f64, (_, growth)| growth.abs().max(most));
            (expected - level.growth).abs() <= level.growth.abs().max(EXPECTED * largest) + unclear
        })
    })
}
