//! Branches of periodic motions beside multipliers that are computed by themselves along them.

use super::compare::{SAME, Tally};
use super::curve::LARGEST;
use super::frame::upright;
use super::shooting::{Orbit, Shooting};
use super::starts::everything;
use super::text::Text;
use crate::common::Random;
use motiform_analysis::RelativeEquilibrium;
use motiform_continuation::{Branch, End, Family, Point, Settings, Special, switch};
use nalgebra::DVector;

/// Places between two points of the program at which multipliers are computed.
const PARTS: usize = 3;

/// Largest multiplier up to which single shooting is trusted, and the longest time.
const LIMITS: [f64; 2] = [1e4, 60.0];

/// Part by which the period of the first orbit differs from that at its Hopf bifurcation; one that is over a rotation's part of it differs
/// by a factor.
const BEGINS: f64 = 0.25;

/// A special point: its kind and its parameter.
type Event = (&'static str, f64);

/// Compares the points of one branch.
pub(super) fn compare(text: &Text, branch: &mut Branch<'_>) -> (Tally, Vec<Point>) {
    let points: Vec<Point> = branch.by_ref().collect();
    let mut tally = Tally { branches: 1, ..Tally::default() };
    let ordinary: Vec<usize> = (0..points.len()).filter(|&i| points[i].special.is_none()).collect();
    let Some((shooting, first)) = shooting(text, &points) else { return (tally, points) };
    let mut before = first;
    for pair in ordinary.windows(2) {
        let its: Vec<Event> = points[pair[0] + 1..pair[1]]
            .iter()
            .filter_map(|point| Some((point.special?.name(), point.parameter)))
            .collect();
        let Some(next) = unknowns(&shooting, &points[pair[1]]) else { break };
        match between(&shooting, &before, &next) {
            Some((mine, false)) => tally.compare_step(&mine, &its),
            _ => return (tally, points), // beyond what single shooting can do
        }
        before = next;
    }
    let rest: Vec<Event> = points[ordinary.last().map_or(0, |last| last + 1)..]
        .iter()
        .filter_map(|point| Some((point.special?.name(), point.parameter)))
        .collect();
    if let (Some(End::Meets { .. }), Some(last)) = (branch.end(), points.last()) {
        let next = unknowns(&shooting, last);
        let found = next.and_then(|next| beyond(&shooting, &before, &next));
        let mine: Vec<Event> = found.into_iter().flatten().collect();
        tally.compare_step(&mine, &rest);
    }
    (tally, points)
}

fn shooting<'t>(text: &'t Text, points: &[Point]) -> Option<(Shooting<'t>, DVector<f64>)> {
    let orbit = points.first()?.motion.orbit()?;
    let (frame, _) = upright(text, &DVector::from_row_slice(&orbit.shape), 1e-6);
    let shooting = Shooting { text, frame, mirrored: orbit.mirrored };
    let first = unknowns(&shooting, points.first()?)?;
    Some((shooting, first))
}

fn unknowns(shooting: &Shooting<'_>, point: &Point) -> Option<DVector<f64>> {
    let orbit = point.motion.orbit()?;
    let u = DVector::from_row_slice(&orbit.shape);
    let u = if shooting.frame.mirror { upright(shooting.text, &u, 1e-6).1 } else { u };
    Some(shooting.unknowns(&u, orbit.time, orbit.angle, point.parameter))
}

/// The events on the way between two points, and whether it leads beyond the limits; `None` where Newton's method fails.
fn between(shooting: &Shooting<'_>, a: &DVector<f64>, b: &DVector<f64>) -> Option<(Vec<Event>, bool)> {
    let way = Way { shooting, a: a.clone(), along: unwrapped(shooting, a, b) };
    let mut before = way.at(0.0)?;
    let mut events = Vec::new();
    for part in 1..=PARTS {
        let s = part as f64 / PARTS as f64;
        let next = way.at(s)?;
        let largest = next.multipliers.iter().flatten().map(|m| m.0.hypot(m.1)).fold(0.0, f64::max);
        if largest > LIMITS[0] || next.x[shooting.frame.kept.len()] > LIMITS[1] {
            return Some((events, true));
        }
        let low = s - 1.0 / PARTS as f64;
        for space in 0..3 {
            way.changes(space, (low, &before), (s, &next), &mut events);
        }
        before = next;
    }
    Some((events, false))
}

/// The events up to the end of a branch that gains a symmetry, a little beyond the last point.
fn beyond(shooting: &Shooting<'_>, a: &DVector<f64>, b: &DVector<f64>) -> Option<Vec<Event>> {
    let along = unwrapped(shooting, a, b);
    let (events, _) = between(shooting, a, &(a + 1.2 * along))?;
    Some(events)
}

/// `b - a` with the shorter way between the angles.
fn unwrapped(shooting: &Shooting<'_>, a: &DVector<f64>, b: &DVector<f64>) -> DVector<f64> {
    let mut along = b - a;
    if shooting.turns() {
        let angle = &mut along[shooting.frame.kept.len() + 1];
        *angle -= std::f64::consts::TAU * (*angle / std::f64::consts::TAU).round();
    }
    along
}

struct Way<'w> {
    shooting: &'w Shooting<'w>,
    a: DVector<f64>,
    along: DVector<f64>,
}

impl Way<'_> {
    fn at(&self, s: f64) -> Option<Orbit> {
        self.shooting.solve(&(&self.a + s * &self.along), &self.along.normalize())
    }

    /// Where the number of multipliers outside of the unit circle changes.
    fn changes(&self, space: usize, low: (f64, &Orbit), high: (f64, &Orbit), out: &mut Vec<Event>) {
        if low.1.sign(space) == high.1.sign(space) {
            return;
        }
        let s = 0.5 * (low.0 + high.0);
        let Some(middle) = self.at(s) else { return };
        if high.0 - low.0 < 1e-7 {
            out.extend(self.named(space, s, &middle).map(|kind| (kind, middle.p())));
            return;
        }
        self.changes(space, low, (s, &middle), out);
        self.changes(space, (s, &middle), high, out);
    }

    fn named(&self, space: usize, s: f64, at: &Orbit) -> Option<&'static str> {
        if space == 2 {
            return self.turn(at);
        }
        let off = |m: &&(f64, f64)| (m.0.hypot(m.1) - 1.0).abs();
        let critical = at.multipliers[space].iter().min_by(|a, b| off(a).total_cmp(&off(b)))?;
        if critical.0 + 1.0 < 1e-3 {
            return Some(if self.shooting.mirrored { "symmetry-breaking" } else { "period-doubling" });
        }
        if 1.0 - critical.0 > 1e-3 {
            return Some("torus");
        }
        if space == 1 {
            return Some("pitchfork");
        }
        let turns = self.at(s - 0.01)?.slope() * self.at(s + 0.01)?.slope() < 0.0;
        (!turns).then_some("branch-point")
    }

    /// Where the parameter turns back: a fold, unless the orbit has more symmetry there.
    fn turn(&self, at: &Orbit) -> Option<&'static str> {
        let (found, _) = upright(self.shooting.text, &self.shooting.state(&at.x), 1e-3);
        if found.kept.len() < self.shooting.frame.kept.len() {
            return Some("pitchfork");
        }
        let gained = if self.shooting.mirrored { None } else { self.shooting.half(&at.x) };
        gained.or(Some("fold"))
    }
}

impl Tally {
    fn compare_step(&mut self, mine: &[Event], its: &[Event]) {
        self.points += mine.len();
        let near = |a: &Event, b: &Event| (a.1 - b.1).abs() < SAME[0];
        let mut rest = its.to_vec();
        for event in mine {
            if let Some(place) = rest.iter().position(|other| other.0 == event.0 && near(other, event)) {
                rest.swap_remove(place);
            } else if let Some(place) = rest.iter().position(|other| near(other, event)) {
                let other = rest.swap_remove(place);
                self.renamed += 1;
                self.complaints.push(format!("{event:?} is called {}", other.0));
            } else {
                self.missed += 1;
                self.complaints.push(format!("missed {event:?}"));
            }
        }
        self.wrong += rest.len();
        self.complaints.extend(rest.into_iter().map(|event| format!("false {event:?}")));
    }
}

/// Up to `most` branches that begin at the Hopf bifurcations of a text, and at what is found on them.
pub(super) fn all(seed: u64, text: &Text, most: usize) -> Tally {
    let family = text.family();
    let settings = Settings {
        most_points: 300,
        longest_time: LIMITS[1],
        largest_size: LARGEST,
        ..Settings::over(-1.0, 1.0)
    };
    let mut begins = hopf_points(text, seed, &settings);
    let mut all = Tally::default();
    while let Some(point) = begins.pop() {
        let Ok(branches) = switch(&family, &point, &settings, &()) else { continue };
        for mut branch in branches.into_iter().flatten() {
            let (mut tally, points) = compare(text, &mut branch);
            let name = point.special.map_or("", |special| special.name());
            let head = format!(
                "text {seed} ({}, {} modes), {name} at {}",
                text.symmetry,
                text.modes.len(),
                point.parameter
            );
            if let (Some(Special::Hopf(hopf)), Some(first)) = (point.special, points.first()) {
                let period = first.motion.orbit().map_or(f64::NAN, motiform_analysis::PeriodicOrbit::period);
                let off = (period / hopf.period() - 1.0).abs();
                assert!(
                    off < BEGINS,
                    "{head}: the orbits begin with the period {period}, not {}",
                    hopf.period()
                );
            }
            for complaint in &mut tally.complaints {
                *complaint = format!("{head}: {complaint}; ends {:?}", branch.end());
                eprintln!("{complaint}");
            }
            all += tally;
            if all.branches >= most {
                return all;
            }
            let doubled = |point: &Point| {
                matches!(
                    point.special,
                    Some(Special::PeriodDoubling | Special::SymmetryBreaking | Special::Pitchfork { .. })
                )
            };
            let meets = matches!(branch.end(), Some(End::Meets { .. }));
            let own = points.len() - usize::from(meets);
            begins.splice(0..0, points[..own].iter().filter(|point| doubled(point)).take(1).cloned());
        }
    }
    all
}

/// The Hopf bifurcations of shapes, each once.
fn hopf_points(text: &Text, seed: u64, settings: &Settings) -> Vec<Point> {
    let family = text.family();
    let mut out: Vec<Point> = Vec::new();
    for p in [-0.6, 0.5] {
        for (u, _) in everything(text, p, 60, &mut Random(seed)) {
            let body = Family::at(&family, p).expect("a body");
            let Some(start) = RelativeEquilibrium::find(body.as_ref(), u.as_slice()) else { continue };
            for settings in [settings.reversed(), *settings] {
                let branch = Branch::of_equilibria(&family, p, &start, &settings, &()).expect("a branch");
                for point in branch {
                    let is_hopf = matches!(point.special, Some(Special::Hopf(_)));
                    let circle = text.rotates() && point.motion.shape().iter().all(|x| x.abs() < 1e-9);
                    let known = out.iter().any(|other| (other.parameter - point.parameter).abs() < 1e-6);
                    if is_hopf && !circle && !known {
                        out.push(point);
                    }
                }
            }
        }
    }
    out
}
