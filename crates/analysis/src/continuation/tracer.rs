//! Pseudo-arclength continuation with step control, over any equations.

use super::correct::{correct, normal, null_vectors, product, scaled};
use super::homoclinic::Periods;
use super::levels::unstable;
use super::locate::locate;
use super::place::{Place, place};
use super::point::{End, Obstruction, Point};
use super::problem::{Failure, Problem};
use super::settings::Settings;
use super::special::Special;
use crate::linear::dot;
use motiform_dynamics::Watch;
use std::collections::VecDeque;

/// Newton's method has converged with a step shorter than this.
pub(super) const TOLERANCE: f64 = 1e-9;

/// Length of the first correction that the step is chosen for: the second is about its square. The first grows with the third power of
/// the step.
const CORRECTION: f64 = 1e-3;

/// Least cosine of the angle between successive tangents.
const STRAIGHT: f64 = 0.9;

/// A branch being followed.
pub(super) struct Tracer<P: Problem> {
    problem: P,
    settings: Settings,
    place: Place<P::Local>,
    /// The place before, and its tangent.
    before: Option<(Vec<f64>, Vec<f64>)>,
    step: f64,
    queue: VecDeque<Point>,
    count: usize,
    end: Option<End>,
    periods: Periods,
}

impl<P: Problem> Tracer<P> {
    /// From a solution near `x` with the same parameter.
    pub(super) fn start(
        problem: P,
        x: Vec<f64>,
        settings: &Settings,
        watch: &dyn Watch,
    ) -> Result<Self, Failure> {
        let mut row = vec![0.0; x.len()];
        if let Some(last) = row.last_mut() {
            *last = 1.0;
        }
        let found = correct(&problem, x, &row, TOLERANCE, watch)?;
        let weights = problem.weights(&found.x);
        // the side is decided by the parameter; where the branch is vertical, by the sign that the decomposition gives
        let null = null_vectors(problem.linear(&found.local), 1.0, &weights);
        let mut first = null.into_iter().next().ok_or(Failure::Obstructed(Obstruction::Singular))?;
        let along = first.last().copied().unwrap_or(0.0);
        let side = if along == 0.0 { 1.0 } else { along.signum() } * settings.first_step.signum();
        first.iter_mut().for_each(|value| *value *= side);
        let row = normal(&first, &weights);
        let place = place(&problem, found, &row, 0.0)?;
        Ok(Self::at(problem, place, settings))
    }

    /// From a solution near `origin + length direction`, on to the side of `direction`.
    pub(super) fn beside(
        problem: P,
        (origin, direction, length): (&[f64], &[f64], f64),
        settings: &Settings,
        watch: &dyn Watch,
    ) -> Result<Self, (P, Failure)> {
        let weights = problem.weights(origin);
        let row = normal(direction, &weights);
        let guess = origin.iter().zip(direction).map(|(x, d)| x + length * d).collect();
        let found = correct(&problem, guess, &row, TOLERANCE, watch);
        match found.and_then(|found| place(&problem, found, &row, 0.0)) {
            Ok(place) => Ok(Self::at(problem, place, settings)),
            Err(failure) => Err((problem, failure)),
        }
    }

    fn at(problem: P, place: Place<P::Local>, settings: &Settings) -> Self {
        let mut tracer = Self {
            problem,
            settings: *settings,
            place,
            before: None,
            step: settings.first_step.abs().min(settings.largest_step),
            queue: VecDeque::new(),
            count: 0,
            end: None,
            periods: Periods::default(),
        };
        let first = tracer.point(&tracer.place, None);
        tracer.queue.push_back(first);
        tracer
    }

    pub(super) fn unknowns(&self) -> &[f64] {
        &self.place.x
    }

    pub(super) fn problem_mut(&mut self) -> &mut P {
        &mut self.problem
    }

    pub(super) fn end(&self) -> Option<&End> {
        self.end.as_ref().filter(|_| self.queue.is_empty())
    }

    /// Computes again what belongs to the present place, and the first point: after the problem was changed.
    pub(super) fn renew(&mut self) {
        if let Some(levels) = self.problem.levels(&self.place.x, &self.place.local) {
            self.place.levels = levels;
            let first = self.point(&self.place, None);
            self.queue.clear();
            self.queue.push_back(first);
        }
    }

    pub(super) fn next(&mut self, watch: &dyn Watch) -> Option<Point> {
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
        if let Err(end) = self.advance(watch) {
            self.end = Some(self.explained(end));
        }
        self.next(watch)
    }

    /// One step: the points of it are in the queue; an error is the end of the branch after them.
    fn advance(&mut self, watch: &dyn Watch) -> Result<(), End> {
        if watch.stopped() {
            return Err(End::Stopped);
        }
        self.refine(watch);
        let (mut new, length) = self.reach(watch)?;
        let (low, high) = self.settings.range;
        let mut length = length;
        let left = !(low..=high).contains(&new.parameter());
        if left {
            let edge = if new.parameter() < low { low } else { high };
            if self.place.parameter() == edge {
                return Err(End::RangeLeft);
            }
            (new, length) = self.edge(&new, edge, watch)?;
        }
        self.check(&new)?;
        let found = locate(&self.problem, &self.place, &new, length, watch);
        if let Some(end) = self.shrinks(&new, &found) {
            return Err(end);
        }
        for (at, special) in found {
            let point = self.point(&at, Some(special));
            self.queue.push_back(point);
        }
        let point = self.point(&new, None);
        self.queue.push_back(point);
        let old = std::mem::replace(&mut self.place, new);
        self.before = Some((old.x, old.tangent));
        if left { Err(End::RangeLeft) } else { self.ends() }
    }

    /// The next solution and the length of the step to it.
    fn reach(&mut self, watch: &dyn Watch) -> Result<(Place<P::Local>, f64), End> {
        loop {
            let length = self.step;
            let why = match self.attempt(length, watch) {
                Ok((place, first)) => {
                    let factor = libm::cbrt(CORRECTION / first.max(1e-12)).clamp(0.4, 1.5);
                    self.step =
                        (length * factor).clamp(self.settings.smallest_step, self.settings.largest_step);
                    return Ok((place, length));
                }
                Err(Failure::Stopped) => return Err(End::Stopped),
                Err(Failure::Obstructed(why)) => why,
            };
            self.step = 0.4 * length;
            if self.step < self.settings.smallest_step {
                return Err(End::StepUnderflow { step: length, why });
            }
        }
    }

    fn attempt(&self, length: f64, watch: &dyn Watch) -> Result<(Place<P::Local>, f64), Failure> {
        let old = &self.place;
        let weights = self.problem.weights(&old.x);
        let row = normal(&old.tangent, &weights);
        let guess = self.guess(length, &weights);
        let found = correct(&self.problem, guess, &row, TOLERANCE, watch)?;
        let first = found.first;
        let new = place(&self.problem, found, &row, old.arclength + length)?;
        if product(&weights, &old.tangent, &new.tangent) < STRAIGHT {
            return Err(Failure::Obstructed(Obstruction::Newton));
        }
        Ok((new, first))
    }

    /// The place expected after `length`: the tangent turns on as it did on the last step. (A cubic through the last two places would
    /// be closer, but Newton's steps leave what it says along the neutral directions as it is, and its errors there would grow.)
    fn guess(&self, length: f64, weights: &[f64]) -> Vec<f64> {
        let Place { x, tangent, .. } = &self.place;
        let mut guess: Vec<f64> = x.iter().zip(tangent).map(|(x, t)| x + length * t).collect();
        if let Some((before, slope)) = &self.before {
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
    fn edge(
        &self,
        beyond: &Place<P::Local>,
        edge: f64,
        watch: &dyn Watch,
    ) -> Result<(Place<P::Local>, f64), End> {
        let old = &self.place;
        let part = (edge - old.parameter()) / (beyond.parameter() - old.parameter());
        let mut guess: Vec<f64> = old.x.iter().zip(&beyond.x).map(|(a, b)| a + part * (b - a)).collect();
        let mut row = vec![0.0; guess.len()];
        if let (Some(last), Some(one)) = (guess.last_mut(), row.last_mut()) {
            (*last, *one) = (edge, 1.0);
        }
        let weights = self.problem.weights(&old.x);
        let side = normal(&old.tangent, &weights);
        let found = correct(&self.problem, guess, &row, TOLERANCE, watch)
            .and_then(|found| place(&self.problem, found, &side, 0.0));
        let mut new = found.map_err(|failure| match failure {
            Failure::Stopped => End::Stopped,
            Failure::Obstructed(why) => End::StepUnderflow { step: self.step, why },
        })?;
        if let Some(last) = new.x.last_mut() {
            *last = edge;
        }
        let moved: Vec<f64> = new.x.iter().zip(&old.x).map(|(a, b)| a - b).collect();
        let length = product(&weights, &old.tangent, &moved);
        new.arclength = old.arclength + length;
        Ok((new, length))
    }

    fn check(&self, new: &Place<P::Local>) -> Result<(), End> {
        let size = self.problem.size(&new.x);
        if size > self.settings.largest_size { Err(End::BlowUp { size }) } else { Ok(()) }
    }

    /// The reason behind the end of the computation, where the growth of the period says more.
    fn explained(&self, end: End) -> End {
        if !matches!(end, End::StepUnderflow { .. } | End::PeriodLimit { .. }) {
            return end;
        }
        let saddle = || self.problem.saddle(&self.place.x, &self.place.local);
        self.periods.resonance().map_or(end, |found| End::Homoclinic(Box::new(found.through(saddle()))))
    }

    /// Whether the orbits shrink to an equilibrium before `new`. The parameter has an extreme value there, as at a fold.
    fn shrinks(&self, new: &Place<P::Local>, found: &[(Place<P::Local>, Special)]) -> Option<End> {
        let (before, now) = (self.problem.swing(&self.place.local)?, self.problem.swing(&new.local)?);
        if dot(&before, &now) >= 0.0 {
            return None;
        }
        let at = found.iter().find(|(_, special)| *special == Special::Fold).map_or(new, |(at, _)| at);
        let time = self.problem.time()?;
        Some(End::Shrinks { parameter: at.parameter(), time: at.x[time] })
    }

    /// Whether the branch of orbits ends at the present place.
    fn ends(&mut self) -> Result<(), End> {
        let Some(time) = self.problem.time().map(|place| (self.place.x[place], self.place.tangent[place]))
        else {
            return Ok(());
        };
        let parameter = self.place.parameter();
        self.periods.push(time, (parameter, self.place.slope()));
        if let Some(connection) = self.periods.connection() {
            let saddle = self.problem.saddle(&self.place.x, &self.place.local);
            return Err(End::Homoclinic(Box::new(connection.through(saddle))));
        }
        if time.0 > self.settings.longest_time {
            return Err(End::PeriodLimit { time: time.0 });
        }
        Ok(())
    }

    /// More unknowns, where an orbit needs them.
    fn refine(&mut self, watch: &dyn Watch) {
        let kept = self.problem.time().map_or(0, |time| self.place.x.len() - time);
        let old: Vec<f64> = self.place.tangent.iter().rev().take(kept).rev().copied().collect();
        let Some(x) = self.problem.refine(&self.place.x, &self.place.local, watch) else { return };
        let mut row = vec![0.0; x.len()];
        let from = row.len() - kept;
        row[from..].copy_from_slice(&old);
        let weights = self.problem.weights(&x);
        let Some(row) = scaled(row, &weights).map(|row| normal(&row, &weights)) else { return };
        if let Ok(found) = correct(&self.problem, x, &row, TOLERANCE, watch)
            && let Ok(place) = place(&self.problem, found, &row, self.place.arclength)
        {
            self.place = place;
            self.before = None;
        }
    }

    fn point(&self, place: &Place<P::Local>, special: Option<Special>) -> Point {
        let grown = place.levels.iter().flatten().filter(|level| level.growth > 1e-7).count();
        Point {
            parameter: place.parameter(),
            arclength: place.arclength,
            motion: self.problem.motion(&place.x, &place.local, &place.levels),
            unstable: if special.is_some() { grown } else { unstable(&place.levels) },
            slope: place.slope(),
            special,
        }
    }
}
