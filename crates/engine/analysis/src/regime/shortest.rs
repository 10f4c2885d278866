//! The shortest period of an orbit that came back after some multiple of it.

use super::case::Case;
use super::family::within_family;
use super::recurrence::Recurrence;
use crate::periodic::{PeriodicGuess, PeriodicOrbit};
use crate::symmetry::align;
use motiform_dynamics::drive::drive;

/// Parts of the period after which the shape may be back already: extremes that a step passes over hide a return, and a shape of constant
/// size has none at all. More than the returns that are tried ([`super::recurrence`]).
const PARTS: usize = 64;

/// Shapes nearer to each other than this part of the diameter may be the same.
const NEAR: f64 = 1e-2;

/// The same orbit with its shortest period: more returns than one may have been tried first.
pub(super) fn shortest(
    case: Case<'_>,
    orbit: PeriodicOrbit,
    recurrence: Recurrence,
) -> (PeriodicOrbit, Recurrence) {
    let (orbit, recurrence) = of_fewer_returns(case, orbit, recurrence);
    match divided(case, &orbit) {
        Some((part, parts)) => {
            let returns = (recurrence.returns / parts).max(1);
            let (mirrored, time, angle) = (part.mirrored, part.time, part.angle);
            (part, Recurrence { returns, mirrored, time, angle })
        }
        None => (orbit, recurrence),
    }
}

/// The same orbit, if its shape comes back after fewer returns to the section.
fn of_fewer_returns(
    case: Case<'_>,
    orbit: PeriodicOrbit,
    recurrence: Recurrence,
) -> (PeriodicOrbit, Recurrence) {
    let body = case.body;
    if recurrence.returns == 1 && (recurrence.mirrored || !body.symmetry().mirror) {
        return (orbit, recurrence);
    }
    let found = || -> Option<(PeriodicOrbit, Recurrence)> {
        let look = case.look(&orbit.shape, 2.2 * orbit.time).ok()?;
        let diameter = look.diameter(body);
        let minima = look.minima();
        let (start, later) = minima.split_first()?;
        for (returns, minimum) in later.iter().enumerate() {
            for &mirrored in case.images() {
                let near = align(body, &minimum.shape, &start.shape, mirrored);
                let time = minimum.t - start.t;
                let shorter = time < 0.75 * orbit.time || mirrored && !orbit.mirrored;
                if near.distance < NEAR * diameter && shorter {
                    let guess = PeriodicGuess { shape: &start.shape, time, angle: near.angle, mirrored };
                    let found = case.find(&guess).and_then(|found| stable(case, found))?;
                    let recurrence = Recurrence { returns: returns + 1, mirrored, time, angle: near.angle };
                    return Some((found, recurrence));
                }
            }
        }
        None
    };
    found().unwrap_or((orbit, recurrence))
}

/// The orbit of a whole fraction of this one's time, if its shape is back after that, and the number of parts.
fn divided(case: Case<'_>, orbit: &PeriodicOrbit) -> Option<(PeriodicOrbit, usize)> {
    let mut flow = case.orbit(&orbit.shape).ok()?;
    let mut shapes: Vec<(usize, Vec<f64>)> = Vec::new();
    for parts in (2..=PARTS).rev() {
        drive(flow.as_mut(), &case.request(orbit.time / parts as f64), &mut ()).ok()?;
        shapes.push((parts, flow.state().to_vec()));
    }
    let away = |shape: &[f64]| align(case.body, shape, &orbit.shape, false).distance;
    let diameter = shapes.iter().map(|(_, shape)| away(shape)).fold(0.0, f64::max);
    for (parts, shape) in &shapes {
        for &mirrored in case.images() {
            let near = align(case.body, shape, &orbit.shape, mirrored);
            if near.distance >= NEAR * diameter {
                continue;
            }
            let time = orbit.time / *parts as f64;
            let guess = PeriodicGuess { shape: &orbit.shape, time, angle: near.angle, mirrored };
            if let Some(found) = case.find(&guess).and_then(|found| stable(case, found)) {
                return Some((found, *parts));
            }
        }
    }
    None
}

/// A stable orbit, also one of a family, without the multipliers 1 of the family.
fn stable(case: Case<'_>, found: PeriodicOrbit) -> Option<PeriodicOrbit> {
    let mut effort = f64::INFINITY;
    if found.is_stable() { Some(found) } else { within_family(case, &found, &mut effort) }
}
