//! The end of transient chaos at a motion that is not chaotic: one notion for lives and for the chaotic saddle.

use motiform_analysis::equilibrium::REACHED;
use motiform_analysis::regime::Attractor;
use motiform_analysis::{RelativeEquilibrium, Verdict};
use motiform_dynamics::Model;
use motiform_dynamics::escape::norm;

/// A steady motion is sought, which takes time, only where the first step of Newton's method is no longer than so many times the distance
/// of a capture.
const STEP: f64 = 10.0;

/// Looks for which the motion at the end may be examined: a transient that lasts for longer is not taken for a regular motion.
pub(crate) const LAST_LOOKS: f64 = 4.0;

/// The stable steady motion that a shape has come close to; `size`: that of a typical state. Both are measured in the units of the
/// equations: a steady motion is close or not whatever the unit of length or time.
pub(crate) fn captured(model: &dyn Model, shape: &[f64], size: f64) -> Option<RelativeEquilibrium> {
    let step = RelativeEquilibrium::first_step(model, shape)?;
    let may_be_close = step <= STEP * REACHED * norm(shape).max(0.1 * size);
    let steady = may_be_close.then(|| RelativeEquilibrium::reached(model, shape, 0.1 * size))??;
    steady.is_stable().then_some(steady)
}

/// The speed of the reduced shape at the distance of a capture, where the slowest deviation is left.
pub(crate) fn slow(steady: &RelativeEquilibrium, size: f64) -> f64 {
    let rate = steady.eigenvalues.first().map_or(0.0, |(re, im)| libm::hypot(*re, *im));
    rate * REACHED * norm(&steady.shape).max(0.1 * size)
}

/// The time in which this rate (inverse model time) brings an orbit from far away to where its capture is noticed.
pub(crate) fn way(rate: f64) -> f64 {
    -libm::log(REACHED) / rate
}

/// Returns `true` if a motion is neither steady nor chaotic.
pub(crate) fn is_regular(verdict: &Verdict) -> bool {
    matches!(verdict.attractor, Attractor::Periodic | Attractor::Torus | Attractor::Heteroclinic)
}
