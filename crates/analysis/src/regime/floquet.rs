//! The exponents of a periodic orbit.
//!
//! `ln |m|/T` for each multiplier m. The matrix of a period has errors of about its accuracy times its largest entries: a multiplier that
//! is not far above them says nothing. Such multipliers are computed once more, from the maps of the parts of the period.

use super::settings::Settings;
use crate::lyapunov::{LyapunovSettings, lyapunov};
use crate::multiple_shooting::with_multipliers;
use crate::periodic::{PeriodicOrbit, is_whole};
use crate::{Estimate, Result};
use motiform_dynamics::{Equivariant, Outcome, Watch};

/// Relative error of a multiplier from which on the parts of the period are asked.
const UNRESOLVED: f64 = 1e-3;

/// The same from which on it is lost in the flow of a part, and its exponent is measured along the orbit.
const LOST: f64 = 0.5;

/// Periods in which vectors turn their way before that.
const SETTLING: f64 = 6.0;

/// The exponents of an orbit with those of its neutral directions, largest first.
pub(super) fn exponents<B: Equivariant + ?Sized>(
    body: &B,
    orbit: &PeriodicOrbit,
    settings: &Settings,
    watch: &dyn Watch,
) -> Result<Vec<Estimate>> {
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
    let mut lost = false;
    for (m, error) in best.multipliers.iter().zip(&best.errors) {
        let size = libm::hypot(m.0, m.1);
        let relative = error / size;
        if relative < LOST {
            all.push(Estimate { value: libm::log(size) / time, error: relative / time });
        } else {
            lost = true;
        }
    }
    all.sort_by(|a, b| b.value.total_cmp(&a.value));
    if lost && is_whole(body.dim()) {
        let measured = measured(body, orbit, settings, watch)?;
        all.extend(measured.into_iter().skip(all.len()));
    }
    Ok(all)
}

/// All exponents along the orbit, where vectors are kept orthogonal; none where it could not be followed. The error is the change from one period
/// to the next.
fn measured<B: Equivariant + ?Sized>(
    body: &B,
    orbit: &PeriodicOrbit,
    settings: &Settings,
    watch: &dyn Watch,
) -> Result<Vec<Estimate>> {
    let run = LyapunovSettings {
        count: body.dim(),
        method: settings.method,
        control: settings.control,
        transient: SETTLING * orbit.time,
        span: 2.0 * orbit.time,
        escape_norm: settings.escape_norm,
        max_steps: settings.max_steps,
    };
    let found = lyapunov(body, &orbit.shape, &run, watch)?;
    if !matches!(found.outcome, Outcome::Completed { .. }) {
        return Ok(Vec::new());
    }
    let half = found.transient + 0.5 * found.time;
    let mean = |i: usize, part: &dyn Fn(f64) -> bool| {
        let (mut growth, mut length, mut from) = (0.0, 0.0, found.transient);
        for (end, rates) in &found.history {
            if part(*end) {
                growth += rates[i] * (end - from);
                length += end - from;
            }
            from = *end;
        }
        growth / length
    };
    let estimate = |i: usize| {
        let change = mean(i, &|end| end > half) - mean(i, &|end| end <= half);
        let error = change.abs().max(settings.accuracy() / orbit.time);
        Estimate { value: mean(i, &|_| true), error }
    };
    let mut all: Vec<Estimate> = (0..body.dim()).map(estimate).filter(|e| e.error.is_finite()).collect();
    all.sort_by(|a, b| b.value.total_cmp(&a.value));
    Ok(all)
}
