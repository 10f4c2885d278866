//! A start beside a special point.

use super::family::Bodies;
use super::settle::Start;
use motiform_analysis::linear::{add, norm};
use motiform_analysis::{Isotropy, PeriodicOrbit, RelativeEquilibrium};
use motiform_continuation::Settings;
use motiform_dynamics::{Equivariant, Watch};

/// Distances from the special point, as parts of the range.
const ASIDE: [f64; 3] = [2e-3, 2e-4, 2e-5];

/// Largest change of a shape, or of the time of an orbit, as a part of it, for which the motion beside the point is the same one.
const SAME: f64 = 0.2;

/// Two orbits are one if they agree up to this part: well above what Newton's method leaves.
const ONE: f64 = 1e-6;

/// The same motion at a value of the parameter beside that of a special point.
///
/// At the point itself a critical level is 0, so that neither side of a branch that begins there shows a change: the point would be missing
/// on it. From a start near the point, one of the two sides passes it. If no such motion is found near it, the start itself is returned.
pub(super) fn aside(
    bodies: &Bodies<'_>,
    parameter: f64,
    start: Start,
    settings: &Settings,
    watch: &dyn Watch,
) -> (f64, Start) {
    let (low, high) = settings.range;
    let inwards = if parameter > 0.5 * (low + high) { -1.0 } else { 1.0 };
    for part in ASIDE {
        for side in [inwards, -inwards] {
            let there = parameter + side * part * (high - low);
            let inside = low <= there && there <= high;
            if let Some(found) = moved(bodies, there, &start, settings, watch).filter(|_| inside) {
                return (there, found);
            }
        }
    }
    (parameter, start)
}

fn moved(
    bodies: &Bodies<'_>,
    there: f64,
    start: &Start,
    settings: &Settings,
    watch: &dyn Watch,
) -> Option<Start> {
    let body = bodies.model(there).ok()?;
    match start {
        Start::Equilibrium(old) => {
            let new = RelativeEquilibrium::find(body.as_ref(), &old.shape)?;
            is_same(body.as_ref(), &old.shape, &new.shape).then_some(Start::Equilibrium(new))
        }
        Start::Orbit(old) => {
            let flow = &settings.flow;
            let new = PeriodicOrbit::near(body.as_ref(), &old.shape, old.time, old.mirrored, flow, watch)?;
            let lasts = (new.time - old.time).abs() <= SAME * old.time && new.mirrored == old.mirrored;
            let same =
                lasts && is_near(&old.shape, &new.shape) && !is_twice(body.as_ref(), &new, settings, watch);
            same.then_some(Start::Orbit(new))
        }
    }
}

/// Returns `true` for an orbit of half the time that is passed twice: where a period doubling is close, Newton's method may lead to it.
fn is_twice(body: &dyn Equivariant, orbit: &PeriodicOrbit, settings: &Settings, watch: &dyn Watch) -> bool {
    let half = 0.5 * orbit.time;
    let found = PeriodicOrbit::near(body, &orbit.shape, half, orbit.mirrored, &settings.flow, watch);
    found.is_some_and(|found| {
        let mut apart = found.shape.clone();
        add(&mut apart, -1.0, &orbit.shape);
        norm(&apart) <= ONE * norm(&orbit.shape) && (found.time - half).abs() <= ONE * half
    })
}

/// Returns `true` for two shapes of the same symmetry that are close to each other.
fn is_same(body: &dyn Equivariant, old: &[f64], new: &[f64]) -> bool {
    let symmetry = |shape: &[f64]| {
        let Isotropy { folds, circle, mirror } = Isotropy::of(body, shape, Isotropy::SAME);
        (folds, circle, mirror.is_some())
    };
    symmetry(old) == symmetry(new) && is_near(old, new)
}

fn is_near(old: &[f64], new: &[f64]) -> bool {
    let mut change = new.to_vec();
    add(&mut change, -1.0, old);
    norm(&change) <= (SAME * norm(old)).max(f64::EPSILON)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may fail")]

    use super::*;
    use motiform_models::zoo::VanDerPol;

    /// Van der Pol's cycle, of which the period is published (Andersen and Geer 1982), passed once and twice.
    #[test]
    fn a_cycle_that_is_passed_twice_is_told_from_one_that_is_passed_once() {
        let (body, period, settings) =
            (VanDerPol { mu: 1.0 }, 6.663_286_859_323_13, Settings::over(0.0, 1.0));
        let turns = |turns: f64| {
            let (shape, time) = ([2.008_619_860_874_84, 0.0], turns * period);
            PeriodicOrbit::near(&body, &shape, time, false, &settings.flow, &()).unwrap()
        };
        assert!(!is_twice(&body, &turns(1.0), &settings, &()));
        let twice = turns(2.0);
        assert!((twice.time - 2.0 * period).abs() < 1e-8 && is_twice(&body, &twice, &settings, &()));
    }
}
