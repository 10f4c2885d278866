//! The end of transient chaos at a motion that is not chaotic: one notion for lives and for the chaotic saddle.

use motiform_analysis::equilibrium::REACHED;
use motiform_analysis::regime::Attractor;
use motiform_analysis::symmetry::reduced_speed;
use motiform_analysis::{RelativeEquilibrium, Verdict};
use motiform_dynamics::Model;
use motiform_dynamics::escape::norm;

/// A steady motion is sought, which takes time, only where the shape changes by less than this share of its size per model time.
const SLOW: f64 = 1e-2;

/// Looks for which the motion at the end may be examined: a transient that lasts for longer is not taken for a regular motion.
pub(crate) const LAST_LOOKS: f64 = 4.0;

/// The slowest rate (inverse model time) of the stable steady motion that a shape has come close to; `size`: that of a typical state.
pub(crate) fn captured(model: &dyn Model, shape: &[f64], size: f64) -> Option<f64> {
    let rate = model.rates(shape);
    if !is_slow(reduced_speed(model, shape, &rate), norm(shape), size) {
        return None;
    }
    let steady = RelativeEquilibrium::reached(model, shape, 0.1 * size)?;
    steady.is_stable().then(|| -steady.growth())
}

/// Returns `true` if a shape of this norm that changes at this speed may be close to a steady motion.
pub(crate) fn is_slow(speed: f64, norm: f64, size: f64) -> bool {
    speed <= SLOW * norm.max(0.1 * size)
}

/// The time in which this rate (inverse model time) brings an orbit from far away to where its capture is noticed.
pub(crate) fn way(rate: f64) -> f64 {
    -libm::log(REACHED) / rate
}

/// Returns `true` if a motion is neither steady nor chaotic.
pub(crate) fn is_regular(verdict: &Verdict) -> bool {
    matches!(verdict.attractor, Attractor::Periodic | Attractor::Torus | Attractor::Heteroclinic)
}
