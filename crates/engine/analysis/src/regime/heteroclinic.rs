//! Is it a heteroclinic cycle? Rests near saddles that attract as a cycle.

use super::look::Rest;
use crate::SteadyMotion;
use crate::equilibrium::{RelativeEquilibrium, Saddle};
use crate::linear::norm;
use motiform_dynamics::Equivariant;

/// The evidence for a cycle.
#[derive(Clone, Debug)]
pub(super) struct Cycle {
    /// Rates at the saddle of the last rest.
    pub(super) saddle: Saddle,
    /// The shape there.
    pub(super) shape: Vec<f64>,
    /// Durations of the rests.
    pub(super) rests: Vec<f64>,
    /// Closest approach to a saddle, against the size of the shape.
    pub(super) closest: f64,
}

/// Rests that must be seen.
const LEAST_RESTS: usize = 3;

/// A rest that comes closer than this (against the shape's size) is ruled by the saddle alone.
const CLOSE: f64 = 1e-2;

/// A rest is at least one part in this many of the longest one: an orbit that leaves in a spiral slows down again at each turn.
const LONG: f64 = 8.0;

/// Finds a cycle of saddles that attracts: each of the last long rests is near a motionless saddle with one growing direction
/// or pair, and orbits leave it slower than they arrive (`lambda_+ + lambda_- < 0`). `None` where any of this does not hold.
///
/// The rests are those of all looks so far: near the end of a window one rest may be as long as a look. One of which only a part was
/// seen counts as well, but its duration is not told.
pub(super) fn cycle(body: &dyn Equivariant, rests: &[Rest]) -> Option<Cycle> {
    let longest = rests.iter().map(Rest::duration).fold(0.0, f64::max);
    let long: Vec<&Rest> = rests.iter().filter(|rest| LONG * rest.duration() >= longest).collect();
    let latest = &long[long.len().checked_sub(LEAST_RESTS)?..];
    let mut closest = f64::INFINITY;
    let mut found: Option<Saddle> = None;
    for rest in latest.iter().rev() {
        let (saddle, distance) = attracting_saddle(body, &rest.shape)?;
        closest = closest.min(distance);
        found.get_or_insert(saddle);
    }
    let saddle = found?;
    let shape = latest.last()?.shape.clone();
    let durations = long.iter().filter(|rest| rest.whole).map(|rest| rest.duration()).collect();
    Some(Cycle { saddle, shape, rests: durations, closest })
}

/// The motionless saddle beside `shape` that a cycle could attract by, with the distance to it (against its size).
///
/// No periodic orbit passes so near to one: the cycle itself attracts what does (Krupa and Melbourne 1995).
pub(super) fn attracting_saddle(body: &dyn Equivariant, shape: &[f64]) -> Option<(Saddle, f64)> {
    let equilibrium = RelativeEquilibrium::find(body, shape)?;
    let size = norm(&equilibrium.shape);
    let distance = equilibrium.distance(body, shape) / size.max(f64::MIN_POSITIVE);
    let saddle = equilibrium.saddle(body)?;
    let attracts = distance < CLOSE && saddle.attracts();
    let rests = |steady: SteadyMotion| !steady.moves() && !steady.turns();
    (attracts && rests(SteadyMotion::of(body, &equilibrium))).then_some((saddle, distance))
}
