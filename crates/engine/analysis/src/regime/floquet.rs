//! The exponents of a periodic orbit.
//!
//! `ln |m|/T` for each multiplier m. The matrix of a period has errors of about its accuracy times its largest entries: a multiplier that
//! is not far above them says nothing. In systems that are followed in all directions such exponents are
//! those of the parts of the period; in larger ones the leading exponents are computed.

use super::case::Case;
use crate::equilibrium::along_group_and_flow;
use crate::leading::leading_exponents;
use crate::multiple_shooting::all_exponents;
use crate::periodic::{PeriodicOrbit, is_whole};
use crate::{Estimate, sort_by_number};

/// Relative error of a multiplier from which on the parts of the period are asked.
const UNRESOLVED: f64 = 1e-3;

/// The same from which on an exponent is left out.
const LOST: f64 = 0.5;

/// The exponents of an orbit.
pub(super) struct Exponents {
    /// With those of its neutral directions, largest first.
    pub(super) all: Vec<Estimate>,
    /// The largest multiplier over the orbit's time, and its error.
    pub(super) growth: (f64, f64),
    /// The same as the leading exponent gives it: that of the matrix of a period may be round-off. `None` where that exponent is lost.
    pub(super) leading: Option<f64>,
}

/// The exponents of an orbit, and its largest multiplier: in large systems that of the leading exponent, whose directions are followed
/// until they are the leading ones.
pub(super) fn exponents(case: Case<'_>, orbit: &PeriodicOrbit) -> Exponents {
    let Case { body, settings, watch } = case;
    let (accuracy, time) = (settings.accuracy(), orbit.time);
    let neutral = along_group_and_flow(body, &orbit.shape).len();
    let mut all = vec![Estimate { value: 0.0, error: accuracy / time }; neutral];
    // what is missing are the neutral directions of a family that the orbit lies in
    let family = body.dim().saturating_sub(neutral + orbit.multipliers.len());
    let whole = is_whole(body.dim());
    all.extend(std::iter::repeat_n(all[0], if whole { family } else { 0 }));
    let of_period = orbit.multipliers.iter().zip(&orbit.errors).map(|(m, error)| {
        let size = libm::hypot(m.0, m.1);
        Estimate { value: libm::log(size) / time, error: error / size / time }
    });
    let mut others: Vec<Estimate> = of_period.collect();
    let unresolved = others.iter().any(|one| one.error * time > UNRESOLVED);
    if whole && family == 0 && unresolved {
        let finer = all_exponents(body, orbit, &settings.flow(), watch);
        others = finer.filter(|finer| finer.len() == others.len()).unwrap_or(others);
    } else if !whole {
        others = leading_exponents(body, orbit, &settings.flow(), watch).unwrap_or_default();
    }
    let known = |one: &Estimate| one.error * time < LOST && one.value.is_finite();
    let leading = others.iter().max_by(|a, b| a.value.total_cmp(&b.value)).copied().filter(known);
    let growth = leading.filter(|_| !whole).map_or((orbit.growth(), orbit.growth_error()), |leading| {
        let growth = libm::exp(leading.value * time);
        (growth, growth * leading.error * time)
    });
    others.retain(known);
    all.extend(others);
    sort_by_number(&mut all, |a| -a.value);
    Exponents { all, growth, leading: leading.map(|leading| libm::exp(leading.value * time)) }
}
