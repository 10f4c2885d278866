//! Special points that are one.

use super::between::Step;
use super::brackets::Test;
use super::correct::distance;
use super::levels::unclear;
use super::locate::value;
use super::place::Place;
use super::problem::Problem;
use super::special::Special;

/// Part of a step within which points of one kind may be one.
const ONE: f64 = 1e-4;

/// Returns `true` if another test has led to the same point: one of the same kind, close by, where this test vanishes as well within its
/// error. (The length at which a point lies that was solved for is that of the place from which it was.)
pub(super) fn is_known<P: Problem>(
    step: &Step<'_, P>,
    found: &[(Place<P::Local>, Special)],
    (at, test): (&Place<P::Local>, Test),
    special: Special,
) -> bool {
    let weights = step.problem.weights(&at.x);
    let is_near = |other: &Place<P::Local>| {
        distance(&weights, &other.x, &at.x).min((other.arclength - at.arclength).abs()) < ONE * step.length
    };
    let vanishes = |other: &Place<P::Local>| {
        let here = value(step, at, test).abs();
        let there = value(step, other, test).abs();
        test == Test::Slope || there.is_nan() || there <= unclear(step.problem, &other.levels).max(here)
    };
    let same = found.iter().filter(|(_, kind)| is_alike(*kind, special));
    same.map(|one| &one.0).any(|other| is_near(other) && vanishes(other))
}

/// Frequencies that differ by more than this part are of different pairs.
const PAIRS: f64 = 1e-6;

/// Returns `true` for two of one kind: oscillations of different frequencies that begin at one point are two.
fn is_alike(a: Special, b: Special) -> bool {
    match (a, b) {
        (Special::Hopf(a), Special::Hopf(b)) => (a.frequency / b.frequency - 1.0).abs() < PAIRS,
        (Special::Torus { angle: a }, Special::Torus { angle: b }) => (a - b).abs() < PAIRS,
        _ => a.name() == b.name(),
    }
}
