//! The work: curves followed one after the other, from the special points of branches.

use super::crossing::{Target, passes};
use super::family::PlaneBodies;
use super::result::{CurveLeg, CurveSample, Curves, FollowedCurve};
use crate::branches::family::{Bodies, lasting};
use crate::branches::follow::follow_kept;
use crate::branches::result::{Branches, Sample};
use crate::settles::settles;
use motiform_continuation::{Allowance, Curve, CurvePoint, Degenerate, End, Motion, Point, Special};
use motiform_dynamics::{Part, Watch};
use motiform_lab::pool::each;
use motiform_study::curves::CurveKind;
use motiform_study::{CurvePlan, Error};

/// The share of the branches in the progress of the work.
const BRANCHES: f64 = 0.2;

/// Follows the branches of a plan and then the curves, after those that `before` holds of an interrupted run. The two directions of a
/// curve are followed at the same time; the numbers do not depend on that.
///
/// Interrupted by the watch, the result is not complete and holds the curves that were followed to both ends.
///
/// # Errors
/// As [`crate::branches::follow()`].
pub fn follow_curves(plan: &CurvePlan, before: Option<Curves>, watch: &dyn Watch) -> Result<Curves, Error> {
    follow_curves_kept(plan, before, &mut |_| Ok(()), watch)
}

/// As [`follow_curves`]; `keep` gets what there is after each branch and each curve, all of it whole.
///
/// # Errors
/// As [`follow_curves`], and those of `keep`.
pub fn follow_curves_kept(
    plan: &CurvePlan,
    before: Option<Curves>,
    keep: &mut dyn FnMut(&Curves) -> Result<(), Error>,
    watch: &dyn Watch,
) -> Result<Curves, Error> {
    let (branches, curves) = before.map_or((None, Vec::new()), |found| (Some(found.branches), found.curves));
    let part = Part { watch, from: 0.0, to: BRANCHES };
    let branches = match branches {
        Some(branches) if branches.complete => branches,
        begun => {
            let mut kept = |branches: &Branches| {
                keep(&Curves { branches: branches.clone(), curves: curves.clone(), complete: false })
            };
            follow_kept(&plan.branches(), begun, &mut kept, &(), &part)?
        }
    };
    let mut done = Curves { complete: branches.complete, branches, curves };
    if !done.complete {
        return Ok(done);
    }
    let starts = starts(plan, &done.branches);
    for (number, (kind, start)) in starts.iter().enumerate() {
        let (from, to) = (number as f64 / starts.len() as f64, (number + 1) as f64 / starts.len() as f64);
        let place = |x: f64| BRANCHES + (1.0 - BRANCHES) * x;
        let part = Part { watch, from: place(from), to: place(to) };
        part.progress(0.0);
        if done.begun(*start) || done.passes(plan, *kind, *start) {
            continue;
        }
        match follow_curve(plan, &done.branches, *kind, *start, &part) {
            Ok(followed) => {
                done.curves.push(followed);
                keep(&done)?;
            }
            Err(Error::Interrupted) => {
                done.complete = false;
                return Ok(done);
            }
            Err(error) => return Err(error),
        }
    }
    Ok(done)
}

/// The special points to follow, branch by branch.
fn starts(plan: &CurvePlan, found: &Branches) -> Vec<(CurveKind, [usize; 3])> {
    let of = |name: &str| plan.computation.kinds.iter().find(|kind| kind.name() == name);
    let start = |(place, sample): ([usize; 3], &Sample)| Some((*of(sample.point.special?.name())?, place));
    found.samples().filter_map(start).collect()
}

/// The curve through a special point of a branch, to both sides at once.
///
/// # Errors
/// [`Error::Interrupted`]; an unknown model. Where the curve cannot be followed, it says why.
pub fn follow_curve(
    plan: &CurvePlan,
    found: &Branches,
    kind: CurveKind,
    start: [usize; 3],
    watch: &dyn Watch,
) -> Result<FollowedCurve, Error> {
    curve_within(plan, found, kind, start, None, watch)
}

/// As [`follow_curve`]; no more is spent on orbits than the allowance, one half of it to each side: a side on which that is spent ends with
/// [`End::Spent`], and one that winds about a connection with [`End::Settles`].
///
/// # Errors
/// As [`follow_curve`].
pub fn follow_curve_within(
    plan: &CurvePlan,
    found: &Branches,
    kind: CurveKind,
    start: [usize; 3],
    allowance: &Allowance,
    watch: &dyn Watch,
) -> Result<FollowedCurve, Error> {
    let half = allowance.left().div_ceil(2);
    let sides = [Allowance::of(half), Allowance::of(half)];
    let followed = curve_within(plan, found, kind, start, Some(&sides), watch);
    allowance.spend(sides.iter().map(|side| half - side.left()).sum());
    followed
}

fn curve_within(
    plan: &CurvePlan,
    found: &Branches,
    kind: CurveKind,
    start: [usize; 3],
    sides: Option<&[Allowance; 2]>,
    watch: &dyn Watch,
) -> Result<FollowedCurve, Error> {
    let mut followed = FollowedCurve { kind, start, legs: Vec::new(), sought: Vec::new(), refused: None };
    let Some(Sample { point, .. }) = found.at(start) else { return Ok(followed) };
    let legs = each(&[true, false], 2, watch, |&reversed| {
        leg(plan, point, reversed, sides.map(|sides| &sides[usize::from(reversed)]), watch)
    })?;
    for found in legs {
        match found {
            Ok((leg, sought)) => {
                let closed = leg.end == End::Closed;
                followed.legs.push(leg);
                followed.sought = sought;
                if closed {
                    break;
                }
            }
            Err(why) => followed.refused = Some(why),
        }
    }
    Ok(followed)
}

type Leg = Result<(CurveLeg, Vec<Degenerate>), String>;

/// One direction of a curve, or why there is none.
fn leg(
    plan: &CurvePlan,
    point: &Point,
    reversed: bool,
    allowance: Option<&Allowance>,
    watch: &dyn Watch,
) -> Result<Leg, Error> {
    let branches = plan.branches();
    let (bodies, plane) = (Bodies::new(&branches)?, PlaneBodies::new(plan)?.within(allowance));
    let (settings, range) = plane.settings(&bodies);
    let time = period(&point.motion, point.special.unwrap_or(Special::Fold)).unwrap_or(0.0);
    let settings = lasting(&if reversed { settings.reversed() } else { settings }, time);
    let mut curve = match Curve::of(&plane, point, plan.fixed_value(), &settings, range, watch) {
        Ok(curve) => curve,
        Err(_) if watch.stopped() => return Err(Error::Interrupted),
        Err(error) => return Ok(Err(error.to_string())),
    };
    let mut samples: Vec<CurveSample> = Vec::new();
    for point in curve.by_ref() {
        samples.push(sample(&plane, &point)?);
        if watch.stopped() {
            return Err(Error::Interrupted);
        }
        if let Some(period) = allowance.and_then(|_| settled(plan, &samples)) {
            return Ok(Ok((CurveLeg { samples, end: End::Settles { period } }, curve.sought())));
        }
        if comes_back(plan, &samples) {
            return Ok(Ok((CurveLeg { samples, end: End::Closed }, curve.sought())));
        }
    }
    let end = curve.end().cloned().unwrap_or(End::Stopped);
    if end == End::Stopped {
        return Err(Error::Interrupted);
    }
    Ok(Ok((CurveLeg { samples, end }, curve.sought())))
}

/// The period of the last point, if the curve is one of orbits and its place has settled.
fn settled(plan: &CurvePlan, samples: &[CurveSample]) -> Option<f64> {
    let plane = &plan.computation.plane;
    let place = |sample: &CurveSample| {
        [0, 1].map(|side| sample.parameters[side] / (plane[side].to - plane[side].from))
    };
    let of_orbit = |sample: &CurveSample| match sample.special {
        Special::Hopf(_) => None,
        _ => Some((sample.period?, place(sample))),
    };
    settles(samples.iter().map(of_orbit))?;
    samples.last()?.period
}

/// Returns `true` if the last step passed the start, in the direction in which it was left.
fn comes_back(plan: &CurvePlan, samples: &[CurveSample]) -> bool {
    let [first, _, .., before, last] = samples else { return false };
    let ahead: f64 = (0..2).map(|side| first.direction[side] * last.direction[side]).sum();
    ahead > 0.0 && passes(&[before.clone(), last.clone()], &target(plan, first.parameters, first.period))
}

pub(super) fn target(plan: &CurvePlan, at: [f64; 2], period: Option<f64>) -> Target {
    let (varied, plane) = (plan.varied(), &plan.computation.plane);
    Target { at, period, varied, width: plane[varied].to - plane[varied].from }
}

fn sample(plane: &PlaneBodies<'_>, point: &CurvePoint) -> Result<CurveSample, Error> {
    let model = plane.model(point.parameters)?;
    let state = model.decoded(point.motion.shape());
    let oriented = |pair| PlaneBodies::oriented(plane.plan, pair);
    Ok(CurveSample {
        parameters: oriented(point.parameters),
        direction: oriented(point.direction),
        arclength: point.arclength,
        special: point.special,
        degenerate: point.degenerate,
        residual: point.residual,
        transversality: point.transversality,
        unstable: point.unstable,
        period: period(&point.motion, point.special),
        critical: critical(&point.motion, point.special),
        state,
    })
}

pub(super) fn period(motion: &Motion, special: Special) -> Option<f64> {
    match special {
        Special::Hopf(hopf) => Some(hopf.period()),
        _ => motion.orbit().map(motiform_analysis::PeriodicOrbit::period),
    }
}

/// The eigenvalue or multiplier closest to the one that makes the point special.
fn critical(motion: &Motion, special: Special) -> Option<(f64, f64)> {
    let (all, at) = match (motion, special) {
        (Motion::Equilibrium(found), Special::Hopf(hopf)) => (&found.eigenvalues, (0.0, hopf.frequency)),
        (Motion::Equilibrium(found), _) => (&found.eigenvalues, (0.0, 0.0)),
        (Motion::Orbit { orbit, .. }, Special::Torus { angle }) => {
            (&orbit.multipliers, (libm::cos(angle), libm::sin(angle)))
        }
        (Motion::Orbit { orbit, .. }, Special::PeriodDoubling | Special::SymmetryBreaking) => {
            (&orbit.multipliers, (-1.0, 0.0))
        }
        (Motion::Orbit { orbit, .. }, _) => (&orbit.multipliers, (1.0, 0.0)),
    };
    let off = |value: &(f64, f64)| libm::hypot(value.0 - at.0, value.1 - at.1);
    all.iter().copied().min_by(|a, b| off(a).total_cmp(&off(b)))
}
