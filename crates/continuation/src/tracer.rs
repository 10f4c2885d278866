//! Pseudo-arclength continuation with step control, over any equations.

use super::between::Step;
use super::certificate::TestFunction;
use super::classes::GAINED;
use super::copies::same_motion;
use super::correct::{correct, directions, normal, scaled};
use super::homoclinic::{Algebraic, Periods};
use super::levels::unstable;
use super::locate::{Changes, locate};
use super::place::{Before, Place, place};
use super::point::{End, Motion, Obstruction, Point};
use super::problem::{Failure, Problem};
use super::settings::Settings;
use super::special::Special;
use motiform_analysis::linear::dot;
use motiform_dynamics::Watch;
use std::collections::VecDeque;

/// Newton's method has converged with a step shorter than this, if nothing else is asked for.
pub(super) const TOLERANCE: f64 = 1e-9;

/// Least part of a shape by which a motion differs from the start of a branch.
const SAME: f64 = 1e-6;

/// Steps are halved so often where a change cannot be located.
const HALVINGS: usize = 4;

/// Where a step leads, its length, and what changes on it.
type Examined<L> = (Place<L>, f64, Changes<L>);

/// Where a branch ends on a step, and why.
type Limit<L> = Option<(Place<L>, End)>;

/// Where a branch began.
struct First {
    parameter: f64,
    slope: f64,
    motion: Motion,
}

/// Whether a branch may turn back here: where another one goes on through the point it is no fold.
fn turns(special: Special) -> bool {
    matches!(special, Special::Fold | Special::BranchPoint)
}

/// Whether the second of two special points is the first one, found by the slope of the parameter.
fn is_better<L>(found: &[(Place<L>, Special)], first: usize, other: usize, length: f64) -> bool {
    let [first, other] = [first, other].map(|place| &found[place].0);
    let by_slope = |place: &Place<L>| {
        place.certificate.is_some_and(|certificate| certificate.test == TestFunction::Slope)
    };
    by_slope(other) && !by_slope(first) && other.arclength - first.arclength < 1e-2 * length
}

/// A branch being followed.
pub(super) struct Tracer<P: Problem> {
    pub(super) problem: P,
    pub(super) settings: Settings,
    pub(super) place: Place<P::Local>,
    pub(super) before: Option<Before>,
    pub(super) step: f64,
    /// How often in a row steps were halved because a change could not be located.
    halvings: usize,
    first: First,
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
        let found = correct(&problem, x, &row, settings.tolerance, watch)?;
        let weights = problem.weights(&found.x);
        // the side is decided by the parameter; where the branch is vertical, by the sign that the decomposition gives
        let null = directions(problem.linear(&found.local), &weights);
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
        let found = correct(&problem, guess, &row, settings.tolerance, watch);
        match found.and_then(|found| place(&problem, found, &row, 0.0)) {
            Ok(place) => Ok(Self::at(problem, place, settings)),
            Err(failure) => Err((problem, failure)),
        }
    }

    fn at(problem: P, place: Place<P::Local>, settings: &Settings) -> Self {
        let motion = problem.motion(&place.x, &place.local, &place.levels);
        let mut tracer = Self {
            first: First { parameter: place.parameter(), slope: place.slope(), motion },
            halvings: 0,
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
        let (mut new, mut length) = self.reach(watch)?;
        let mut last = None;
        if let Some((nearer, end)) = self.limit(&new, watch)? {
            length = nearer.arclength - self.place.arclength;
            (new, last) = (nearer, Some(end));
        }
        self.check(&new)?;
        let (new, length, mut changes) = self.examine(new, length, &mut last, watch)?;
        if let Some(end) = self.meets(length, &mut changes) {
            self.hand_out_special(changes.found);
            return Err(end);
        }
        if let Some(end) = self.shrinks(&new, &changes.found) {
            return Err(end);
        }
        self.hand_out(&new, changes);
        let old = std::mem::replace(&mut self.place, new);
        self.before = Some(Before { x: old.x, tangent: old.tangent, levels: old.levels, length });
        last.map_or_else(|| self.ends(), Err)
    }

    /// The place on the way to `new` beyond which the branch does not go.
    fn limit(&self, new: &Place<P::Local>, watch: &dyn Watch) -> Result<Limit<P::Local>, End> {
        let (low, high) = self.settings.range;
        if !(low..=high).contains(&new.parameter()) {
            let edge = if new.parameter() < low { low } else { high };
            if self.place.parameter() == edge {
                return Err(End::RangeLeft);
            }
            return Ok(Some((self.edge(new, edge, watch)?, End::RangeLeft)));
        }
        self.closes(new, watch)
    }

    /// The start, where the branch passes it again in the same direction before `new`.
    fn closes(&self, new: &Place<P::Local>, watch: &dyn Watch) -> Result<Limit<P::Local>, End> {
        let (old, first) = (&self.place, &self.first);
        let sides = [old, new].map(|place| place.parameter() - first.parameter);
        let along = [old, new].iter().all(|place| place.slope() * first.slope > 0.0);
        if self.count < 3 || !along || sides[0] * sides[1] > 0.0 || sides[0] == 0.0 {
            return Ok(None);
        }
        let at = self.edge(new, first.parameter, watch)?;
        let motion = self.problem.motion(&at.x, &at.local, &at.levels);
        let body = self.problem.body(&at.local);
        let same = same_motion(body, &first.motion, &motion, &self.settings.flow, SAME);
        Ok(same.then_some((at, End::Closed)))
    }

    /// What changes on the way to `new`. Where a change cannot be located, shorter steps are tried.
    fn examine(
        &mut self,
        mut new: Place<P::Local>,
        mut length: f64,
        last: &mut Option<End>,
        watch: &dyn Watch,
    ) -> Result<Examined<P::Local>, End> {
        let changes = |tracer: &Self, new: &Place<P::Local>, length| {
            let step = Step { old: &tracer.place, new, before: tracer.before.as_ref(), length };
            locate(&tracer.problem, &step, watch).map_err(|_| End::Stopped)
        };
        let mut found = changes(self, &new, length)?;
        let mut halved = false;
        while !found.missed.is_empty() && self.halvings < HALVINGS {
            self.halvings += 1;
            let Ok((nearer, _)) = self.attempt(0.5 * length, watch) else { break };
            (new, length, halved, *last) = (nearer, 0.5 * length, true, None);
            found = changes(self, &new, length)?;
        }
        if !halved {
            self.halvings = 0;
        }
        for (at, _) in found.found.iter_mut().filter(|(_, special)| *special == Special::BranchPoint) {
            self.keep_course(at, &new, length);
        }
        Ok((new, length, found))
    }

    /// Gives a point where branches cross the tangent of this one, which the equations there do not tell from that of the other: the mean of
    /// those on both sides.
    fn keep_course(&self, at: &mut Place<P::Local>, new: &Place<P::Local>, length: f64) {
        let part = (at.arclength - self.place.arclength) / length;
        let mean = self.place.tangent.iter().zip(&new.tangent).map(|(a, b)| a + part * (b - a)).collect();
        if let Some(tangent) = scaled(mean, &self.problem.weights(&at.x)) {
            at.tangent = tangent;
        }
    }

    /// The special points of a step.
    fn hand_out_special(&mut self, found: Vec<(Place<P::Local>, Special)>) {
        for (at, special) in found {
            let point = self.point(&at, Some(special));
            self.queue.push_back(point);
        }
    }

    /// The points of a step.
    fn hand_out(&mut self, new: &Place<P::Local>, changes: Changes<P::Local>) {
        self.hand_out_special(changes.found);
        let (from, to) = (self.place.parameter(), new.parameter());
        for seen in changes.missed {
            let point = self.point(new, Some(Special::Unresolved { seen, from, to }));
            self.queue.push_back(point);
        }
        let point = self.point(new, None);
        self.queue.push_back(point);
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
        let resonant =
            || self.periods.algebraic(Algebraic::Resonant)?.through(saddle(), self.problem.is_symmetric());
        let on_a_circle = || {
            let found = self.periods.algebraic(Algebraic::SquareRoot)?;
            let side = (self.place.parameter() - found.parameter).signum();
            found.at_fold(side, &|p| self.problem.equilibrium(&self.place.x, &self.place.local, p))
        };
        resonant().or_else(on_a_circle).map_or(end, |found| End::Homoclinic(Box::new(found)))
    }

    /// The end of the branch at the first turning point where the motion gains a symmetry: it is a special point of the motion that has it. What was found beyond belongs to
    /// images of the branch; what was found as near as the symmetry can be told is the same point. (With five axes or more, say, another
    /// growth vanishes as the third power of the distance, and round-off places it.)
    fn meets(&self, length: f64, changes: &mut Changes<P::Local>) -> Option<End> {
        let gains = |(place, (at, special)): (usize, &(Place<P::Local>, Special))| {
            let gained = turns(*special).then(|| self.problem.gains(&at.x, &at.local, GAINED)).flatten();
            gained.map(|gained| (place, gained))
        };
        let mut all = changes.found.iter().enumerate().filter_map(gains);
        let first = all.next()?;
        // the parameter is level there to first order, the growth to second: the slope tells the place better
        let (place, (gains, x)) =
            all.find(|other| is_better(&changes.found, first.0, other.0, length)).unwrap_or(first);
        let (mut at, _) = changes.found.swap_remove(place);
        at.x = x;
        changes.found.retain(|(other, _)| {
            let before = at.arclength - other.arclength > 1e-4 * length;
            before && self.problem.gains(&other.x, &other.local, 10.0 * GAINED).is_none()
        });
        let end = End::Meets { parameter: at.parameter(), gains };
        changes.found.push((at, gains.special()));
        Some(end)
    }

    /// Whether the orbits shrink to an equilibrium before `new`. The parameter has an extreme value there, as at a fold.
    fn shrinks(&self, new: &Place<P::Local>, found: &[(Place<P::Local>, Special)]) -> Option<End> {
        let (before, now) = (self.problem.swing(&self.place.local)?, self.problem.swing(&new.local)?);
        if dot(&before, &now) >= 0.0 {
            return None;
        }
        let at = found.iter().find(|(_, special)| turns(*special)).map_or(new, |(at, _)| at);
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
            if let Some(certain) = connection.through(saddle, self.problem.is_symmetric()) {
                return Err(End::Homoclinic(Box::new(certain)));
            }
        }
        if time.0 > self.settings.longest_time {
            return Err(End::PeriodLimit { time: time.0 });
        }
        Ok(())
    }

    /// More unknowns, where an orbit needs them and a solution with them is found.
    fn refine(&mut self, watch: &dyn Watch) {
        let kept = self.problem.time().map_or(0, |time| self.place.x.len() - time);
        let old: Vec<f64> = self.place.tangent.iter().rev().take(kept).rev().copied().collect();
        let Some(x) = self.problem.refine(&self.place.x, &self.place.local, watch) else { return };
        let mut row = vec![0.0; x.len()];
        let from = row.len() - kept;
        row[from..].copy_from_slice(&old);
        let weights = self.problem.weights(&x);
        let found = scaled(row, &weights).map(|row| normal(&row, &weights)).and_then(|row| {
            let found = correct(&self.problem, x, &row, self.settings.tolerance, watch).ok()?;
            place(&self.problem, found, &row, self.place.arclength).ok()
        });
        let Some(place) = found else { return self.problem.coarsen() };
        self.place = place;
        self.before = None;
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
            certificate: special.and(place.certificate),
        }
    }
}
