//! Does the shape come back? Recurrences of the reduced orbit, polished by Newton's method.

use super::case::Case;
use super::family::within_family;
use super::heteroclinic::attracting_saddle;
use super::look::{Extreme, Look, Rest};
use super::moments::is_a_point;
use super::place::find_placed;
use super::shortest::shortest;
use crate::isotropy::Isotropy;
use crate::periodic::{PeriodicGuess, PeriodicOrbit, is_small};
use crate::symmetry::{align, wrap};
use motiform_dynamics::Equivariant;

/// Most returns to the section per period.
const LONGEST: usize = 48;

/// Recurrences closer than this part of the motion's diameter are worth a try.
const CLOSE: f64 = 0.005;

/// The orbit found must be this near to the latest return, against the latest swing from minimum to maximum.
const NEAR: f64 = 0.2;

/// Most recurrences that are tried.
const TRIES: usize = 2;

/// In a large system a try follows several tangent vectors over several periods, a hundred times the cost of a look of that length. All
/// tries of a look may take this part of its model time, and at least the time of a first look: three or four periods find an orbit,
/// so every period up to a sixteenth of the look is found.
const EFFORT: f64 = 0.25;

/// A return of the reduced orbit to where it was.
#[derive(Clone, Copy, Debug)]
pub(super) struct Recurrence {
    /// Returns to the section.
    pub(super) returns: usize,
    pub(super) mirrored: bool,
    pub(super) time: f64,
    pub(super) angle: f64,
}

/// The shortest recurrences of the last minimum that are close, as many as are tried.
pub(super) fn recurrences(body: &dyn Equivariant, minima: &[&Extreme], diameter: f64) -> Vec<Recurrence> {
    let Some((last, earlier)) = minima.split_last() else { return Vec::new() };
    let mut found: Vec<Recurrence> = Vec::new();
    let images = if body.symmetry().mirror { &[true, false][..] } else { &[false] };
    for (returns, before) in earlier.iter().rev().take(LONGEST).enumerate() {
        if (before.size - last.size).abs() > CLOSE * diameter {
            continue; // sizes differ by no more than the distance
        }
        for &mirrored in images {
            let near = align(body, &last.shape, &before.shape, mirrored);
            if near.distance < CLOSE * diameter
                && settles(body, minima, returns + 1, mirrored, near.distance, diameter)
            {
                let time = last.t - before.t;
                found.push(Recurrence { returns: returns + 1, mirrored, time, angle: near.angle });
                if found.len() == TRIES {
                    return found;
                }
            }
        }
    }
    found
}

/// Returns `true` if the same recurrence a period earlier was no closer: an orbit that others approach is
/// approached. `true` where both are at the resolution.
///
/// Where the look is too short to tell, a small system may be tried. In a large one a try costs as much as hundreds of periods: it is
/// asked for two close returns in a row. Chaos shows one close return in every look, and two of them as the square of that.
fn settles(
    body: &dyn Equivariant,
    minima: &[&Extreme],
    returns: usize,
    mirrored: bool,
    now: f64,
    diameter: f64,
) -> bool {
    let small = is_small(body.dim());
    let at = |back: usize| minima.len().checked_sub(1 + back).map(|index| minima[index]);
    let (Some(middle), Some(early)) = (at(returns), at(2 * returns)) else { return small };
    let before = align(body, &middle.shape, &early.shape, mirrored).distance;
    now <= 1.05 * before.max(1e-5 * diameter) && (small || before < CLOSE * diameter)
}

/// An unstable periodic orbit this near to the latest return, against the latest swing, is the motion itself.
const ON: f64 = 1e-6;

/// The result of the latest returns of a look.
#[derive(Debug)]
pub(super) enum Returns {
    /// The look ends on a stable periodic orbit; the recurrence led to it.
    Stable(Box<PeriodicOrbit>, Recurrence),
    /// The look ends, to within round-off, on a periodic orbit that is unstable or neutral. An orbit of exact symmetry stays there, and its
    /// tangent vectors grow at the orbit's own rate.
    NotStable(Box<PeriodicOrbit>),
    /// No periodic orbit was found.
    None,
}

/// The periodic orbit that the look ends on; `rests` are those of this look.
///
/// In a large system a recurrence that passes a saddle by which cycles attract is not tried: what Newton's method might find would be
/// an orbit of the tolerance ([`is_of_the_flow`]), after tangent vectors have grown by `e^(lambda_+ T)` in a rest of length T.
pub(super) fn periodic(case: Case<'_>, look: &Look, rests: &[Rest]) -> Returns {
    let Case { body, settings, watch } = case;
    let minima = look.minima();
    let diameter = look.diameter(body);
    let Some(last) = minima.last() else { return Returns::None };
    let Some(maximum) = look.extremes.iter().rev().find(|extreme| !extreme.minimum) else {
        return Returns::None;
    };
    let swing = align(body, &maximum.shape, &last.shape, false).distance;
    let large = !is_small(body.dim());
    let most = settings.first_look.max(EFFORT * (look.end - look.start));
    let mut effort = if large { most } else { f64::INFINITY };
    for recurrence in recurrences(body, &minima, diameter) {
        if passes_attracting_saddle(body, rests, (last.t - recurrence.time, last.t)) {
            continue;
        }
        let guess = PeriodicGuess {
            shape: &last.shape,
            time: recurrence.time,
            angle: recurrence.angle,
            mirrored: recurrence.mirrored,
        };
        let Some(orbit) = find_placed(body, &guess, &settings.flow(), &mut effort, watch) else {
            continue;
        };
        // Against the latest swing: an equilibrium, approached in a spiral, is a periodic orbit of no size.
        let away = align(body, &orbit.shape, &last.shape, false).distance / swing;
        let orbit = resolved(case, orbit, &mut effort);
        if away < ON && !orbit.is_stable() {
            return Returns::NotStable(Box::new(orbit));
        }
        let is_orbit = || is_of_the_flow(case, &orbit) && !is_a_point(case, &orbit);
        if orbit.is_stable() && away < NEAR && is_orbit() {
            let (orbit, recurrence) = shortest(case, orbit, recurrence);
            let (orbit, recurrence) = unmirrored(case, orbit, recurrence);
            return Returns::Stable(Box::new(orbit), recurrence);
        }
    }
    Returns::None
}

/// By this factor the tolerance is tighter where multipliers do not decide.
const DECIDING: f64 = 1e-3;

/// The orbit in a tighter tolerance, where at this one its multipliers do not say whether it is stable, or its size is not known beyond the
/// error of its place; or without the neutral multipliers of a family that it lies in.
fn resolved(case: Case<'_>, orbit: PeriodicOrbit, effort: &mut f64) -> PeriodicOrbit {
    let Case { body, settings, watch } = case;
    let decided =
        |orbit: &PeriodicOrbit| (orbit.is_stable() || orbit.is_unstable()) && !is_a_point(case, orbit);
    if decided(&orbit) {
        return orbit;
    }
    let PeriodicOrbit { time, angle, mirrored, .. } = orbit;
    let guess = PeriodicGuess { shape: &orbit.shape, time, angle, mirrored };
    let flow = settings.flow().tighter(DECIDING);
    let tighter = flow.and_then(|flow| find_placed(body, &guess, &flow, effort, watch));
    match tighter.filter(decided) {
        Some(tighter) => tighter,
        None => within_family(case, &orbit, effort).unwrap_or(orbit),
    }
}

/// Returns `true` if one of the rests between two times was at a saddle by which cycles attract
/// ([`attracting_saddle`]).
pub(super) fn passes_attracting_saddle(
    body: &dyn Equivariant,
    rests: &[Rest],
    (from, to): (f64, f64),
) -> bool {
    let within = rests.iter().filter(|rest| rest.end > from && rest.start < to);
    let shapes = within.rev().map(|rest| &rest.shape);
    shapes.into_iter().any(|shape| attracting_saddle(body, shape).is_some())
}

/// An orbit that is mirror symmetric at every moment is its own mirror image after any time: its period ends when the shape comes
/// back as it was, not mirrored.
fn unmirrored(case: Case<'_>, orbit: PeriodicOrbit, recurrence: Recurrence) -> (PeriodicOrbit, Recurrence) {
    let axis = Isotropy::of(case.body, &orbit.shape, Isotropy::SAME).mirror;
    let Some(axis) = axis.filter(|_| orbit.mirrored) else { return (orbit, recurrence) };
    // M u = R(-axis) u, so R(angle) M u = R(angle - axis) u
    let angle = wrap(orbit.angle - axis);
    let guess = PeriodicGuess { shape: &orbit.shape, time: orbit.time, angle, mirrored: false };
    match case.find(&guess) {
        Some(found) => (found, Recurrence { mirrored: false, angle, ..recurrence }),
        None => (orbit, recurrence),
    }
}

/// Returns `true` if the orbit is one of the flow, and not of its tolerance: it passes no saddle that
/// attracts as a cycle does.
fn is_of_the_flow(case: Case<'_>, orbit: &PeriodicOrbit) -> bool {
    case.look(&orbit.shape, orbit.time)
        .map_or(true, |look| attracting_saddle(case.body, &look.slowest).is_none())
}
