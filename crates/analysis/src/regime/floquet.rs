//! The exponents of a periodic orbit.
//!
//! `ln |m|/T` for each multiplier m. The matrix of a period has errors of about its accuracy times its largest entries: a multiplier that
//! is not far above them says nothing. Such multipliers are computed once more, from the maps of the parts of the period.

use super::settings::Settings;
use crate::Estimate;
use crate::multiple_shooting::with_multipliers;
use crate::periodic::PeriodicOrbit;
use motiform_dynamics::{Equivariant, Watch};

/// Relative error of a multiplier from which on the parts of the period are asked.
const UNRESOLVED: f64 = 1e-3;

/// The same from which on an exponent is left out.
const LOST: f64 = 0.5;

/// The exponents of an orbit with those of its neutral directions, largest first.
pub(super) fn exponents<B: Equivariant + ?Sized>(
    body: &B,
    orbit: &PeriodicOrbit,
    settings: &Settings,
    watch: &dyn Watch,
) -> Vec<Estimate> {
    let (accuracy, time) = (settings.accuracy(), orbit.time);
    let neutral = if body.symmetry().rotations { 2 } else { 1 };
    let mut all = vec![Estimate { value: 0.0, error: accuracy / time }; neutral];
    // what is missing are the neutral directions of a family that the orbit lies in
    let family = body.dim().saturating_sub(neutral + orbit.multipliers.len());
    if orbit.errors.iter().all(|error| error.is_finite()) {
        all.extend(std::iter::repeat_n(all[0], family));
    }
    let resolved = |orbit: &PeriodicOrbit| {
        orbit
            .multipliers
            .iter()
            .zip(&orbit.errors)
            .all(|(m, error)| *error <= UNRESOLVED * libm::hypot(m.0, m.1))
    };
    let finer = (family == 0 && !resolved(orbit))
        .then(|| with_multipliers(body, orbit.clone(), &settings.flow(), watch))
        .filter(|finer| finer.multipliers.len() == orbit.multipliers.len());
    let best = finer.as_ref().unwrap_or(orbit);
    for (m, error) in best.multipliers.iter().zip(&best.errors) {
        let size = libm::hypot(m.0, m.1);
        let relative = error / size;
        if relative < LOST {
            all.push(Estimate { value: libm::log(size) / time, error: relative / time });
        }
    }
    all.sort_by(|a, b| b.value.total_cmp(&a.value));
    all
}
