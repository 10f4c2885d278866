//! Curves of special points, as far as they are followed.

use super::crossing::passes;
use super::family::PlaneBodies;
use super::follow::{period, target};
use crate::branches::result::{Branches, Sample};
use motiform_continuation::{Degenerate, End, Special};
use motiform_study::CurvePlan;
use motiform_study::curves::CurveKind;
use serde::{Deserialize, Serialize};

/// A point of a curve with what is read off it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CurveSample {
    /// The parameters of the plane, across and upwards.
    pub parameters: [f64; 2],
    /// Their derivatives by the length along the curve.
    pub direction: [f64; 2],
    /// Length along the curve from its start.
    pub arclength: f64,
    /// The critical condition.
    pub special: Special,
    /// The further degeneracy, at a point of codimension two.
    pub degenerate: Option<Degenerate>,
    /// The residual of the condition that holds along the curve.
    pub residual: f64,
    /// The slope of the condition across the curve.
    pub transversality: f64,
    /// Number of growing directions, the critical ones left out.
    pub unstable: usize,
    /// Period of the motion; at a Hopf bifurcation, of the oscillation that begins (model time).
    pub period: Option<f64>,
    /// The eigenvalue, or multiplier, closest to the critical value.
    pub critical: Option<(f64, f64)>,
    /// A shape of the motion in the model's coordinates.
    pub state: Vec<f64>,
}

/// A curve from its start to one of its ends.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CurveLeg {
    /// Its points, the first one the start.
    pub samples: Vec<CurveSample>,
    /// Why it ended.
    pub end: End,
}

/// A curve of special points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FollowedCurve {
    /// The critical condition along it.
    pub kind: CurveKind,
    /// The special point where it was begun: branch, leg and point.
    pub start: [usize; 3],
    /// Towards smaller and towards larger values of the parameter that the branches have in common; one leg if the curve is closed.
    pub legs: Vec<CurveLeg>,
    /// The kinds of points of codimension two that were looked for.
    pub sought: Vec<Degenerate>,
    /// Why it could not be followed at all.
    pub refused: Option<String>,
}

/// Curves, as far as they are followed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Curves {
    /// The branches whose special points are followed.
    pub branches: Branches,
    /// The curves in the order in which they were found.
    pub curves: Vec<FollowedCurve>,
    /// `true` if everything was done that was asked for: not interrupted.
    pub complete: bool,
}

impl Curves {
    /// Returns `true` if the curve through this special point was followed before.
    pub(super) fn begun(&self, start: [usize; 3]) -> bool {
        self.curves.iter().any(|curve| curve.start == start)
    }

    /// Returns `true` if a curve passes through this special point.
    pub(super) fn passes(&self, plan: &CurvePlan, kind: CurveKind, start: [usize; 3]) -> bool {
        let sample = self.branches.at(start);
        let mut curves = self.curves.iter().filter(|curve| curve.kind == kind);
        sample.is_some_and(|sample| curves.any(|curve| curve.passes(plan, sample)))
    }

    /// Where a curve was begun, across and upwards.
    pub fn start(&self, plan: &CurvePlan, curve: &FollowedCurve) -> Option<[f64; 2]> {
        let first = self.branches.at(curve.start)?.point.parameter;
        Some(PlaneBodies::oriented(plan, [first, plan.fixed_value()]))
    }
}

impl FollowedCurve {
    /// Returns `true` if it passes through a special point of a branch of this plan. The curve may have been begun on a branch of another
    /// one over the same plane.
    pub fn passes(&self, plan: &CurvePlan, sample: &Sample) -> bool {
        let period = sample.point.special.and_then(|special| period(&sample.point.motion, special));
        let at = PlaneBodies::oriented(plan, [sample.point.parameter, plan.fixed_value()]);
        let target = target(plan, at, period);
        self.legs.iter().any(|leg| leg.samples.windows(2).any(|pair| passes(pair, &target)))
    }

    /// Its points from one end to the other, the start once.
    pub fn samples(&self) -> impl Iterator<Item = &CurveSample> {
        let (back, on) = match &self.legs[..] {
            [back, on] => (&back.samples[..], &on.samples[1..]),
            [one] => (&[][..], &one.samples[..]),
            _ => (&[][..], &[][..]),
        };
        back.iter().rev().chain(on)
    }
}
