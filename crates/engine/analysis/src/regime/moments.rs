//! Shapes of a periodic orbit at moments that are spread over its period.

use super::case::Case;
use super::place::{BESIDE, displaced};
use crate::isotropy::Isotropy;
use crate::linear::norm;
use crate::periodic::PeriodicOrbit;
use crate::symmetry::align;
use motiform_dynamics::Equivariant;
use motiform_dynamics::drive::drive;

/// Moments of a period.
const MOMENTS: usize = 8;

/// The symmetry that every shape of the orbit has: that of some moments, spread over the period. (A zigzag
/// that rests near a straight motion is nearly symmetric there, and only there.)
pub(super) fn symmetry_of(
    case: Case<'_>,
    orbit: &PeriodicOrbit,
) -> Result<Isotropy, motiform_dynamics::Error> {
    let shapes = moments(case, orbit)?;
    Ok(common_symmetry(case.body, std::iter::once(&orbit.shape).chain(&shapes)))
}

/// The symmetry that every one of these shapes has.
pub(super) fn common_symmetry<'s>(
    body: &dyn Equivariant,
    shapes: impl IntoIterator<Item = &'s Vec<f64>>,
) -> Isotropy {
    let all = shapes.into_iter().map(|shape| Isotropy::of(body, shape, Isotropy::SAME));
    let common = |a: Isotropy, b: Isotropy| Isotropy {
        mirror: a.mirror.filter(|_| b.mirror.is_some()),
        circle: a.circle && b.circle,
        folds: if a.folds == b.folds { a.folds } else { 1 },
    };
    all.reduce(common).unwrap_or(Isotropy { folds: 1, circle: false, mirror: None })
}

/// Shapes at moments that are spread over the period, after the first one.
fn moments(case: Case<'_>, orbit: &PeriodicOrbit) -> Result<Vec<Vec<f64>>, motiform_dynamics::Error> {
    let mut flow = case.orbit(&orbit.shape)?;
    (1..MOMENTS)
        .map(|moment| {
            let t = orbit.time * moment as f64 / MOMENTS as f64;
            drive(flow.as_mut(), &case.request(t), &mut ())?;
            Ok(flow.state().to_vec())
        })
        .collect()
}

/// Returns `true` if the orbit is an equilibrium within its errors: those of the steps, which swing, too, and that of its own place. A
/// spiral into an equilibrium nearly comes back to its section; where it shrinks slowly, the residual of a turn is small against the shape,
/// and not against the spiral.
pub(super) fn is_a_point(case: Case<'_>, orbit: &PeriodicOrbit) -> bool {
    let least = (case.settings.hovering() * norm(&orbit.shape)).max(BESIDE * displaced(orbit));
    let near = |shape: &Vec<f64>| align(case.body, shape, &orbit.shape, false).distance <= least;
    moments(case, orbit).is_ok_and(|shapes| shapes.iter().all(near))
}
