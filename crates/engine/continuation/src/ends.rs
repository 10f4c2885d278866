//! Where and why a branch ends.

use super::brackets::LEVEL;
use super::certificate::TestFunction;
use super::classes::GAINED;
use super::copies::same_motion;
use super::homoclinic::{Connection, Saddle, leading_sides};
use super::joins::Joins;
use super::levels::CLEAR;
use super::locate::Changes;
use super::normal_form::Order;
use super::oscillating::half_turn;
use super::passages::Passages;
use super::periods::Algebraic;
use super::place::Place;
use super::point::End;
use super::problem::Problem;
use super::special::Special;
use super::tracer::Tracer;
use motiform_analysis::equilibrium::prefix;
use motiform_analysis::linear::dot;
use motiform_analysis::{Isotropy, PeriodicOrbit};

/// Least part of a shape by which a motion differs from the start of a branch.
const SAME: f64 = 1e-6;

/// So many points for one value of the parameter from the start on are a family.
const FAMILY: usize = 100;
/// Slope of the parameter, in widths of its range, that may be 0: at the start of a branch it is known less well than the parameter.
const FLAT: f64 = 1e-5;

/// Where a branch ends on a step, and why.
pub(super) type Limit<L> = Option<(Place<L>, End)>;

/// Returns `true` if a branch may turn back here: where another one goes on through the point it is no fold.
fn turns(special: Special) -> bool {
    matches!(special, Special::Fold | Special::BranchPoint)
}

/// Returns `true` if the second of two special points is the first one, found by the slope of the parameter.
fn is_better<L>(found: &[(Place<L>, Special)], first: usize, other: usize, length: f64) -> bool {
    let [first, other] = [first, other].map(|place| &found[place].0);
    let by_slope = |place: &Place<L>| {
        place.certificate.is_some_and(|certificate| certificate.test == TestFunction::Slope)
    };
    by_slope(other) && !by_slope(first) && other.arclength - first.arclength < 1e-2 * length
}

/// The orbit passes a saddle that one of its nodes is closer to than this part of its extent.
const PASSED: f64 = 0.1;

/// The parameter of orbits has settled where it has not changed by so many errors of the solutions over so many half turns of the saddle.
const SETTLED: f64 = 10.0;
const HALF_TURNS: f64 = 6.0;

impl<P: Problem> Tracer<'_, P> {
    /// Returns `true` if beside a saddle-focus the parameter has not changed by more than the errors of the solutions: what the branch does
    /// from here on is that of round-off.
    fn is_settled(&self) -> bool {
        let error = SETTLED * self.problem.accuracy() * self.settings.width();
        self.half_turn.is_some_and(|half_turn| self.periods.stays(HALF_TURNS * half_turn, error))
    }

    /// The place on the way to `new` beyond which the branch does not go.
    pub(super) fn limit(&self, new: &Place<P::Local>) -> Result<Limit<P::Local>, End> {
        let (low, high) = self.settings.range;
        if !(low..=high).contains(&new.parameter()) {
            let edge = if new.parameter() < low { low } else { high };
            if self.place.parameter() == edge {
                return Err(End::RangeLeft);
            }
            return Ok(Some((self.edge(new, edge)?, End::RangeLeft)));
        }
        self.closes(new)
    }

    /// The start, where the branch passes it again in the same direction before `new`.
    fn closes(&self, new: &Place<P::Local>) -> Result<Limit<P::Local>, End> {
        let (old, first) = (&self.place, &self.first);
        let sides = [old, new].map(|place| place.parameter() - first.parameter);
        let along = [old, new].iter().all(|place| place.slope() * first.slope > 0.0);
        if self.count < 3 || !along || sides[0] * sides[1] > 0.0 || sides[0] == 0.0 {
            return Ok(None);
        }
        if self.is_family(new) {
            return Ok(None); // the sides are those of round-off
        }
        let at = self.edge(new, first.parameter)?;
        let motion = self.problem.motion(&at.x, &at.local, &at.levels);
        let body = self.problem.body(&at.local);
        let same = same_motion(body, &first.motion, &motion, &self.settings.flow, SAME);
        Ok(same.then_some((at, End::Closed)))
    }

    /// Ends a branch whose shape has left every bound.
    pub(super) fn check(&self, new: &Place<P::Local>) -> Result<(), End> {
        let size = self.problem.size(&new.x);
        if size > self.settings.largest_size { Err(End::BlowUp { size }) } else { Ok(()) }
    }

    /// The reason behind the end of the computation, where the growth of the period says more.
    pub(super) fn explained(&self, end: End) -> End {
        if !matches!(end, End::StepUnderflow { .. } | End::PeriodLimit { .. }) {
            return end;
        }
        let resonant = || {
            let found = self.periods.algebraic(Algebraic::Resonant)?.through(self.saddle())?;
            Some(Connection { joins: self.joins(), ..found })
        };
        let on_a_circle = || {
            let found = self.periods.algebraic(Algebraic::SquareRoot)?;
            let side = (self.place.parameter() - found.parameter).signum();
            found.at_fold(side, &|p| Some(self.saddle_at(p)?.found))
        };
        self.oscillates(self.saddle(), f64::INFINITY)
            .or_else(resonant)
            .or_else(on_a_circle)
            .map_or(end, |found| self.homoclinic(found))
    }

    /// The end at a connection, with the change of the saddle quantity up to there.
    fn homoclinic(&self, mut found: Connection) -> End {
        let quantity = |rates: &[(f64, f64)]| leading_sides(rates).map(|[grows, decays]| grows.0 + decays.0);
        let there = self.saddle_at(found.parameter).and_then(|saddle| quantity(&saddle.rates));
        if let Some(here) = quantity(&found.rates) {
            // without a saddle there its sign is not known
            found.quantity_change = there.map_or(here, |there| there - here);
        }
        End::Homoclinic(Box::new(found))
    }

    /// The saddle that the orbit at the present place passes closest by.
    fn saddle(&self) -> Option<Saddle> {
        self.saddle_at(self.place.parameter())
    }

    /// The same at another value of the parameter.
    fn saddle_at(&self, parameter: f64) -> Option<Saddle> {
        self.problem.saddle(&self.place.x, &self.place.local, parameter)
    }

    /// The connection with this saddle-focus to which a parameter of this unit oscillates.
    fn oscillates(&self, saddle: Option<Saddle>, unit: f64) -> Option<Connection> {
        let saddle = saddle?;
        let found = self.periods.oscillating(&saddle.rates, unit)?.through(Some(saddle))?;
        // all solutions that are fitted may be off by the same
        let error = found.error + self.problem.accuracy() * self.settings.width();
        // beside a saddle-focus the orbit passes it in turns that may look like other equilibria: these are no evidence
        let joins = self.joins().filter(|joins| *joins != Joins::Different);
        Some(Connection { error, joins, ..found })
    }

    /// The relation between the saddles that the orbit is seen to pass.
    fn joins(&self) -> Option<Joins> {
        self.passages().map(|passages| passages.joins)
    }

    fn passages(&self) -> Option<Passages> {
        self.problem.passages(&self.place.x, &self.place.local)
    }

    /// The connection ahead by the logarithmic law, with the saddles that the orbit passes. `None` where the law is not theirs, or several
    /// are passed and not all of them clearly.
    fn certain(&self, connection: Connection) -> Option<Connection> {
        let passages = self.passages();
        if let Some(several) = passages.as_ref().filter(|passages| passages.joins == Joins::Different) {
            return connection.past(several);
        }
        let joins = passages.as_ref().map(|passages| passages.joins);
        let of_one = connection.clone().through(self.saddle());
        let found = of_one.or_else(|| connection.past(passages.as_ref()?))?;
        Some(Connection { joins, ..found })
    }

    /// The end of the branch at the first special point where the motion gains a symmetry: it is a special point of the motion that has it.
    /// Points beyond belong to images of the branch; those as near as the symmetry can be told are the same point. (With
    /// five axes or more, say, another growth vanishes as the third power of the distance, and round-off places it.)
    pub(super) fn meets(&self, length: f64, changes: &mut Changes<P::Local>) -> Option<End> {
        let gains = |(place, (at, special)): (usize, &(Place<P::Local>, Special))| {
            if matches!(special, Special::Touch { .. }) {
                return None;
            }
            // where the parameter does not turn back the place is found by itself, and as well as any other
            let same = if turns(*special) { GAINED } else { Isotropy::SAME };
            self.problem.gains(&at.x, &at.local, same).map(|gained| (place, gained))
        };
        let mut all = changes.found.iter().enumerate().filter_map(gains);
        let first = all.next()?;
        // the parameter is level there to first order, the growth to second: the slope tells the place better
        let (place, (gains, x)) =
            all.find(|other| is_better(&changes.found, first.0, other.0, length)).unwrap_or(first);
        let (mut at, _) = changes.found.swap_remove(place);
        let special = self.problem.met(&at.x, &x, gains);
        at.x = x;
        changes.found.retain(|(other, _)| {
            let apart = at.arclength - other.arclength;
            let flat = other.certificate.is_some_and(|shown| {
                shown.test == TestFunction::Growth
                    && shown.transversality.abs() * apart <= CLEAR * self.problem.noise(&other.levels)
            });
            apart > 1e-4 * length
                && !flat
                && self.problem.gains(&other.x, &other.local, 10.0 * GAINED).is_none()
        });
        let end = End::Meets { parameter: at.parameter(), gains };
        // it is a point of the motion with more symmetry, and this motion has the time of those that begin there
        if let Some(certificate) = &mut at.certificate
            && special == gains.special()
        {
            certificate.normal_form = Some(self.problem.normal_form(&at.x, Order::Third, false));
        }
        changes.found.push((at, special));
        Some(end)
    }

    /// The end of orbits that shrink to an equilibrium before `new`. The parameter has an extreme value there, as at a fold.
    pub(super) fn shrinks(&self, new: &Place<P::Local>, found: &[(Place<P::Local>, Special)]) -> Option<End> {
        let (before, now) = (self.problem.swing(&self.place.local)?, self.problem.swing(&new.local)?);
        if dot(&before, &now) >= 0.0 {
            return None;
        }
        let at = found.iter().find(|(_, special)| turns(*special)).map_or(new, |(at, _)| at);
        let time = self.problem.time()?;
        Some(End::Shrinks { parameter: at.parameter(), time: at.x[time] })
    }

    /// Returns `true` if the parameter of orbits has not changed from the start of the branch to this place by more than its error.
    pub(super) fn is_family(&self, at: &Place<P::Local>) -> bool {
        let width = self.settings.width();
        let stays = (at.parameter() - self.first.parameter).abs() <= LEVEL * self.problem.accuracy() * width;
        stays && at.slope().abs() < FLAT * width && self.problem.time().is_some()
    }

    /// Ends a branch of orbits that ends at the present place.
    pub(super) fn ends(&mut self) -> Result<(), End> {
        let Some(time) = self.problem.time().map(|place| (self.place.x[place], self.place.tangent[place]))
        else {
            return Ok(());
        };
        let parameter = self.place.parameter();
        if self.count >= FAMILY && self.is_family(&self.place) {
            return Err(End::Family { parameter });
        }
        let unit = prefix(self.settings.width());
        self.periods.push(time, (parameter, self.place.slope()));
        if let Some(certain) = self.periods.connection(unit).and_then(|found| self.certain(found)) {
            return Err(self.homoclinic(certain));
        }
        let saddle = self.periods.is_growing().then(|| self.saddle()).flatten();
        let passed = saddle.as_ref().filter(|saddle| saddle.near < PASSED);
        self.half_turn = passed.and_then(|saddle| half_turn(&saddle.rates));
        if let Some(certain) = self.oscillates(saddle, unit) {
            return Err(self.homoclinic(certain));
        }
        if self.is_settled() {
            let motion = self.problem.motion(&self.place.x, &self.place.local, &self.place.levels);
            return Err(End::Settles { period: motion.orbit().map_or(time.0, PeriodicOrbit::period) });
        }
        if time.0 > self.settings.longest_time {
            return Err(End::PeriodLimit { time: time.0 });
        }
        Ok(())
    }
}
