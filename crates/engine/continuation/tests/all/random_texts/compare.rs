//! The program's branches beside the oracle's.

use super::curve::{Event, LARGEST, Side, Walk};
use super::starts::{Found, apart, everything};
use super::text::Text;
use crate::common::Random;
use motiform_analysis::RelativeEquilibrium;
use motiform_continuation::{Branch, End, Family, Settings};
use nalgebra::DVector;

/// Values of the parameter at which all motions are looked for.
const LOOKED_AT: [f64; 5] = [-0.83, -0.31, 0.07, 0.42, 0.91];

/// Random states for each of them.
const STARTS: usize = 150;

/// Longest step of the oracle, and the shorter ones with which it looks again where it disagrees.
const STEPS: [f64; 3] = [2e-3, 5e-4, 2e-4];

/// Largest difference of the same point: in the parameter, 1e-6 of the range, and in the state, whose error near a pitchfork is the root of
/// that.
pub(super) const SAME: [f64; 2] = [2e-6, 5e-3];

/// Comparisons, and those that failed.
#[derive(Clone, Debug, Default)]
pub(super) struct Tally {
    pub(super) branches: usize,
    pub(super) points: usize,
    pub(super) wrong: usize,
    pub(super) missed: usize,
    pub(super) renamed: usize,
    pub(super) unfinished: usize,
    pub(super) complaints: Vec<String>,
}

impl std::ops::AddAssign for Tally {
    fn add_assign(&mut self, other: Self) {
        self.branches += other.branches;
        self.points += other.points;
        self.wrong += other.wrong;
        self.missed += other.missed;
        self.renamed += other.renamed;
        self.unfinished += other.unfinished;
        self.complaints.extend(other.complaints);
    }
}

impl Tally {
    /// Fails where anything is wrong, or fewer than `least` points were compared.
    pub(super) fn judge(&self, least: usize) {
        let Self { branches, points, wrong, missed, renamed, unfinished, complaints } = self;
        eprintln!(
            "{branches} branches, {points} points: {wrong} false, {missed} missed, {renamed} renamed; {unfinished} curves differ"
        );
        assert!(complaints.is_empty(), "{}", complaints.join("\n"));
        assert!(*points >= least, "only {points} points are compared");
    }
}

/// A branch as the program or the oracle has it.
struct Seen {
    events: Vec<Event>,
    /// Parameters and invariants on the way.
    passed: Vec<(f64, Vec<f64>)>,
    ends: Vec<String>,
}

impl Seen {
    /// The states at a value of the parameter.
    fn at(&self, p: f64) -> Vec<Vec<f64>> {
        let between = |pair: &[(f64, Vec<f64>)]| {
            let [(a, x), (b, y)] = pair else { return None };
            let s = (p - a) / (b - a);
            let mean = || x.iter().zip(y).map(|(x, y)| x + s * (y - x)).collect();
            (0.0..1.0).contains(&s).then(mean)
        };
        self.passed.windows(2).filter_map(between).collect()
    }
}

/// All branches of a text.
pub(super) fn compare(seed: u64, text: &Text) -> Tally {
    let mut random = Random(77 + seed);
    let mut all = Tally::default();
    let mut known: Vec<Seen> = Vec::new();
    for p in LOOKED_AT {
        for found in everything(text, p, STARTS, &mut random) {
            let place = text.invariants(&found.0);
            if known.iter().any(|curve| curve.at(p).iter().any(|other| apart(other, &place) < 2e-3)) {
                continue;
            }
            let its = program(text, &found, p);
            let mine = oracle(text, &found, p, STEPS[0]);
            let mut tally = Tally::of(&mine, &its);
            for step in &STEPS[1..] {
                if tally.complaints.is_empty() {
                    break;
                }
                tally = Tally::of(&oracle(text, &found, p, *step), &its);
            }
            let head = format!("text {seed} ({}, {} modes) from {p}", text.symmetry, text.modes.len());
            for complaint in &mut tally.complaints {
                *complaint = format!(
                    "{head} {:.6?}: {complaint}; its ends {:?}, mine {:?}",
                    found.0.as_slice(),
                    its.ends,
                    mine.ends
                );
                eprintln!("{complaint}");
            }
            all += tally;
            known.push(mine);
        }
    }
    all
}

impl Tally {
    fn of(mine: &Seen, its: &Seen) -> Self {
        let mut tally = Self::default();
        tally.compare(mine, its);
        tally
    }

    fn compare(&mut self, mine: &Seen, its: &Seen) {
        self.branches += 1;
        self.points += mine.events.len();
        let near = |a: &Event, b: &Event| (a.p - b.p).abs() < SAME[0] && apart(&a.at, &b.at) < SAME[1];
        let mut rest: Vec<&Event> = its.events.iter().collect();
        let mut missed = Vec::new();
        for event in &mine.events {
            match rest.iter().position(|other| other.kind == event.kind && near(other, event)) {
                Some(place) => drop(rest.swap_remove(place)),
                None => missed.push(event),
            }
        }
        for event in missed {
            if let Some(place) = rest.iter().position(|other| near(other, event)) {
                let other = rest.swap_remove(place);
                self.renamed += 1;
                self.complaints.push(format!("{} is called {}: {event:?}", event.kind, other.kind));
            } else if event.p.abs() < 1.0 - SAME[0] {
                self.missed += 1;
                self.complaints.push(format!("missed {event:?}"));
            }
        }
        for event in rest.into_iter().filter(|event| event.p.abs() < 1.0 - SAME[0]) {
            self.wrong += 1;
            self.complaints.push(format!("false {event:?}"));
        }
        let proper = |end: &String| ["range", "closed", "meets", "large"].contains(&end.as_str());
        let lost = LOOKED_AT.iter().find(|p| mine.at(**p).len() != its.at(**p).len());
        if !its.ends.iter().chain(&mine.ends).all(proper) || lost.is_some() {
            self.unfinished += 1;
            self.complaints.push(format!("not the same curve at {lost:?}"));
        }
    }
}

/// Both sides as one, in order.
fn joined(sides: Vec<Side>) -> Seen {
    let mut out = Seen { events: Vec::new(), passed: Vec::new(), ends: Vec::new() };
    for (number, mut side) in sides.into_iter().enumerate() {
        if number == 1 {
            out.events.reverse();
            out.passed.reverse();
        }
        out.events.append(&mut side.events);
        out.passed.append(&mut side.passed);
        out.ends.push(side.end.to_owned());
    }
    out
}

fn oracle(text: &Text, (u, omega): &Found, p: f64, step: f64) -> Seen {
    let (walk, turned) = Walk::new(text, u, step);
    let omega = if walk.frame().mirror || walk.frame().folds == 0 { 0.0 } else { *omega };
    let mut sides = vec![walk.along(&turned, (omega, p, -1.0))];
    if !sides[0].closed {
        sides.push(walk.along(&turned, (omega, p, 1.0)));
    }
    joined(sides)
}

fn program(text: &Text, (u, _): &Found, p: f64) -> Seen {
    let family = text.family();
    let body = Family::at(&family, p).expect("a body");
    let settings = Settings { most_points: 20_000, largest_size: LARGEST, ..Settings::over(-1.0, 1.0) };
    let mut sides = Vec::new();
    let Some(start) = RelativeEquilibrium::find(body.as_ref(), u.as_slice()) else {
        return Seen { events: Vec::new(), passed: Vec::new(), ends: vec!["no start".to_owned()] };
    };
    for settings in [settings.reversed(), settings] {
        let mut branch = Branch::of_equilibria(&family, p, &start, &settings, &()).expect("a branch");
        let mut side = Side::default();
        for point in branch.by_ref() {
            let u = DVector::from_row_slice(point.motion.shape());
            let at = text.invariants(&u);
            if let Some(special) = point.special {
                side.events.push(Event { kind: special.name(), p: point.parameter, at: at.clone() });
            }
            side.passed.push((point.parameter, at));
        }
        side.end = match branch.end() {
            Some(End::RangeLeft) => "range",
            Some(End::Closed) => "closed",
            Some(End::Meets { .. }) => "meets",
            Some(End::BlowUp { .. }) => "large",
            Some(End::PointLimit) => "points",
            _ => "step",
        };
        let closed = side.end == "closed";
        sides.push(side);
        if closed {
            break;
        }
    }
    joined(sides)
}
