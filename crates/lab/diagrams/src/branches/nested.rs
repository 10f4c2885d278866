//! Orbits of a family for one value of the parameter.

use super::result::Sample;
use motiform_analysis::PeriodicOrbit;
use motiform_continuation::{Motion, Settings, same_motion};
use motiform_dynamics::Equivariant;

/// Part of the range by which the parameter of the orbits of a family may differ.
const FLAT: f64 = 1e-6;

/// An orbit between two others of a family is nearer to their mean than this part of their distance.
const NEAR: f64 = 0.1;

/// Returns `true` if an orbit lies between two neighbours of a family of orbits that all have one value of the parameter: there the
/// parameter tells nothing about which of them it is, and the mean of both, weighted by their sizes, does.
pub(super) fn nested(body: &dyn Equivariant, pair: &[Sample], sample: &Sample, settings: &Settings) -> bool {
    let [a, b] = pair else { return false };
    let (Some(first), Some(second)) = (a.point.motion.orbit(), b.point.motion.orbit()) else { return false };
    let width = FLAT * settings.width();
    let flat = |one: &Sample| (one.point.parameter - sample.point.parameter).abs() <= width;
    let (from, to) = (a.reading.size, b.reading.size);
    let part = (sample.reading.size - from) / (to - from);
    if !flat(a) || !flat(b) || !(0.0..=1.0).contains(&part) {
        return false;
    }
    let mean = Motion::Orbit { orbit: mean(first, second, part), nodes: Vec::new() };
    let apart = NEAR * (to - from).abs() / sample.reading.size;
    same_motion(body, &sample.point.motion, &mean, &settings.flow, apart)
}

/// The mean of two orbits, with this weight of the second one.
fn mean(first: &PeriodicOrbit, second: &PeriodicOrbit, part: f64) -> PeriodicOrbit {
    let mixed = |x: f64, y: f64| x + part * (y - x);
    let mut mean = first.clone();
    mean.shape.iter_mut().zip(&second.shape).for_each(|(x, &y)| *x = mixed(*x, y));
    mean.time = mixed(first.time, second.time);
    mean
}
