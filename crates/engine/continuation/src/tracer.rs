//! Pseudo-arclength continuation with step control, over any equations.

use super::between::{Step, between};
use super::correct::{TIGHT, correct, directions, distance, normal, product, scaled};
use super::families::border_at_start;
use super::levels::{unstable, zeros};
use super::locate::{Changes, locate};
use super::periods::Periods;
use super::place::{Before, Place, place};
use super::point::{End, Motion, Obstruction, Point};
use super::problem::{Failure, Problem};
use super::settings::Settings;
use super::special::Special;
use super::steps::SHORTER;
use motiform_dynamics::Watch;
use std::collections::VecDeque;

/// A growth of fewer errors than this has no sign along a branch.
const NEUTRAL: f64 = 10.0;

/// Newton's method has converged with a step shorter than this, if nothing else is asked for.
pub(super) const TOLERANCE: f64 = 1e-9;

/// Distance, in the units of the unknowns, within which two special points of a branch are one.
const AGAIN: f64 = 1e-7;

/// Part of a step within which a level that touches 0 does so because of a special point.
const NEXT_TO: f64 = 0.1;

/// The next place of a branch, the length of the step to it, and why the branch ends there, where it does.
type Reached<L> = (Place<L>, f64, Option<End>);

/// Where a step leads, its length, and what changes on it.
type Examined<L> = (Place<L>, f64, Changes<L>);

/// The place at which a closed branch is seen to come back: its start, or one of its first points. (Close to where the parameter turns
/// back, a step may pass it on both sides of the turn.)
pub(super) struct First {
    pub(super) parameter: f64,
    pub(super) slope: f64,
    pub(super) motion: Motion,
}

/// One of so many first points takes the place of the start, if the parameter changes so many times as fast there.
const EARLY: usize = 8;
const STEEPER: f64 = 10.0;

impl First {
    fn of<P: Problem>(problem: &P, place: &Place<P::Local>) -> Self {
        let motion = problem.motion(&place.x, &place.local, &place.levels);
        Self { parameter: place.parameter(), slope: place.slope(), motion }
    }
}

/// A branch being followed.
pub(super) struct Tracer<'f, P: Problem> {
    pub(super) watch: &'f dyn Watch,
    pub(super) problem: P,
    pub(super) settings: Settings,
    pub(super) place: Place<P::Local>,
    pub(super) before: Option<Before>,
    pub(super) step: f64,
    pub(super) first: First,
    queue: VecDeque<Point>,
    pub(super) count: usize,
    end: Option<End>,
    pub(super) periods: Periods,
    /// Beside a saddle-focus, the time between the folds of the branch.
    pub(super) half_turn: Option<f64>,
    /// The last special point that was handed out, if it is a fold: its parameter and the error.
    fold: Option<(f64, f64)>,
    /// Special points handed out: unknowns, tangents, names, and the number of points before them.
    passed: Vec<(Vec<f64>, Vec<f64>, &'static str, usize)>,
}

/// Number of levels that are 0 within their error.
pub(super) fn neutral<P: Problem>(problem: &P, place: &Place<P::Local>) -> usize {
    zeros(problem, &place.levels, NEUTRAL)
}

/// A branch being followed, whatever its motions are.
pub(super) trait Follow {
    fn end(&self) -> Option<&End>;
    fn next(&mut self) -> Option<Point>;
}

impl<P: Problem> Follow for Tracer<'_, P> {
    fn end(&self) -> Option<&End> {
        self.end.as_ref().filter(|_| self.queue.is_empty())
    }

    fn next(&mut self) -> Option<Point> {
        if let Some(point) = self.queue.pop_front() {
            self.count += usize::from(point.special.is_none());
            return Some(point);
        }
        if self.end.is_some() {
            return None;
        }
        if self.count >= self.settings.most_points {
            self.end = Some(End::PointLimit);
            return None;
        }
        if self.problem.is_spent() {
            self.end = Some(End::Spent);
            return None;
        }
        if let Err(end) = self.advance() {
            self.end = Some(self.explained(end));
        }
        self.next()
    }
}

impl<'f, P: Problem> Tracer<'f, P> {
    /// From a solution near `x` with the same parameter.
    pub(super) fn start(
        mut problem: P,
        x: Vec<f64>,
        settings: &Settings,
        watch: &'f dyn Watch,
    ) -> Result<Self, Failure> {
        let mut row = vec![0.0; x.len()];
        if let Some(last) = row.last_mut() {
            *last = 1.0;
        }
        border_at_start(&mut problem, &x);
        let found = correct(&problem, x, &row, settings.tolerance, watch)?;
        let weights = problem.weights(&found.x);
        // the side is decided by the parameter; where the branch is vertical, by the sign that the decomposition gives
        let bordered =
            (!problem.family().is_empty()).then(|| scaled(found.direction.clone(), &weights)).flatten();
        let null = || directions(problem.linear(&found.local), &weights).into_iter().next();
        let mut first = bordered.or_else(null).ok_or(Failure::Obstructed(Obstruction::Singular))?;
        let along = first.last().copied().unwrap_or(0.0);
        let side = if along == 0.0 { 1.0 } else { along.signum() } * settings.first_step.signum();
        first.iter_mut().for_each(|value| *value *= side);
        let row = normal(&first, &weights);
        let place = place(&problem, found, &row, 0.0)?;
        Ok(Self::at(problem, place, settings, watch))
    }

    /// From a solution near `origin + length direction`, on to the side of `direction`; Newton's method begins there, with the parameter
    /// changed by the part `lean` of the range. What grows there is small as the square of the length: the solution is as exact as if no
    /// tolerance were asked for.
    pub(super) fn beside(
        problem: P,
        (origin, direction, length): (&[f64], &[f64], f64),
        lean: f64,
        settings: &Settings,
        watch: &'f dyn Watch,
    ) -> Result<Self, (P, Failure)> {
        let weights = problem.weights(origin);
        let row = normal(direction, &weights);
        let mut guess: Vec<f64> = origin.iter().zip(direction).map(|(x, d)| x + length * d).collect();
        if let Some(last) = guess.last_mut() {
            *last += lean * settings.width();
        }
        let found = correct(&problem, guess, &row, settings.tolerance.min(TOLERANCE), watch);
        match found.and_then(|found| place(&problem, found, &row, 0.0)) {
            Ok(place) => Ok(Self::at(problem, place, settings, watch)),
            Err(failure) => Err((problem, failure)),
        }
    }

    fn at(problem: P, place: Place<P::Local>, settings: &Settings, watch: &'f dyn Watch) -> Self {
        let mut tracer = Self {
            first: First::of(&problem, &place),
            settings: Settings { tolerance: settings.tolerance.max(problem.resolution()), ..*settings },
            problem,
            watch,
            place,
            before: None,
            step: settings.first_step.abs().min(settings.largest_step),
            queue: VecDeque::new(),
            count: 0,
            end: None,
            periods: Periods::default(),
            half_turn: None,
            fold: None,
            passed: Vec::new(),
        };
        tracer.find_family();
        tracer.first = First::of(&tracer.problem, &tracer.place);
        let first = tracer.point(&tracer.place, None);
        tracer.queue.push_back(first);
        tracer
    }

    pub(super) fn parameter(&self) -> f64 {
        self.place.parameter()
    }

    pub(super) fn unknowns(&self) -> &[f64] {
        &self.place.x
    }

    /// In how many directions deviations grow at the present place.
    pub(super) fn growing(&self) -> usize {
        unstable(&self.place.levels)
    }

    pub(super) fn into_problem(self) -> P {
        self.problem
    }

    pub(super) const fn problem(&self) -> &P {
        &self.problem
    }

    pub(super) fn problem_mut(&mut self) -> &mut P {
        &mut self.problem
    }

    /// Computes again what belongs to the present place, and the first point: after the problem was changed.
    pub(super) fn renew(&mut self) {
        if let Some(levels) = self.problem.levels(&self.place.x, &self.place.local) {
            self.place.levels = levels;
            self.find_family();
            let first = self.point(&self.place, None);
            self.queue.clear();
            self.queue.push_back(first);
        }
    }

    /// One step: the points of it are in the queue; an error is the end of the branch after them.
    fn advance(&mut self) -> Result<(), End> {
        if self.watch.stopped() {
            return Err(End::Stopped);
        }
        self.refine();
        let ((new, length, mut changes), last) = loop {
            let (new, length, mut last) = self.reach_within()?;
            self.check(&new)?;
            let examined = self.examine(new, length, &mut last)?;
            if self.is_fine(examined.1) || examined.2.found.iter().all(|(at, _)| self.is_within(at)) {
                break (examined, last);
            }
            self.step = SHORTER * examined.1.abs(); // the branch leaves the range on the way
        };
        changes.found.retain(|(at, special)| self.is_within(at) && !self.has_touched(at, *special, length));
        if self.is_family(&self.place) && self.is_family(&new) {
            // the slope is that of round-off: it shows no fold, and no crossing that the step does not pass
            let passed = self.place.arclength..=new.arclength;
            changes.found.retain(|(at, special)| *special != Special::Fold && passed.contains(&at.arclength));
            changes.missed.retain(|seen| *seen != Special::Fold.name());
        }
        if let Some(again) = changes.found.iter().position(|(at, special)| self.has_passed(at, *special)) {
            changes.found.truncate(again);
            self.hand_out_special(changes.found, (&new, length));
            return Err(End::Closed);
        }
        if let Some(end) = self.meets(length, &mut changes) {
            self.hand_out_special(changes.found, (&new, length));
            return Err(end);
        }
        if let Some(end) = self.shrinks(&new, &changes.found) {
            return Err(end);
        }
        self.hand_out((&new, length), changes);
        if self.count <= EARLY && new.slope().abs() > STEEPER * self.first.slope.abs() {
            self.first = First::of(&self.problem, &new);
        }
        let old = std::mem::replace(&mut self.place, new);
        self.before = Some(Before { x: old.x, tangent: old.tangent, levels: old.levels, length });
        self.follow_family();
        last.map_or_else(|| self.ends(), Err)
    }

    /// The next place of the branch, the length of the step, and why the branch ends there, where it does.
    fn reach_within(&mut self) -> Result<Reached<P::Local>, End> {
        loop {
            let (new, length) = self.reach()?;
            let shorter = match self.limit(&new) {
                Ok(None) => return Ok((new, length, None)),
                Ok(Some((nearer, end))) => {
                    let length = nearer.arclength - self.place.arclength;
                    if self.is_fine(length) || self.is_expected(&nearer, length, self.watch) {
                        return Ok((nearer, length, Some(end)));
                    }
                    length // what is found at the edge is of another branch
                }
                Err(End::StepUnderflow { .. }) if !self.is_fine(length) => length, // nothing is found at the edge from here
                Err(end) => return Err(end),
            };
            self.step = SHORTER * shorter.abs();
        }
    }

    /// Returns `true` if the parameter is within the range, or beyond it by no more than its error.
    fn is_within(&self, at: &Place<P::Local>) -> bool {
        let (low, high) = self.settings.range;
        let beyond = self.problem.accuracy().max(TIGHT) * (high - low);
        (low - beyond..=high + beyond).contains(&at.parameter())
    }

    /// The changes on the way to `new`. Where a change cannot be located, shorter steps are tried: a step over a gap between two branches
    /// seems to be one of a branch, while shorter ones fail before it or turn with the branch.
    fn examine(
        &mut self,
        mut new: Place<P::Local>,
        mut length: f64,
        last: &mut Option<End>,
    ) -> Result<Examined<P::Local>, End> {
        let changes = |tracer: &Self, new: &Place<P::Local>, length| {
            locate(&tracer.step_to(new, length)).map_err(|_| End::Stopped)
        };
        let mut found = changes(self, &new, length)?;
        let mut shorter = 0.5 * length;
        while !found.missed.is_empty() && shorter > self.settings.smallest_step {
            if let Ok((nearer, _)) = self.attempt(shorter, self.watch) {
                (new, length, *last) = (nearer, shorter, None);
                found = changes(self, &new, length)?;
            }
            shorter *= 0.5;
        }
        Ok((new, length, found))
    }

    fn step_to<'s>(&'s self, new: &'s Place<P::Local>, length: f64) -> Step<'s, P> {
        let Self { problem, watch, place: old, before, .. } = self;
        Step { problem, watch: *watch, old, new, before: before.as_ref(), length }
    }

    /// Returns `true` if the branch was at a special point before, in the same direction: it is closed. (A step may be as long as a small
    /// loop, and pass its start unseen.)
    fn has_passed(&self, at: &Place<P::Local>, special: Special) -> bool {
        let weights = self.problem.weights(&at.x);
        self.passed.iter().any(|(x, tangent, name, count)| {
            *name == special.name()
                && self.count >= count + 2 // at the end of a step a point may be found twice
                && x.len() == at.x.len()
                && distance(&weights, x, &at.x) < AGAIN
                && product(&weights, tangent, &at.tangent) > 0.0
        })
    }

    /// Returns `true` if a place where a level touches 0 belongs to a special point that was handed out.
    fn has_touched(&self, at: &Place<P::Local>, special: Special, length: f64) -> bool {
        let weights = self.problem.weights(&at.x);
        let near = |x: &[f64]| x.len() == at.x.len() && distance(&weights, x, &at.x) < NEXT_TO * length;
        matches!(special, Special::Touch { .. }) && self.passed.iter().any(|one| near(&one.0))
    }

    /// The special points of a step to `new`, and between two of them a point that is none: it says how many deviations grow there.
    fn hand_out_special(
        &mut self,
        found: Vec<(Place<P::Local>, Special)>,
        (new, length): (&Place<P::Local>, f64),
    ) {
        let mut last = None;
        for (at, special) in found {
            let middle = last
                .filter(|last| at.arclength - last > NEUTRAL * self.problem.accuracy())
                .map(|last: f64| 0.5 * (last + at.arclength) - self.place.arclength)
                .and_then(|s| between(&self.step_to(new, length), s).ok());
            last = Some(at.arclength);
            let special = self.decided(&at, special);
            self.passed.push((at.x.clone(), at.tangent.clone(), special.name(), self.count));
            let points =
                [middle.map(|middle| self.point(&middle, None)), Some(self.point(&at, Some(special)))];
            self.queue.extend(points.into_iter().flatten());
        }
    }

    /// The special point as it is, or undecided: a fold where since the last one the parameter has not changed by more than the errors of
    /// both may be that of round-off.
    fn decided(&mut self, at: &Place<P::Local>, special: Special) -> Special {
        if special != Special::Fold {
            self.fold = None;
            return special;
        }
        let (place, error) = (at.parameter(), at.certificate.map_or(0.0, |shown| shown.error));
        match self.fold.replace((place, error)) {
            Some((from, before)) if (place - from).abs() <= error + before => {
                Special::Unresolved { seen: special.name(), from, to: place }
            }
            _ => special,
        }
    }

    /// The points of a step.
    fn hand_out(&mut self, (new, length): (&Place<P::Local>, f64), changes: Changes<P::Local>) {
        self.hand_out_special(changes.found, (new, length));
        let (from, to) = (self.place.parameter(), new.parameter());
        for seen in changes.missed {
            let point = self.point(new, Some(Special::Unresolved { seen, from, to }));
            self.queue.push_back(point);
        }
        let point = self.point(new, None);
        self.queue.push_back(point);
    }

    /// More unknowns, where an orbit needs them and a solution with them is found.
    fn refine(&mut self) {
        let kept = self.problem.time().map_or(0, |time| self.place.x.len() - time);
        let old: Vec<f64> = self.place.tangent.iter().rev().take(kept).rev().copied().collect();
        let Some(x) = self.problem.refine(&self.place.x, &self.place.local, self.watch) else { return };
        let family = self.problem.family().to_vec();
        if !family.is_empty() {
            border_at_start(&mut self.problem, &x); // with more unknowns
        }
        let mut row = vec![0.0; x.len()];
        let from = row.len() - kept;
        row[from..].copy_from_slice(&old);
        let weights = self.problem.weights(&x);
        let found = scaled(row, &weights).map(|row| normal(&row, &weights)).and_then(|row| {
            let found = correct(&self.problem, x, &row, self.settings.tolerance, self.watch).ok()?;
            place(&self.problem, found, &row, self.place.arclength).ok()
        });
        let Some(place) = found else {
            self.problem.set_family(family);
            return self.problem.coarsen();
        };
        self.place = place;
        self.before = None;
    }
}
