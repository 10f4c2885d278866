//! The same equations in other units of length, time and of the parameter have the same special points.

use super::curve::LARGEST;
use super::starts::everything;
use super::text::Text;
use crate::common::Random;
use motiform_analysis::RelativeEquilibrium;
use motiform_continuation::{Branch, End, Family, Point, Settings, Special, switch};

/// By how much numbers are larger in other units: lengths, rates, the parameter.
#[derive(Clone, Copy, Debug)]
pub(super) struct Larger {
    pub(super) length: f64,
    pub(super) rate: f64,
    pub(super) parameter: f64,
}

impl Larger {
    pub(super) const NOT: Self = Self { length: 1.0, rate: 1.0, parameter: 1.0 };
}

impl Text {
    /// The same equations in other units.
    pub(super) fn in_units(&self, larger: Larger) -> Self {
        let mut out = self.clone();
        for term in out.equations.iter_mut().flatten() {
            let first = larger.rate * larger.length;
            let factor = term.factors.iter().fold(first, |factor, _| factor / larger.length);
            term.constant *= factor;
            term.slope *= factor / larger.parameter;
        }
        out
    }
}

/// A special point: what it is, the parameter and the period of what begins, in the units of the text itself.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Found {
    pub(super) name: &'static str,
    pub(super) parameter: f64,
    pub(super) period: f64,
}

/// Points of the steady branch through `u` and of the orbits that begin at its first Hopf bifurcation, at most this many of the latter.
const ORBITS: usize = 60;

/// The same point, in the parameter and in the period.
const SAME: [f64; 2] = [2e-7, 1e-5];

/// The points on the branches of a text, from the motion `u` at `p`.
pub(super) fn points(text: &Text, u: &[f64], p: f64, larger: Larger) -> Vec<Vec<Found>> {
    let (text, u) = (text.in_units(larger), u.iter().map(|x| x * larger.length).collect::<Vec<f64>>());
    let (family, p) = (text.family(), p * larger.parameter);
    let body = Family::at(&family, p).expect("a body");
    let start = RelativeEquilibrium::find(body.as_ref(), &u).expect("a motion");
    let settings = Settings {
        largest_size: LARGEST * larger.length,
        ..Settings::over(-larger.parameter, larger.parameter)
    };
    let mut first_hopf = None;
    let mut out = Vec::new();
    for settings in [settings.reversed(), settings] {
        let mut branch = Branch::of_equilibria(&family, p, &start, &settings, &()).expect("a branch");
        let (mut found, mut hopf) = (Vec::new(), Vec::new());
        for point in branch.by_ref().filter(|point| point.special.is_some()) {
            if matches!(point.special, Some(Special::Hopf(_))) {
                hopf.push(point.clone());
            }
            found.extend(read(&point, larger));
        }
        // where the branch ends as a wave of the motion at rest, it is what begins there
        let ends = |point: &Point| matches!(branch.end(), Some(End::Meets { parameter, .. }) if *parameter == point.parameter);
        let first = hopf.into_iter().find(|point| !ends(point));
        first_hopf = first_hopf.or(first);
        found.extend(end(branch.end(), larger));
        out.push(found);
    }
    if let Some(point) = first_hopf {
        let settings = Settings { most_points: ORBITS, longest_time: 200.0 / larger.rate, ..settings };
        let legs = switch(&family, &point, &settings, &()).into_iter().flatten().flatten();
        out.extend(legs.map(|leg| leg.filter_map(|point| read(&point, larger)).collect()));
    }
    out
}

fn read(point: &Point, larger: Larger) -> Option<Found> {
    let special = point.special?;
    let period = match special {
        Special::Hopf(hopf) => hopf.period(),
        _ => point.motion.orbit().map_or(0.0, motiform_analysis::PeriodicOrbit::period),
    };
    Some(Found {
        name: special.name(),
        parameter: point.parameter / larger.parameter,
        period: period * larger.rate,
    })
}

/// Why a steady branch ends.
fn end(end: Option<&End>, larger: Larger) -> Option<Found> {
    let (name, parameter) = match end? {
        End::RangeLeft => ("range", 0.0),
        End::Closed => ("closed", 0.0),
        End::Meets { parameter, .. } => ("meets", *parameter),
        End::BlowUp { .. } => ("large", 0.0),
        _ => ("other", 0.0),
    };
    Some(Found { name, parameter: parameter / larger.parameter, period: 0.0 })
}

/// Compares a text with itself in other units; the number of points.
pub(super) fn compare(seed: u64, text: &Text, all: &[Larger]) -> usize {
    let p = 0.07;
    let starts = everything(text, p, 20, &mut Random(5 + seed));
    let Some((u, _)) = starts.last() else { return 0 };
    let expected = points(text, u.as_slice(), p, Larger::NOT);
    for &larger in all {
        let found = points(text, u.as_slice(), p, larger);
        let near = |a: f64, b: f64, least: f64| (a - b).abs() <= least * (1.0 + b.abs());
        let same = |(a, b): (&Found, &Found)| {
            a.name == b.name && near(a.parameter, b.parameter, SAME[0]) && near(a.period, b.period, SAME[1])
        };
        let all_same = found.len() == expected.len()
            && found.iter().zip(&expected).all(|(a, b)| a.len() == b.len() && a.iter().zip(b).all(same));
        assert!(all_same, "text {seed} in {larger:?}: {found:?}, not {expected:?}");
    }
    expected.iter().flatten().count()
}
