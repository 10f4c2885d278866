//! Steps along a curve of special points, and what happens on them.

use super::correct::{TIGHT, product};
use super::curve_tracer::{CurveTracer, Spot, last_two};
use super::degenerate::{Degenerate, Seen, Sign};
use super::point::{End, Obstruction};
use super::problem::{Failure, Problem};
use super::special::Special;
use super::steps::{FINE, SHORTER, SLOW, STRAIGHT, follows, next_step};
use motiform_dynamics::sample::sort_by_number;

/// A point is one of the curve only where its critical multiplier is as close to where it belongs: what the condition leaves at
/// ordinary points is below 1e-6.
const RESOLVED: f64 = 1e-4;

/// Where that fails after a step as short as this, the condition is not resolved any more.
const SHORT: f64 = 1e-3;

/// A place, and its distance from the beginning of the step.
type At<L> = (Spot<L>, f64);

/// A step, or a stretch of it: the new place and, on the way, points of codimension two. The end is that of the curve.
pub(super) struct Stretch<L> {
    pub(super) degenerate: Vec<Event<L>>,
    pub(super) end: Option<End>,
}

/// A point of codimension two, the length `s` after the beginning of its step; without a place where it was not located.
pub(super) struct Event<L> {
    pub(super) s: f64,
    pub(super) spot: Option<Spot<L>>,
    pub(super) kind: Degenerate,
    /// The parameters, where they are extrapolated.
    pub(super) at: Option<[f64; 2]>,
    /// `true` if the curve ends there.
    pub(super) ends: bool,
}

impl<P: Problem> CurveTracer<'_, P> {
    /// The next special point and the length of the step to it.
    fn reach(&mut self) -> Result<(Spot<P::Local>, f64), End> {
        loop {
            let length = self.step;
            let why = match self.at(length) {
                Ok((Spot { reading, .. }, _)) if reading.off > RESOLVED => {
                    if length <= SHORT {
                        return Err(End::Lost { off: reading.off });
                    }
                    Obstruction::Newton
                }
                Ok((spot, off)) if self.is_straight(&spot) && self.is_expected(&spot, length) => {
                    self.step = next_step(length, off.abs(), &self.settings);
                    return Ok((spot, length));
                }
                Ok(_) => Obstruction::Newton,
                Err(Failure::Stopped) => return Err(End::Stopped),
                Err(Failure::Obstructed(why)) => why,
            };
            self.step = SHORTER * length;
            if self.step < self.settings.smallest_step {
                return Err(End::StepUnderflow { step: length, why });
            }
        }
    }

    fn is_straight(&self, new: &Spot<P::Local>) -> bool {
        let weights = self.problem.weights(&new.x);
        product(&weights, &self.spot.frame.along, &new.frame.along) > STRAIGHT
    }

    /// Returns `true` if the levels at `new` are about those that the last two places, or the middle of the step, let expect. (Of
    /// equilibria.)
    fn is_expected(&self, new: &Spot<P::Local>, length: f64) -> bool {
        let Some((_, levels, before)) = self.before.as_ref().filter(|_| self.problem.time().is_none()) else {
            return true;
        };
        let (last, now, half) = ((-before, levels), (0.0, &self.spot.levels), 0.5 * length);
        let largest = levels
            .iter()
            .chain(now.1)
            .flatten()
            .fold(self.problem.rate(), |most, one| most.max(one.growth.hypot(one.angle)));
        let unclear = self.problem.unclear(&new.levels, TIGHT).max(SLOW * largest);
        let new = (length, &new.levels);
        let middle = || {
            self.at(half).is_ok_and(|(middle, _)| follows(&[last, now, new], (half, &middle.levels), unclear))
        };
        length <= FINE * self.settings.smallest_step || follows(&[last, now], new, unclear) || middle()
    }

    /// One step; the present place is the new one afterwards.
    pub(super) fn step(&mut self) -> Result<Stretch<P::Local>, End> {
        if self.watch.stopped() {
            return Err(End::Stopped);
        }
        self.refine();
        let (mut new, mut length) = self.reach()?;
        let mut end = None;
        if let Some((nearer, s)) = self.edge(&new, length)? {
            (new, length, end) = (nearer, s, Some(End::RangeLeft));
        }
        self.check(&new)?;
        let mut degenerate = self.degenerate(&new, length)?;
        if let Some((kind, at)) = self.shrinks(&new) {
            // beyond it the curve goes on with the same orbits, half a period later: the parameters turn back there
            degenerate.retain(|event| event.kind != Degenerate::Cusp);
            degenerate.push(Event { s: length, spot: None, kind, at: Some(at), ends: true });
        }
        if let Some(symmetric) = self.symmetric(&new, length)? {
            degenerate.retain(|event| !symmetric.explains(event, length));
            degenerate.push(symmetric);
            sort_by_number(&mut degenerate, |a| a.s);
        }
        if let Some(last) = degenerate.iter().position(|event| event.ends) {
            degenerate.truncate(last + 1);
            end = Some(End::Degenerate { kind: degenerate[last].kind });
        }
        self.note_size(&new);
        let old = std::mem::replace(&mut self.spot, new);
        self.before = Some((old.x, old.levels, length));
        Ok(Stretch { degenerate, end })
    }

    fn check(&self, new: &Spot<P::Local>) -> Result<(), End> {
        let size = self.problem.size(&new.x);
        if size > self.settings.largest_size {
            return Err(End::BlowUp { size });
        }
        match self.problem.time().map(|place| new.x[place]) {
            Some(time) if time > self.settings.longest_time => Err(End::PeriodLimit { time }),
            _ => Ok(()),
        }
    }

    /// More unknowns, where an orbit needs them and a frame is found for them.
    fn refine(&mut self) {
        let Some(x) = self.problem.refine(&self.spot.x, &self.spot.local, self.watch) else { return };
        let coarse = std::mem::replace(&mut self.spot.x, x);
        let Ok(mut spot) = self.framed() else {
            self.spot.x = coarse;
            return self.problem.coarsen();
        };
        let ([p, q], old) = (last_two(&spot.frame.along), last_two(&self.spot.frame.along));
        if p * old[0] + q * old[1] < 0.0 {
            spot.frame.turn();
        }
        self.spot = spot;
        self.before = None;
    }

    /// Where the curve leaves the box before `new`.
    fn edge(&self, new: &Spot<P::Local>, length: f64) -> Result<Option<At<P::Local>>, End> {
        let mut nearest: Option<At<P::Local>> = None;
        for (i, (low, high)) in self.ranges.into_iter().enumerate() {
            let value = nearest.as_ref().map_or(new, |found| &found.0).parameters()[i];
            if (low..=high).contains(&value) {
                continue;
            }
            let edge = if value < low { low } else { high };
            let start = self.spot.parameters()[i] - edge;
            if start.abs() <= 1e-12 * (high - low) {
                return Err(End::RangeLeft);
            }
            let reach = nearest.as_ref().map_or(length, |found| found.1);
            let off = |spot: &Spot<P::Local>| spot.parameters()[i] - edge;
            let ends = ((0.0, start), (reach, value - edge));
            nearest = Some(self.zero(ends, &off).map_err(|failure| match failure {
                Failure::Stopped => End::Stopped,
                Failure::Obstructed(why) => End::StepUnderflow { step: self.step, why },
            })?);
        }
        Ok(nearest)
    }

    /// The points of codimension two on the way to `new`, in their order.
    fn degenerate(&self, new: &Spot<P::Local>, length: f64) -> Result<Vec<Event<P::Local>>, End> {
        let mut out = Vec::new();
        for (sign, kind) in Sign::all(&self.critical, self.special == Special::Fold) {
            let value =
                |spot: &Spot<P::Local>| sign.value(&self.critical, &self.seen(spot), &|| self.turn(spot));
            let count = |spot: &Spot<P::Local>| sign.count(&self.critical, &self.seen(spot));
            let (low, high) = (value(&self.spot), value(new));
            let counts = (count(&self.spot), count(new));
            let changes = low * high < 0.0 && (counts.0.is_none() || counts.0 != counts.1);
            let known = |spot: &Spot<P::Local>| sign.is_known(&self.seen(spot));
            if !(changes && known(&self.spot) && known(new)) {
                continue;
            }
            let holds = |spot: &Spot<P::Local>| {
                sign.holds(&self.seen(spot), [&self.seen(&self.spot), &self.seen(new)])
            };
            match self.zero(((0.0, low), (length, high)), &value) {
                Ok((spot, _)) if !holds(&spot) => {}
                Ok((spot, s)) if value(&spot).abs() < 1e-3 * low.abs().max(high.abs()) => {
                    out.push(Event { s, spot: Some(spot), kind, at: None, ends: sign.ends(&self.critical) });
                }
                Err(Failure::Stopped) => return Err(End::Stopped),
                _ => {
                    // the equations may be singular there
                    let sides = self.closed_in(&value, (new, length))?;
                    let left = sides[0].2.abs().max(sides[1].2.abs());
                    let vanishes = left < 1e-3 * low.abs().max(high.abs()) && !matches!(sign, Sign::Lyapunov);
                    let kind = if vanishes { kind } else { Degenerate::Unresolved };
                    out.push(Event::between(&sides, kind, sign.ends(&self.critical)));
                }
            }
        }
        sort_by_number(&mut out, |a| a.s);
        Ok(out)
    }

    fn seen<'s>(&'s self, spot: &'s Spot<P::Local>) -> Seen<'s> {
        let body = self.problem.body(&spot.local);
        Seen {
            body,
            shape: &spot.x[..body.dim()],
            solved: self.problem.solved(&spot.x),
            levels: &spot.levels,
            reading: &spot.reading,
        }
    }

    /// Where a quantity vanishes between two lengths, by false position (the Illinois variant).
    fn zero(
        &self,
        (mut low, mut high): ((f64, f64), (f64, f64)),
        value: &dyn Fn(&Spot<P::Local>) -> f64,
    ) -> Result<(Spot<P::Local>, f64), Failure> {
        let (length, mut kept, mut last) = (high.0 - low.0, None, f64::INFINITY);
        for _ in 0..60 {
            let s = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
            let spot = self.at(s)?.0;
            let here = value(&spot);
            if here == 0.0 || (s - last).abs() <= 1e-9 * length {
                return Ok((spot, s));
            }
            last = s;
            let side = here * low.1 > 0.0;
            let weight = if kept == Some(side) { 0.5 } else { 1.0 };
            if side {
                (low, high.1) = ((s, here), weight * high.1);
            } else {
                (high, low.1) = ((s, here), weight * low.1);
            }
            kept = Some(side);
        }
        Err(Failure::Obstructed(Obstruction::Newton))
    }
}
