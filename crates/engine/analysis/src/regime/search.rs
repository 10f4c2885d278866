//! The search for a verdict: the questions of [`super::classify()`] in their order, independent of how the orbits are computed.

mod exponent;
mod on_curve;

use super::ask::Ask;
use super::case::Case;
use super::growth::Growth;
use super::heteroclinic::cycle;
use super::look::{Look, Rest, Seen};
use super::recurrence::{Returns, periodic};
use super::repeats::Repeats;
use super::settings::{NEARLY, Settings, ended};
use super::shrinking::Curve;
use super::stay::Stay;
use super::steady_turns::SteadyTurns;
use super::verdict::{Attractor, Regime, Verdict};
use super::{chaos, words};
use crate::Result;
use crate::equilibrium::{REACHED, RelativeEquilibrium};
use crate::linear::norm;
use crate::periodic::is_small;
use motiform_dynamics::{Equivariant, Outcome, Part, Watch};

/// An equilibrium is sought during a look where the reduced shape changes slower than this, against its fastest.
const SETTLED: f64 = 1e-3;

/// The decision on one motion, under way. It asks for observations and receives them: their source, one orbit or a lane of
/// many, makes no difference to it.
#[derive(Debug)]
pub(super) struct Search {
    settings: Settings,
    /// Length of the look under way, and whether it is the first.
    span: f64,
    first: bool,
    /// The first and the latest shape of the orbit.
    start: Vec<f64>,
    shape: Vec<f64>,
    /// Model time spent, and to be spent at most.
    time: f64,
    budget: f64,
    /// `true` if the budget was doubled for an exponent that was nearly decided.
    extended: bool,
    /// Fastest change of the reduced shape so far.
    fastest: f64,
    /// Largest `|u|` so far: what distances are small against, for a circle has no size of its own.
    largest: f64,
    /// Complete rests of all looks.
    rests: Vec<Rest>,
    /// The growth of tangent vectors in the runs so far.
    growth: Vec<Growth>,
    /// The stay at an unstable equilibrium that is under way.
    stay: Stay,
    /// The equilibrium that a look ended at before its time.
    arrived: Option<RelativeEquilibrium>,
    /// The reduced speed at which an equilibrium was last sought during a look.
    sought: f64,
    /// The common results of the latest looks and runs.
    repeats: Repeats,
    /// The closed curve that the returns of the last look lay on.
    curve: Curve,
    /// The evidence that the last look lacked for a decision, in words.
    missing: String,
    /// The purpose of the next observation.
    pending: Pending,
}

/// The purpose of a requested observation.
#[derive(Debug)]
enum Pending {
    /// The next look.
    Look,
    /// The test that the orbit comes closer to the nearby equilibrium.
    Approach { found: Box<RelativeEquilibrium>, before: f64, reached: f64, size: f64 },
    /// An exponent; the look before.
    Exponent(Box<Look>),
}

impl Search {
    /// A search that begins at `start`.
    pub(super) fn new(settings: &Settings, start: &[f64]) -> (Self, Ask) {
        let mut search = Self {
            settings: *settings,
            span: settings.first_look.min(settings.budget),
            first: true,
            start: start.to_vec(),
            shape: start.to_vec(),
            time: 0.0,
            budget: settings.budget,
            extended: false,
            fastest: 0.0,
            largest: norm(start),
            rests: Vec::new(),
            growth: Vec::new(),
            stay: Stay::default(),
            arrived: None,
            sought: f64::INFINITY,
            repeats: Repeats::default(),
            curve: Curve::default(),
            missing: "no motion had established itself".to_owned(),
            pending: Pending::Look,
        };
        let ask = search.next();
        (search, ask)
    }

    /// The shape that the orbit had when it was last seen; of a cycle that of its last rest.
    pub(super) fn into_shape(self) -> Vec<f64> {
        self.shape
    }

    /// The watch on the next look or run, a part of the budget.
    pub(super) fn part<'w>(&self, span: f64, watch: &'w dyn Watch) -> Part<'w> {
        let [from, to] = [self.time, self.time + span].map(|time| (time / self.budget).min(1.0));
        Part { watch, from, to }
    }

    /// Asks for the next look, of length `span`.
    fn next(&mut self) -> Ask {
        self.pending = Pending::Look;
        Ask::Look(self.span)
    }

    /// Returns `true` if a look may end here, before its time: the orbit is close to a stable equilibrium. It
    /// is asked where the shape hardly changes any more, and again where it changes ten times slower: in a
    /// cycle between saddles it rests as well.
    pub(super) fn arrives(&mut self, body: &dyn Equivariant, seen: &Seen, shape: &[f64]) -> bool {
        let slow = (SETTLED * self.fastest.max(seen.fastest)).min(0.1 * self.sought);
        if !matches!(self.pending, Pending::Look) || seen.last_speed > slow {
            return false;
        }
        self.sought = seen.last_speed;
        let largest = self.largest.max(seen.sizes.1);
        self.arrived =
            RelativeEquilibrium::reached(body, shape, largest).filter(RelativeEquilibrium::is_stable);
        self.arrived.is_some()
    }

    /// Takes in a look.
    pub(super) fn looked(&mut self, body: &dyn Equivariant, look: Look, watch: &dyn Watch) -> Result<Ask> {
        if let Some(outcome) = ended(&look.outcome) {
            return Ok(self.ended(&outcome, look.start));
        }
        self.time += look.end - look.start;
        self.shape.clone_from(&look.last);
        let case = Case { body, settings: &{ self.settings }, watch };
        match std::mem::replace(&mut self.pending, Pending::Look) {
            Pending::Approach { found, before, reached, size } => {
                let after = found.distance(body, &self.shape);
                if after > reached && after > 0.7 * before {
                    // It may spiral in, or swing by. Nothing else is asked so near to a stable equilibrium: the last
                    // swings of a spiral come back like a small periodic orbit.
                    "the orbit did not come closer to the nearby equilibrium".clone_into(&mut self.missing);
                    return self.again(case);
                }
                Ok(words::equilibrium(body, &found, after / size, self.time).into())
            }
            _ => self.rests(case, look),
        }
    }

    /// The verdict, or the interruption, that a run ended with; the run's own clock showed `start` at its start.
    fn ended(&mut self, outcome: &Outcome, start: f64) -> Ask {
        let before = self.time;
        match *outcome {
            Outcome::Interrupted { .. } => Ask::Nothing(None),
            Outcome::Escaped { t, singular, t_last, .. } => {
                words::blow_up(singular, before + t - start, before + t_last - start).into()
            }
            _ => {
                let why = format!("the run ended early: {outcome}");
                let time = before + outcome.t() - start;
                Verdict::new(Regime::Undetermined, Attractor::Unknown, why, time).into()
            }
        }
    }

    /// Is the orbit about to reach a stable relative equilibrium?
    fn rests(&mut self, case: Case<'_>, look: Look) -> Result<Ask> {
        self.fastest = self.fastest.max(look.fastest);
        self.largest = self.largest.max(look.sizes.1);
        // An orbit that began where it ends up was never fast: what is left of its changes is round-off.
        if look.last_speed > 0.05 * self.fastest && !look.is_still(self.settings.hovering()) {
            return self.recurs(case, look);
        }
        let arrived = self.arrived.take();
        let Some(found) = arrived.or_else(|| RelativeEquilibrium::find(case.body, &self.shape)) else {
            "the size of the shape hardly changes, but no equilibrium was found there"
                .clone_into(&mut self.missing);
            return self.recurs(case, look);
        };
        let decided = found.is_stable() || found.is_unstable();
        let family = if decided { None } else { found.across_family(case.body) };
        let found = family.filter(RelativeEquilibrium::is_stable).unwrap_or(found);
        let size = norm(&found.shape).max(self.largest);
        let before = found.distance(case.body, &self.shape);
        let reached = (self.settings.hovering() * size).max(100.0 * self.settings.atol());
        if !found.is_stable() {
            self.missing = if found.is_unstable() && before > reached {
                "the size of the shape hardly changes, but it is at no equilibrium, and the nearest one is unstable".to_owned()
            } else if found.is_unstable() {
                format!("the orbit rests at an unstable shape (growth rate {:.2e})", found.growth())
            } else {
                "the orbit rests at a shape that is neutral in a direction beside those of its symmetry \
                (growth rate 0 within round-off): at these parameters the equations have more symmetry than \
                stated, or the shape bifurcates"
                    .to_owned()
            };
            return if before > reached { self.recurs(case, look) } else { self.stays(case, look, &found) };
        }
        if before > REACHED * size {
            "the orbit was still on its way to an equilibrium".clone_into(&mut self.missing);
            return self.recurs(case, look);
        }
        if before > reached {
            let wait = (-1.0 / found.growth()).min(self.settings.budget);
            self.pending = Pending::Approach { found: Box::new(found), before, reached, size };
            return Ok(Ask::Look(wait));
        }
        Ok(words::equilibrium(case.body, &found, before / size, self.time).into())
    }

    /// The orbit is at an unstable equilibrium: does it stay there? It is not asked whether neighbouring orbits separate: at a
    /// saddle they do, at its own rate.
    fn stays(&mut self, case: Case<'_>, mut look: Look, found: &RelativeEquilibrium) -> Result<Ask> {
        let still = look.is_still(self.settings.hovering());
        if self.stay.goes_on(look.end - look.start, still, found.growth()) {
            if found.holds_what_was_lost(case.body, &self.start, &self.shape) {
                let why = "the orbit rests at one saddle after the other, the longer the later, until its distance from the next \
                           way out is smaller than every number: an orbit between saddles that is not followed further";
                let why = why.to_owned();
                return Ok(Verdict::new(Regime::Undetermined, Attractor::Unknown, why, self.time).into());
            }
            return Ok(words::unstable(case.body, found, self.stay.time(), self.time).into());
        }
        self.budget = self.budget.max(self.stay.budget(&self.settings, self.time, found.growth()));
        self.remember(&mut look);
        if !still {
            let start = look.resting.unwrap_or(look.start);
            self.rests.push(Rest { start, end: look.end, shape: self.shape.clone(), whole: false });
        } else if let Some(rest) = self.rests.last_mut().filter(|rest| !rest.whole) {
            rest.end = look.end;
        }
        if let Some(cycle) = cycle(case.body, &self.rests) {
            let verdict = words::rectangular(case, &cycle, &self.shape, self.time)?;
            self.shape = cycle.shape;
            return Ok(verdict.into());
        }
        self.again(case)
    }

    /// Keeps the rests of a look. In a look that was still all the time they are those of round-off.
    fn remember(&mut self, look: &mut Look) {
        if !look.is_still(self.settings.hovering()) {
            self.rests.append(&mut look.rests);
        }
    }

    /// Does it rest near saddles, does its shape come back?
    fn recurs(&mut self, case: Case<'_>, mut look: Look) -> Result<Ask> {
        self.stay = Stay::default();
        let earlier = self.rests.len();
        self.remember(&mut look);
        if let Some(cycle) = cycle(case.body, &self.rests) {
            let verdict = words::rectangular(case, &cycle, &self.shape, self.time)?;
            self.shape = cycle.shape;
            return Ok(verdict.into());
        }
        match periodic(case, &look, &self.rests[earlier..]) {
            Returns::Stable(found, recurrence) => {
                return Ok(words::periodic(case, &found, &recurrence, self.time)?.into());
            }
            Returns::NotStable(orbit) => {
                self.missing = words::not_stable(&orbit);
                return self.again(case);
            }
            Returns::None => {}
        }
        self.repeats.turned(SteadyTurns::of(case.body, &look));
        if self.first || look.is_still(self.settings.hovering()) {
            return self.again(case);
        }
        self.pending = Pending::Exponent(Box::new(look));
        Ok(Ask::Exponent(self.span))
    }

    /// Twice as long, or the end of the budget. In a large system, where model time costs most, looks do not grow while an exponent is
    /// nearly decided: it is asked for a little more time, not for as much again.
    fn again(&mut self, case: Case<'_>) -> Result<Ask> {
        self.first = false;
        // An exponent that is nearly that of chaos gets more time, once: its error shrinks, the limit stays.
        if self.time >= self.budget && !self.extended && chaos::is_near(&self.growth) {
            self.extended = true;
            self.budget *= 2.0;
        }
        let nearly = chaos::is_near(&self.growth) && chaos::is_long_enough(&self.growth);
        let longer = if !is_small(case.body.dim()) && nearly {
            self.span.min(NEARLY * self.settings.first_look)
        } else {
            2.0 * self.span
        };
        self.span = longer.min((self.budget - self.time).max(self.settings.first_look));
        let repeated = self.repeats.since();
        if self.time < self.budget && repeated.is_none() {
            return Ok(self.next());
        }
        if let Some(turns) = self.repeats.turns() {
            let verdict = turns.verdict(self.time);
            return Ok(self.described(verdict, case, self.span)?.into());
        }
        let within =
            repeated.unwrap_or_else(|| format!("within the budget of {}", words::lasting(self.budget)));
        let why = format!("{} {within}", self.missing);
        let verdict = Verdict::new(Regime::Undetermined, Attractor::Unknown, why, self.time);
        Ok(self.described(verdict, case, self.span)?.into())
    }

    fn described(&self, mut verdict: Verdict, case: Case<'_>, span: f64) -> Result<Verdict> {
        let span = span.min(self.settings.first_look);
        words::along(&mut verdict, case, &self.shape, span)?;
        Ok(verdict)
    }
}
