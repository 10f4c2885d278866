//! Periodic orbits that lie in a family: neighbours are such motions as well.
//!
//! Where the equations have more symmetry than stated (a mode whose phase nothing fixes, bodies that do not act on each other) a multiplier
//! is 1 that belongs to no symmetry which is divided out. Deviations along the family neither grow nor decay; what the body does is
//! the same on all of its members. (For equilibria: [`crate::RelativeEquilibrium::across_family`].)

use super::settings::Settings;
use crate::equilibrium::along_group_and_flow;
use crate::linear::{add, basis, dot, norm};
use crate::lyapunov::SplitMix;
use crate::periodic::{PeriodicGuess, PeriodicOrbit};
use motiform_dynamics::{Equivariant, Watch};

/// Neighbouring orbits are looked for at this distance, against the size of the shape,
const BESIDE: f64 = 1e-3;

/// and count as others where they are farther away than this part of it, across the flow and the group.
const OTHER: f64 = 0.03;

/// The orbit without the multipliers 1 of a family that it lies in; `None` where it is alone, or a multiplier stays undecided.
///
/// Newton's method takes the smallest step to an orbit: from a shape beside an orbit of a family it goes to another one of them, and back
/// to an orbit that is alone. The family must have as many dimensions as there are multipliers 1.
pub(super) fn within_family(
    body: &dyn Equivariant,
    orbit: &PeriodicOrbit,
    settings: &Settings,
    effort: &mut f64,
    watch: &dyn Watch,
) -> Option<PeriodicOrbit> {
    let neutral = |(m, error): (&(f64, f64), &f64)| libm::hypot(m.0 - 1.0, m.1) <= *error;
    let free: Vec<bool> = orbit.multipliers.iter().zip(&orbit.errors).map(neutral).collect();
    let count = free.iter().filter(|&&free| free).count();
    if count == 0 {
        return None;
    }
    let size = norm(&orbit.shape);
    let own = along_group_and_flow(body, &orbit.shape);
    let mut random = SplitMix(3);
    let mut found: Vec<Vec<f64>> = Vec::new();
    for _ in 0..count {
        let mut beside: Vec<f64> = orbit.shape.iter().map(|_| random.next()).collect();
        let factor = BESIDE * size / norm(&beside);
        beside.iter_mut().zip(&orbit.shape).for_each(|(x, u)| *x = u + factor * *x);
        let PeriodicOrbit { time, angle, mirrored, .. } = *orbit;
        let guess = PeriodicGuess { shape: &beside, time, angle, mirrored };
        let other = PeriodicOrbit::find_within(body, &guess, &settings.flow(), effort, watch)?;
        let mut away = other.shape;
        add(&mut away, -1.0, &orbit.shape);
        for direction in &own {
            let along = dot(direction, &away);
            add(&mut away, -along, direction);
        }
        found.push(away);
    }
    let far: Vec<&[f64]> =
        found.iter().map(Vec::as_slice).filter(|x| norm(x) > OTHER * BESIDE * size).collect();
    let kept = |values: &[(f64, f64)]| {
        values.iter().zip(&free).filter(|(_, free)| !**free).map(|(x, _)| *x).collect()
    };
    let errors = orbit.errors.iter().zip(&free).filter(|(_, free)| !**free).map(|(x, _)| *x).collect();
    let others = PeriodicOrbit { multipliers: kept(&orbit.multipliers), errors, ..orbit.clone() };
    (basis(&far, OTHER).len() == count && others.is_stable()).then_some(others)
}
