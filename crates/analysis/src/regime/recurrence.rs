//! Does the shape come back? Recurrences of the reduced orbit, polished by Newton's method.

use super::heteroclinic::attracting_saddle;
use super::look::{Extreme, Look};
use super::settings::Settings;
use crate::periodic::{PeriodicGuess, PeriodicOrbit};
use crate::symmetry::align;
use motiform_dynamics::Equivariant;

/// Most returns to the section per period.
const LONGEST: usize = 48;

/// Recurrences closer than this part of the motion's diameter are worth a try.
const CLOSE: f64 = 0.005;

/// The orbit found must be this near to the latest return, against the latest swing from minimum to maximum.
const NEAR: f64 = 0.2;

/// Most recurrences that are tried.
const TRIES: usize = 2;

/// A return of the reduced orbit to where it was.
#[derive(Clone, Copy, Debug)]
pub(super) struct Recurrence {
    /// Returns to the section.
    pub(super) returns: usize,
    pub(super) mirrored: bool,
    pub(super) time: f64,
    pub(super) angle: f64,
}

/// The recurrences of the last minimum that are close, shortest first.
pub(super) fn recurrences<B: Equivariant + ?Sized>(
    body: &B,
    minima: &[&Extreme],
    diameter: f64,
) -> Vec<Recurrence> {
    let Some((last, earlier)) = minima.split_last() else { return Vec::new() };
    let mut found: Vec<Recurrence> = Vec::new();
    let images = if body.is_symmetric() { &[true, false][..] } else { &[false] };
    for (returns, before) in earlier.iter().rev().take(LONGEST).enumerate() {
        if (before.size - last.size).abs() > CLOSE * diameter {
            continue; // sizes differ by no more than the distance
        }
        for &mirrored in images {
            let near = align(body, &last.shape, &before.shape, mirrored);
            if near.distance < CLOSE * diameter
                && settles(body, minima, returns + 1, mirrored, near.distance, 1e-5 * diameter)
            {
                let time = last.t - before.t;
                found.push(Recurrence { returns: returns + 1, mirrored, time, angle: near.angle });
            }
        }
    }
    found
}

/// Whether the same recurrence a period earlier was no closer: an orbit that others approach is approached. `true` where the
/// look is too short to tell, or both are at the resolution.
fn settles<B: Equivariant + ?Sized>(
    body: &B,
    minima: &[&Extreme],
    returns: usize,
    mirrored: bool,
    now: f64,
    resolution: f64,
) -> bool {
    let at = |back: usize| minima.len().checked_sub(1 + back).map(|index| minima[index]);
    let (Some(middle), Some(early)) = (at(returns), at(2 * returns)) else { return true };
    let before = align(body, &middle.shape, &early.shape, mirrored).distance;
    now <= 1.05 * before.max(resolution)
}

/// A stable periodic orbit that the look ends on, with the recurrence that led to it.
pub(super) fn periodic<B: Equivariant + ?Sized>(
    body: &B,
    look: &Look,
    settings: &Settings,
) -> Option<(PeriodicOrbit, Recurrence)> {
    let minima = look.minima();
    let diameter = look.diameter(body);
    let last = minima.last()?;
    let maximum = look.extremes.iter().rev().find(|extreme| !extreme.minimum)?;
    let swing = align(body, &maximum.shape, &last.shape, false).distance;
    for recurrence in recurrences(body, &minima, diameter).into_iter().take(TRIES) {
        let guess = PeriodicGuess {
            shape: &last.shape,
            time: recurrence.time,
            angle: recurrence.angle,
            mirrored: recurrence.mirrored,
        };
        let Some(orbit) = PeriodicOrbit::find(body, &guess, &settings.flow()) else { continue };
        // Against the latest swing: an equilibrium, approached in a spiral, is a periodic orbit of no size.
        let away = align(body, &orbit.shape, &last.shape, false).distance / swing;
        if orbit.growth() < 1.0 && away < NEAR && !haunts_a_saddle(body, &orbit, settings) {
            return Some(shortest(body, orbit, recurrence, settings));
        }
    }
    None
}

/// Whether the orbit passes so near to a saddle that attracts as a cycle does that only the tolerance closes it.
fn haunts_a_saddle<B: Equivariant + ?Sized>(body: &B, orbit: &PeriodicOrbit, settings: &Settings) -> bool {
    let Ok(mut flow) = settings.method.shape_orbit(body, settings.control, 0.0, &orbit.shape) else {
        return false;
    };
    let request = settings.request(orbit.time, body.dim());
    let Ok(look) = Look::take(body, flow.as_mut(), orbit.time, &request, &mut ()) else { return false };
    attracting_saddle(body, &look.slowest, settings).is_some()
}

/// The same orbit with its shortest period: more returns than one may have been tried first.
fn shortest<B: Equivariant + ?Sized>(
    body: &B,
    orbit: PeriodicOrbit,
    recurrence: Recurrence,
    settings: &Settings,
) -> (PeriodicOrbit, Recurrence) {
    if recurrence.returns == 1 && (recurrence.mirrored || !body.is_symmetric()) {
        return (orbit, recurrence);
    }
    let found = || -> Option<(PeriodicOrbit, Recurrence)> {
        let mut flow = settings.method.shape_orbit(body, settings.control, 0.0, &orbit.shape).ok()?;
        let request = settings.request(2.2 * orbit.time, body.dim());
        let look = Look::take(body, flow.as_mut(), 2.2 * orbit.time, &request, &mut ()).ok()?;
        let diameter = look.diameter(body);
        let minima = look.minima();
        let (start, later) = minima.split_first()?;
        let images = if body.is_symmetric() { &[true, false][..] } else { &[false] };
        for (returns, minimum) in later.iter().enumerate() {
            for &mirrored in images {
                let near = align(body, &minimum.shape, &start.shape, mirrored);
                let time = minimum.t - start.t;
                let shorter = time < 0.75 * orbit.time || mirrored && !orbit.mirrored;
                if near.distance < 1e-2 * diameter && shorter {
                    let guess = PeriodicGuess { shape: &start.shape, time, angle: near.angle, mirrored };
                    let found = PeriodicOrbit::find(body, &guess, &settings.flow())?;
                    let recurrence = Recurrence { returns: returns + 1, mirrored, time, angle: near.angle };
                    return (found.growth() < 1.0).then_some((found, recurrence));
                }
            }
        }
        None
    };
    found().unwrap_or((orbit, recurrence))
}
