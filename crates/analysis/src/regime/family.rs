//! Equilibria and periodic orbits that lie in a family: neighbours are such motions as well.
//!
//! Where the equations have more symmetry than stated (a mode whose phase nothing fixes, bodies that do not act on each other) a multiplier
//! is 1, or an eigenvalue 0, that belongs to no symmetry which is divided out. Deviations along the family neither grow nor decay; what the body does is
//! the same on all of its members.

use super::settings::Settings;
use crate::equilibrium::{RelativeEquilibrium, along_group_and_flow};
use crate::linear::{add, basis, dot, norm};
use crate::lyapunov::SplitMix;
use crate::periodic::{PeriodicGuess, PeriodicOrbit};
use crate::symmetry::align;
use motiform_dynamics::{Equivariant, Watch};

/// Neighbouring orbits are looked for at this distance, against the size of the shape,
const BESIDE: f64 = 1e-3;

/// and neighbouring equilibria, which cost little, at this one: at a bifurcation Newton's method comes far closer than that,
const FARTHER: f64 = 1e-2;

/// and count as others where they are farther away than this part of it, across the flow and the group.
const OTHER: f64 = 0.03;

/// The orbit without the multipliers 1 of a family that it lies in; `None` where it is alone, or a multiplier stays undecided.
///
/// Newton's method takes the smallest step to an orbit: from a shape beside an orbit of a family it goes to another one of them, and back
/// to an orbit that is alone. The family must have as many dimensions as there are multipliers 1.
pub(super) fn within_family<B: Equivariant + ?Sized>(
    body: &B,
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

/// The equilibrium without the eigenvalues 0 of a family that it lies in; `None` where it is alone, or an eigenvalue stays undecided. As
/// [`within_family`].
pub(super) fn steady_within_family<B: Equivariant + ?Sized>(
    body: &B,
    found: &RelativeEquilibrium,
) -> Option<RelativeEquilibrium> {
    let zero = |(value, error): (&(f64, f64), &f64)| libm::hypot(value.0, value.1) <= *error;
    let free: Vec<bool> = found.eigenvalues.iter().zip(&found.errors).map(zero).collect();
    let count = free.iter().filter(|&&free| free).count();
    let size = norm(&found.shape);
    if count == 0 || size == 0.0 {
        return None;
    }
    let mut random = SplitMix(3);
    let mut away: Vec<Vec<f64>> = Vec::new();
    for _ in 0..count {
        let mut beside: Vec<f64> = found.shape.iter().map(|_| random.next()).collect();
        let factor = FARTHER * size / norm(&beside);
        beside.iter_mut().zip(&found.shape).for_each(|(x, u)| *x = u + factor * *x);
        let mut other = RelativeEquilibrium::find(body, &beside)?.shape;
        let turned = align(body, &other, &found.shape, false);
        body.rotate(turned.angle, &mut other);
        add(&mut other, -1.0, &found.shape);
        away.push(other);
    }
    let counts = |x: &&[f64]| (OTHER * FARTHER..2.0 * FARTHER).contains(&(norm(x) / size));
    let far: Vec<&[f64]> = away.iter().map(Vec::as_slice).filter(counts).collect();
    let kept = |place: &usize| !free[*place];
    let among: Vec<usize> = (0..free.len()).filter(kept).collect();
    let eigenvalues = among.iter().map(|&place| found.eigenvalues[place]).collect();
    let errors = among.iter().map(|&place| found.errors[place]).collect();
    let others = RelativeEquilibrium { eigenvalues, errors, ..found.clone() };
    (basis(&far, OTHER).len() == count && others.is_stable()).then_some(others)
}
