//! Is a motion on a branch that was followed already?

use super::family::Bodies;
use super::nested::nested;
use super::result::{Followed, Leg, Sample};
use motiform_analysis::Isotropy;
use motiform_analysis::equilibrium::Units;
use motiform_continuation::{Branch, Motion, Settings, same_motion};
use motiform_dynamics::{Equivariant, Watch};

/// Two motions are one if they agree up to this part of their size: well above what Newton's method leaves, well below the distance
/// from a special point at which a new branch is entered.
const SAME: f64 = 1e-6;

/// Periods, speeds and sizes of neighbours on a branch that differ from the motion's by more than this part are of other motions.
const NEAR: f64 = 0.1;

/// Round-off, in the unit of what is compared.
const ROUND_OFF: f64 = 1e-12;

/// Sizes relative to which round-off is small.
struct Scales {
    parameter: f64,
    period: f64,
    size: f64,
    speed: f64,
}

impl Scales {
    /// The range, the units of the equations, and the speed of shapes of that size.
    fn of(body: &dyn Equivariant, units: Units, settings: &Settings) -> Self {
        Self {
            parameter: settings.width(),
            period: 1.0 / units.rate,
            size: units.length,
            speed: units.speed(body),
        }
    }
}

/// The branch that `sample` lies on, up to rotations, the mirror and time: the neighbours about its parameter, brought to the same value
/// of it by Newton's method, are compared.
pub(super) fn known(
    bodies: &Bodies<'_>,
    branches: &[Followed],
    sample: &Sample,
    settings: &Settings,
    watch: &dyn Watch,
) -> Option<usize> {
    let parameter = sample.point.parameter;
    let body = bodies.model(parameter).ok()?;
    let scales = Scales::of(body.as_ref(), bodies.units, settings);
    let is_here = |pair: &[Sample], neighbour: &Sample| {
        let between = between(pair, parameter);
        let found = moved(bodies, between.as_ref().unwrap_or(neighbour), parameter, settings, watch);
        found.is_some_and(|found| {
            !gained(body.as_ref(), &neighbour.point.motion, &found)
                && same_motion(body.as_ref(), &sample.point.motion, &found, &settings.flow, SAME)
                && (between.is_some() || leads_back(bodies, sample, neighbour, settings, watch))
        })
    };
    let far = |neighbour: &Sample| (neighbour.point.parameter - parameter).abs();
    let holds_leg = |leg: &Leg| {
        // where a leg ends at a motion of more symmetry, that is a motion of another branch
        let own = leg.samples.len() - usize::from(leg.meets());
        let is_near = |pair: &[Sample], place: usize| {
            let likes = (0..2).filter(|i| place + i < own && is_alike(&pair[*i], sample)).map(|i| &pair[i]);
            let nearest = likes.min_by(|a, b| far(a).total_cmp(&far(b)));
            nested(body.as_ref(), pair, sample, settings)
                || about(pair, sample, &scales) && nearest.is_some_and(|nearest| is_here(pair, nearest))
        };
        leg.samples.windows(2).enumerate().any(|(place, pair)| is_near(pair, place))
    };
    let holds = |branch: &Followed| branch.legs.iter().any(holds_leg);
    branches.iter().position(holds)
}

/// Returns `true` if Newton's method leads from a motion to its neighbour as well: beside a point where branches cross it may lead from
/// either to the same one of them.
fn leads_back(
    bodies: &Bodies<'_>,
    sample: &Sample,
    neighbour: &Sample,
    settings: &Settings,
    watch: &dyn Watch,
) -> bool {
    let there = neighbour.point.parameter;
    let (Ok(body), Some(found)) = (bodies.model(there), moved(bodies, sample, there, settings, watch)) else {
        return false;
    };
    same_motion(body.as_ref(), &neighbour.point.motion, &found, &settings.flow, SAME)
}

/// Returns `true` if Newton's method has led from a steady motion to one of more symmetry, which is on another branch.
fn gained(body: &dyn Equivariant, neighbour: &Motion, found: &Motion) -> bool {
    let (Motion::Equilibrium(neighbour), Motion::Equilibrium(found)) = (neighbour, found) else {
        return false;
    };
    let [before, now] = [neighbour, found].map(|one| Isotropy::of(body, &one.shape, Isotropy::SAME));
    now.circle && !before.circle
        || now.folds > before.folds
        || now.mirror.is_some() && before.mirror.is_none()
}

/// The steady motion between two neighbours on a branch by linear interpolation: beside a point where branches cross, Newton's method leads
/// from there to the same branch, and from one of the neighbours perhaps to the other.
fn between(pair: &[Sample], parameter: f64) -> Option<Sample> {
    let [a, b] = pair else { return None };
    let (Motion::Equilibrium(first), Motion::Equilibrium(second)) = (&a.point.motion, &b.point.motion) else {
        return None;
    };
    let part = (parameter - a.point.parameter) / (b.point.parameter - a.point.parameter);
    let mixed = |x: f64, y: f64| x + part * (y - x);
    let mut guess = first.clone();
    guess.shape.iter_mut().zip(&second.shape).for_each(|(x, &y)| *x = mixed(*x, y));
    guess.turning_rate = mixed(first.turning_rate, second.turning_rate);
    let mut between = a.clone();
    between.point.motion = Motion::Equilibrium(guess);
    part.is_finite().then_some(between)
}

/// Returns `true` if a neighbour may be the same motion at another parameter: near a pitchfork Newton's method leads from one steady motion
/// to another.
fn is_alike(neighbour: &Sample, sample: &Sample) -> bool {
    sample.point.motion.orbit().is_some() || neighbour.reading.motion == sample.reading.motion
}

/// Returns `true` if the motion may lie between two neighbours.
fn about(pair: &[Sample], sample: &Sample, scales: &Scales) -> bool {
    let within = |read: &dyn Fn(&Sample) -> f64, part: f64, scale: f64| {
        let (a, b, x) = (read(&pair[0]), read(&pair[1]), read(sample));
        let room = part * x.abs() + ROUND_OFF * scale;
        a.min(b) - room <= x && x <= a.max(b) + room
    };
    let kind = |sample: &Sample| sample.point.motion.orbit().map(|orbit| orbit.mirrored);
    kind(&pair[0]) == kind(sample)
        && within(&|sample| sample.point.parameter, ROUND_OFF, scales.parameter)
        && within(&|sample| sample.reading.period.unwrap_or(0.0), NEAR, scales.period)
        && within(&|sample| sample.reading.size, NEAR, scales.size)
        && within(&|sample| sample.reading.speed[0], NEAR, scales.speed)
}

/// A motion of a neighbouring body as one of the body at `parameter`: the first point of the branch through it.
pub(super) fn moved(
    bodies: &Bodies<'_>,
    neighbour: &Sample,
    parameter: f64,
    settings: &Settings,
    watch: &dyn Watch,
) -> Option<Motion> {
    let branch = match &neighbour.point.motion {
        Motion::Equilibrium(near) => Branch::of_equilibria(bodies, parameter, near, settings, watch),
        Motion::Orbit { orbit: near, .. } => Branch::of_orbits(bodies, parameter, near, settings, watch),
    };
    Some(branch.ok()?.next()?.motion)
}
