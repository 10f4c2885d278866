//! The error that the place of an orbit adds to its multipliers.

use crate::linear::{add, norm};
use crate::lyapunov::SplitMix;
use crate::periodic::{Flow, PeriodicGuess, PeriodicOrbit, is_whole};
use motiform_dynamics::{Equivariant, Watch};

/// A multiplier this near to 1 makes the place of an orbit uncertain.
const NEAR_ONE: f64 = 0.05;

/// Distance of the other starts, in units of what the residual allows.
pub(super) const BESIDE: f64 = 8.0;

/// Errors in units of the change between the starts.
const SAFE: f64 = 2.0;

/// Their largest distance, as a part of the size of the shape.
const FARTHEST: f64 = 0.01;

/// Shapes that differ by less than this part of their size are one.
const THERE: f64 = 1e-9;

/// The orbit that Newton's method finds from a guess, with errors of its multipliers that hold what its place adds; it integrates no more
/// than `effort` of model time, and takes what it integrated from it.
///
/// A residual r leaves the place uncertain by r/|1 - m| for a multiplier m. Near a fold m changes with the place, and r may be small where
/// there is no orbit at all. Newton's method from both sides of the orbit, as far off as the largest residual allows, finds the same
/// multipliers or it does not.
pub(super) fn find_placed(
    body: &dyn Equivariant,
    guess: &PeriodicGuess<'_>,
    flow: &Flow,
    effort: &mut f64,
    watch: &dyn Watch,
) -> Option<PeriodicOrbit> {
    let orbit = PeriodicOrbit::find_within(body, guess, flow, effort, watch)?;
    let nearest = nearest(&orbit);
    if nearest >= NEAR_ONE || !is_whole(body.dim()) || orbit.errors.is_empty() {
        return Some(orbit);
    }
    let size = norm(&orbit.shape);
    let far = size * (BESIDE * flow.closed() / nearest.max(flow.accuracy())).min(FARTHEST);
    let direction = slow_direction(guess.shape, &orbit.shape);
    let scale = far / norm(&direction);
    let mut off = vec![0.0_f64; orbit.errors.len()];
    for side in [scale, -scale] {
        let mut shape = orbit.shape.clone();
        add(&mut shape, side, &direction);
        let PeriodicOrbit { time, angle, mirrored, .. } = orbit;
        let guess = PeriodicGuess { shape: &shape, time, angle, mirrored };
        let found = PeriodicOrbit::find_within(body, &guess, flow, effort, watch);
        let found = found.filter(|found| found.multipliers.len() == off.len());
        let Some(found) = found else { continue }; // a start in general position may miss an orbit that rests for long
        let changes =
            found.multipliers.iter().zip(&orbit.multipliers).map(|(a, b)| modulus(*a) - modulus(*b));
        off.iter_mut().zip(changes).for_each(|(off, change)| *off = off.max(change.abs()));
    }
    let errors = orbit.errors.iter().zip(&off).map(|(error, off)| error.max(SAFE * off)).collect();
    Some(PeriodicOrbit { errors, ..orbit })
}

/// The distance `|1 - m|` of the nearest multiplier from 1; infinite without one.
fn nearest(orbit: &PeriodicOrbit) -> f64 {
    orbit.multipliers.iter().map(|m| libm::hypot(1.0 - m.0, m.1)).fold(f64::INFINITY, f64::min)
}

/// The distance of the shape from the orbit that its residual r leaves: `r/|1 - m|` for the multiplier m nearest to 1.
pub(super) fn displaced(orbit: &PeriodicOrbit) -> f64 {
    orbit.residual / nearest(orbit).min(1.0)
}

/// The direction from the orbit to where the motion was, which shrinks most slowly; one in general position where the motion was there.
fn slow_direction(was: &[f64], orbit: &[f64]) -> Vec<f64> {
    let mut direction = was.to_vec();
    add(&mut direction, -1.0, orbit);
    if norm(&direction) > THERE * norm(orbit) {
        return direction;
    }
    let mut random = SplitMix(7);
    orbit.iter().map(|_| random.next()).collect()
}

fn modulus(m: (f64, f64)) -> f64 {
    libm::hypot(m.0, m.1)
}
