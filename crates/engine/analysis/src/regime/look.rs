//! A stretch of an orbit, watched: its extremes in size, its rests, its end.

use super::far::Far;
use crate::linear::norm;
use crate::periodic::is_small;
use crate::symmetry::{Gauge, align, reduced_speed};
use motiform_dynamics::drive::Run;
use motiform_dynamics::section::Crossing;
use motiform_dynamics::{Direction, Equivariant, Integration, Outcome, Request, Section, Sink, Watch};
use std::ops::ControlFlow;

/// An extreme of the shape's size ([`Gauge`]): where a reduced orbit meets the section that it is watched on.
#[derive(Clone, Debug)]
pub(super) struct Extreme {
    pub(super) t: f64,
    pub(super) minimum: bool,
    pub(super) size: f64,
    pub(super) shape: Vec<f64>,
}

/// A stretch in which the reduced shape hardly changes.
#[derive(Clone, Debug)]
pub(super) struct Rest {
    pub(super) start: f64,
    pub(super) end: f64,
    /// The shape where it was slowest.
    pub(super) shape: Vec<f64>,
    /// `true` if its beginning and its end were seen.
    pub(super) whole: bool,
}

impl Rest {
    /// Its duration, at least.
    pub(super) fn duration(&self) -> f64 {
        self.end - self.start
    }
}

/// A look: the observation of an orbit over a span of time.
#[derive(Debug)]
pub(super) struct Look {
    pub(super) start: f64,
    pub(super) end: f64,
    pub(super) outcome: Outcome,
    /// Alternating minima and maxima of the size; flutter below the resolution is left out.
    pub(super) extremes: Vec<Extreme>,
    /// Complete rests.
    pub(super) rests: Vec<Rest>,
    /// The time when the rest began that the look ended in; `None` where it began before, or there is none.
    pub(super) resting: Option<f64>,
    /// Reduced speed: fastest in this look, and at its end.
    pub(super) fastest: f64,
    pub(super) last_speed: f64,
    /// Smallest and largest `|u|`.
    pub(super) sizes: (f64, f64),
    /// The shape where the reduced shape changed most slowly.
    pub(super) slowest: Vec<f64>,
    /// The shape at its end.
    pub(super) last: Vec<f64>,
}

/// A reduced shape that changes slower than this, against its fastest, rests.
pub(super) const RESTS: f64 = 0.01;

/// Most extremes that are kept, the latest.
const KEPT: usize = 4096;

/// The test that a look may end, by what it has seen so far and the shape.
pub(super) type Ends<'e> = dyn FnMut(&Seen, &[f64]) -> bool + 'e;

/// The first pause of a look from `start` to `end` after `t`, to ask whether the orbit has arrived at an
/// equilibrium: with the first step that reaches one of its quarters; infinite for none. The look of a large
/// system does not pause.
pub(super) fn pause(dim: usize, (start, end): (f64, f64), t: f64) -> f64 {
    let quarter = 0.25 * (end - start);
    let pauses = [1.0, 2.0, 3.0].map(|count| start + count * quarter);
    pauses.into_iter().find(|&pause| is_small(dim) && pause > t).unwrap_or(f64::INFINITY)
}

impl Look {
    /// Follows `orbit` for `time`.
    ///
    /// In a large system extremes are looked for at the ends of steps only: its steps are those of its fast modes, a hundredth of the
    /// time between extremes, and eight points of each would take more evaluations of the field than the step.
    pub(super) fn take(
        body: &dyn Equivariant,
        orbit: &mut dyn Integration,
        time: f64,
        request: &Request<'_>,
        watch: &dyn Watch,
    ) -> Result<Self, motiform_dynamics::Error> {
        Self::take_until(body, orbit, time, None, request, watch)
    }

    /// As [`Look::take`]; it ends at a [`pause`] if `ends` says so of what was seen and of the shape. Steps
    /// are those of a look without pauses.
    pub(super) fn take_until(
        body: &dyn Equivariant,
        orbit: &mut dyn Integration,
        time: f64,
        mut ends: Option<&mut Ends<'_>>,
        request: &Request<'_>,
        watch: &dyn Watch,
    ) -> Result<Self, motiform_dynamics::Error> {
        let (start, end) = (orbit.t(), orbit.t() + time);
        let gauge = Gauge::of(body);
        let rate = |_t: f64, u: &[f64]| gauge.rate(body, u);
        let sections = [Section { g: &rate, direction: Direction::Either, terminal: false }];
        let pieces = if is_small(body.dim()) { request.pieces } else { 1 };
        let request = Request { t_end: end, sections: &sections, pieces, watch, ..*request };
        let mut watcher = Watcher { body, gauge: &gauge, seen: Seen::new(orbit.state()) };
        let mut run = Run::new(orbit, &request, &mut watcher)?;
        let mut next = pause(body.dim(), (start, end), start);
        let mut far = Far::new(&request, time);
        let outcome = loop {
            if let ControlFlow::Break(outcome) = run.step(orbit, &request, &mut watcher) {
                break outcome;
            }
            if let Some(outcome) = far.leaves(body, orbit, &request) {
                break outcome;
            }
            let t = orbit.t();
            if t < next || t >= end {
                continue;
            }
            if ends.as_mut().is_some_and(|ends| ends(&watcher.seen, orbit.state())) {
                break Outcome::Completed { t };
            }
            next = pause(body.dim(), (start, end), t);
        };
        let Watcher { seen, .. } = watcher;
        Ok(seen.look((start, orbit.t()), outcome, orbit.state().to_vec()))
    }

    /// Returns `true` if the norm of the shape and its [`Gauge`] stayed the same, up to the part `hovering`
    /// of its size: the orbit was at an equilibrium all the time. (Without symmetry the norm alone may be
    /// constant on an orbit.)
    pub(super) fn is_still(&self, hovering: f64) -> bool {
        let least = hovering * self.sizes.1;
        let low = self.extremes.iter().map(|extreme| extreme.size).fold(f64::INFINITY, f64::min);
        let high = self.extremes.iter().map(|extreme| extreme.size).fold(f64::NEG_INFINITY, f64::max);
        self.sizes.1 - self.sizes.0 <= least && high - low <= least // without extremes minus infinity
    }

    /// The minima of the size.
    pub(super) fn minima(&self) -> Vec<&Extreme> {
        self.extremes.iter().filter(|extreme| extreme.minimum).collect()
    }

    /// The largest distance between reduced shapes that the look met, from the last extreme to the earlier ones.
    pub(super) fn diameter(&self, body: &dyn Equivariant) -> f64 {
        let Some(last) = self.extremes.last() else { return 0.0 };
        let others = self.extremes.iter().rev().skip(1).take(40);
        others.map(|other| align(body, &last.shape, &other.shape, false).distance).fold(0.0, f64::max)
    }
}

/// Extremes that differ from their neighbours by more than `flutter`, alternating.
fn significant(extremes: Vec<Extreme>, flutter: f64) -> Vec<Extreme> {
    let mut kept: Vec<Extreme> = Vec::with_capacity(extremes.len());
    for extreme in extremes {
        match kept.last() {
            Some(last) if last.minimum == extreme.minimum => {
                let better =
                    if extreme.minimum { extreme.size < last.size } else { extreme.size > last.size };
                if better {
                    kept.pop();
                    kept.push(extreme);
                }
            }
            Some(last) if (last.size - extreme.size).abs() <= flutter => {}
            _ => kept.push(extreme),
        }
    }
    kept
}

/// The observations of a look so far.
#[derive(Clone, Debug)]
pub(super) struct Seen {
    extremes: Vec<Extreme>,
    rests: Vec<Rest>,
    /// The rest under way; its start is not known where the look began in it.
    rest: Option<(Option<f64>, Vec<f64>, f64)>,
    /// Reduced speed: fastest so far, and now.
    pub(super) fastest: f64,
    pub(super) last_speed: f64,
    /// Smallest and largest `|u|`.
    pub(super) sizes: (f64, f64),
    /// The slowest reduced speed, and the shape there.
    pub(super) slowest: (f64, Vec<f64>),
}

impl Seen {
    /// Nothing but the start.
    pub(super) fn new(shape: &[f64]) -> Self {
        let size = norm(shape);
        Self {
            extremes: Vec::new(),
            rests: Vec::new(),
            rest: None,
            fastest: 0.0,
            last_speed: 0.0,
            sizes: (size, size),
            slowest: (f64::INFINITY, shape.to_vec()),
        }
    }

    /// An extreme; the oldest ones are forgotten.
    pub(super) fn extreme(&mut self, extreme: Extreme) {
        if self.extremes.len() >= 2 * KEPT {
            self.extremes.drain(..KEPT);
        }
        self.extremes.push(extreme);
    }

    /// Returns `true` if a rest is under way.
    pub(super) fn resting(&self) -> bool {
        self.rest.is_some()
    }

    /// The reduced speed at the end of a step, and the fastest so far: begins, follows and ends rests.
    pub(super) fn rests(&mut self, t: f64, u: &[f64], speed: f64, fastest: f64) {
        if speed < RESTS * fastest {
            let started = (!self.rests.is_empty() || fastest > 0.0).then_some(t);
            let rest = self.rest.get_or_insert_with(|| (started, u.to_vec(), speed));
            if speed < rest.2 {
                rest.1.copy_from_slice(u);
                rest.2 = speed;
            }
        } else if let Some((start, shape, _)) = self.rest.take()
            && let Some(start) = start
        {
            self.rests.push(Rest { start, end: t, shape, whole: true });
        }
    }

    /// All of it as a look over a span that ended like this, at the shape `last`.
    pub(super) fn look(self, (start, end): (f64, f64), outcome: Outcome, last: Vec<f64>) -> Look {
        let (low, high) = self
            .extremes
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (x.size.min(low), x.size.max(high)));
        let flutter = 1e-7 * (high - low) + 1e-12 * self.sizes.1;
        Look {
            start,
            end,
            outcome,
            extremes: significant(self.extremes, flutter),
            rests: self.rests,
            resting: self.rest.and_then(|rest| rest.0),
            fastest: self.fastest,
            last_speed: self.last_speed,
            sizes: self.sizes,
            slowest: self.slowest.1,
            last,
        }
    }
}

struct Watcher<'w> {
    body: &'w dyn Equivariant,
    gauge: &'w Gauge,
    seen: Seen,
}

impl Sink for Watcher<'_> {
    fn crossing(&mut self, crossing: &Crossing<'_>) {
        self.seen.extreme(Extreme {
            t: crossing.t,
            minimum: crossing.rising,
            size: self.gauge.size(crossing.state),
            shape: crossing.state.to_vec(),
        });
    }

    fn step(&mut self, t: f64, u: &[f64], slope: &[f64]) {
        let seen = &mut self.seen;
        let size = norm(u);
        seen.sizes = (seen.sizes.0.min(size), seen.sizes.1.max(size));
        let speed = reduced_speed(self.body, u, slope);
        seen.last_speed = speed;
        if speed < seen.slowest.0 {
            seen.slowest.0 = speed;
            seen.slowest.1.copy_from_slice(u);
        }
        seen.fastest = seen.fastest.max(speed);
        seen.rests(t, u, speed, seen.fastest);
    }
}
