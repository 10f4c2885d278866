//! Periodic orbits that lie in a family: neighbours are such motions as well.
//!
//! Where the equations have more symmetry than stated (a mode whose phase nothing fixes, bodies that do not act on each other) a multiplier
//! is 1 that belongs to no symmetry which is divided out. Deviations along the family neither grow nor decay; what the body does is
//! the same on all of its members. (For equilibria: [`crate::RelativeEquilibrium::across_family`].) The orbits around a centre are no such
//! family: they differ in size, period or speed, and a disturbance changes what the body does for good.

use super::case::Case;
use crate::equilibrium::along_group_and_flow;
use crate::linear::{add, basis, dot, norm};
use crate::lyapunov::SplitMix;
use crate::periodic::{PeriodicGuess, PeriodicOrbit};
use crate::symmetry::align;
use motiform_dynamics::VectorField;
use motiform_dynamics::drive::drive;
use motiform_dynamics::model::velocity;

/// Neighbouring orbits are looked for at this distance, against the size of the shape or the extent of the orbit, whichever is smaller:
/// from farther away a shift along a bent orbit looks like a step across it,
const BESIDE: f64 = 1e-3;

/// and count as others where they are farther away than this part of it, across the flow and the group.
const OTHER: f64 = 0.03;

/// Newton's method leaves about this part of the residual at which an orbit counts as closed; neighbours that are no farther away say
/// nothing.
const LEFT: f64 = 0.1;

/// Members do the same where it differs by less than this part of their distance, both relative.
const ALIKE: f64 = 0.03;

/// The square of a speed below this part of that of the rate of the shape is round-off.
const NOTHING: f64 = 1e-20;

/// Moments of a period that means are taken over.
const MOMENTS: usize = 256;

/// The orbit without the multipliers 1 of a family that it lies in; `None` where it is alone, or a multiplier stays undecided.
///
/// Newton's method takes the smallest step to an orbit: from a shape beside an orbit of a family it goes to another one of them, and back
/// to an orbit that is alone. The family must have as many dimensions as there are multipliers 1, and its members must do the same.
pub(super) fn within_family(
    case: Case<'_>,
    orbit: &PeriodicOrbit,
    effort: &mut f64,
) -> Option<PeriodicOrbit> {
    let Case { body, settings, watch } = case;
    let neutral = |(m, error): (&(f64, f64), &f64)| libm::hypot(m.0 - 1.0, m.1) <= *error;
    let free: Vec<bool> = orbit.multipliers.iter().zip(&orbit.errors).map(neutral).collect();
    let count = free.iter().filter(|&&free| free).count();
    if count == 0 {
        return None;
    }
    let done = Done::of(case, orbit)?;
    let whole = norm(&orbit.shape);
    let size = whole.min(done.extent);
    if OTHER * BESIDE * size <= LEFT * settings.flow().closed() * whole {
        return None;
    }
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
        let same = |far: f64| Done::of(case, &other).is_some_and(|other| done.differs(&other) <= ALIKE * far);
        let mut away = other.shape.clone();
        add(&mut away, -1.0, &orbit.shape);
        for direction in &own {
            let along = dot(direction, &away);
            add(&mut away, -along, direction);
        }
        let far = norm(&away);
        if far > OTHER * BESIDE * size && !same(far / size) {
            return None;
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

/// The motion of a body along a periodic orbit, as numbers that no symmetry changes.
struct Done {
    /// The period, and the means of the squares of the speed and of the rate of the shape.
    numbers: [f64; 3],
    /// The largest distance of its shapes from the first one, rotations divided out.
    extent: f64,
}

impl Done {
    fn of(case: Case<'_>, orbit: &PeriodicOrbit) -> Option<Self> {
        let (body, mut flow) = (case.body, case.orbit(&orbit.shape).ok()?);
        let mut rate = vec![0.0; body.dim()];
        let (mut speed, mut change, mut extent) = (0.0, 0.0, 0.0_f64);
        for moment in 1..=MOMENTS {
            let t = orbit.time * moment as f64 / MOMENTS as f64;
            drive(flow.as_mut(), &case.request(t), &mut ()).ok()?;
            let [x, y] = velocity(body, flow.state());
            VectorField::<f64>::eval(body, 0.0, flow.state(), &mut rate);
            speed += (x * x + y * y) / MOMENTS as f64;
            change += dot(&rate, &rate) / MOMENTS as f64;
            extent = extent.max(align(body, flow.state(), &orbit.shape, false).distance);
        }
        Some(Self { numbers: [orbit.time, speed, change], extent })
    }

    /// The largest relative difference; that of speeds which are nothing beside the rate of the shape is none.
    fn differs(&self, other: &Self) -> f64 {
        let rests = NOTHING * self.numbers[2].max(other.numbers[2]);
        let against = |a: f64, b: f64| a.max(b).max(rests).max(f64::MIN_POSITIVE);
        let pairs = self.numbers.iter().zip(&other.numbers);
        pairs.map(|(&a, &b)| (a - b).abs() / against(a, b)).fold(0.0, f64::max)
    }
}
