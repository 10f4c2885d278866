//! The motion of a body at a relative equilibrium: translation and rotation.

use crate::equilibrium::RelativeEquilibrium;
use crate::isotropy::Isotropy;
use crate::linear::{add, norm};
use crate::regime::{Direction, Regime};
use crate::{Estimate, equilibrium::Uncertainty};
use motiform_dynamics::{Equivariant, model};

/// A rate counts as one where it is above this many of its error bounds.
const CLEAR: f64 = 3.0;

/// A turning rate of a shape without a mirror axis counts as none only where rates of this part of the leading one would be seen:
/// beside the bifurcation at which a body begins to turn, the turning rate is far larger than the rate at which it settles.
const SEEN: f64 = 1e-2;

/// The one answer to whether a relative equilibrium moves and turns, and how sure that is.
///
/// Rest and straight motion are symmetries of the shape: a shape that a rotation leaves unchanged has no direction to move in, and one
/// with a mirror axis does not turn. Both are decided by the distance of the shape from its image, against the error of the shape. Where no
/// symmetry decides, the rates do, against the errors that the residual of the equations leaves in them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteadyMotion {
    /// Speed of the centre of mass (model length per model time) with its error; exactly 0 by symmetry.
    pub speed: Estimate,
    /// Turning rate of the shape (rad per model time) with its error; exactly 0 by symmetry.
    pub turning_rate: Estimate,
    /// The rotations and mirrors that leave the shape as it is, within its error; all rotations where nothing of it is above its error.
    pub symmetry: Isotropy,
    /// `true` if the shape has no mirror axis although the equations have the mirror, beyond its error.
    asymmetric: bool,
    /// The leading growth rate: what an unseen turning rate is small against.
    growth: f64,
}

impl SteadyMotion {
    /// At this equilibrium.
    ///
    /// # Checked by  tests/all/steady.rs: the cell on both sides of its drift pitchfork with 14 to 64 modes; the tensor model; spinning
    pub fn of(body: &dyn Equivariant, found: &RelativeEquilibrium) -> Self {
        let uncertainty = found.uncertainty(body);
        let size = norm(&found.shape);
        let away = norm(&uncertainty.shape);
        // an image is wrong by as much as the shape
        let tolerance = if size > 0.0 { (2.0 * CLEAR * away / size).clamp(f64::EPSILON, 1.0) } else { 1.0 };
        let isotropy = Isotropy::of(body, &found.shape, tolerance);
        // towards a circle Newton's method ends with what is left of the guess
        let circle = isotropy.circle || away.is_finite() && size <= CLEAR * away || size == 0.0;
        let rests = body.symmetry().rotations && (circle || isotropy.folds > 1);
        let straight = rests && circle || isotropy.mirror.is_some() || found.neutral == 0;
        let none = Estimate { value: 0.0, error: 0.0 };
        let turning = Estimate { value: found.turning_rate, error: uncertainty.turning_rate };
        let turns = found.turning_rate.abs() > CLEAR * uncertainty.turning_rate;
        Self {
            speed: if rests { none } else { speed(body, found, &uncertainty) },
            // a clear turning rate of a shape that seems to have an axis: the rate decides
            turning_rate: if straight && !turns { none } else { turning },
            symmetry: Isotropy { circle, folds: if circle { 1 } else { isotropy.folds }, ..isotropy },
            asymmetric: body.symmetry().mirror && !straight,
            growth: found.growth(),
        }
    }

    /// Returns `true` if the shape has a mirror axis, within its error.
    pub fn has_axis(&self) -> bool {
        self.symmetry.circle || self.symmetry.mirror.is_some()
    }

    /// Returns `true` if the centre of mass moves.
    pub fn moves(&self) -> bool {
        self.speed.value > CLEAR * self.speed.error
    }

    /// Returns `true` if the shape turns.
    pub fn turns(&self) -> bool {
        self.turning_rate.value.abs() > CLEAR * self.turning_rate.error
    }

    /// Its name.
    pub fn regime(&self) -> Regime {
        match (self.moves(), self.turns()) {
            (false, false) => Regime::Motionless,
            (true, false) => Regime::Straight,
            (true, true) => Regime::Circular,
            (false, true) => Regime::Spinning,
        }
    }

    /// The distance of the speed and the turning rate from the values at which the name would change, in
    /// units of what decides: below 1 the name is not decided.
    pub fn margin(&self) -> f64 {
        let resolved = SEEN * self.growth.abs() / (CLEAR * self.turning_rate.error);
        let turning = if self.turns() || !self.asymmetric { f64::MAX } else { resolved };
        sure(self.speed).min(sure(self.turning_rate)).min(turning)
    }

    /// The speed of the motion (model length per model time): 0 at rest.
    pub fn pace(&self) -> f64 {
        if self.moves() { self.speed.value } else { 0.0 }
    }

    /// Its direction at this equilibrium, as far as the symmetry of the body distinguishes directions.
    pub fn direction(&self, body: &dyn Equivariant, found: &RelativeEquilibrium) -> Direction {
        let drift = if self.moves() { found.velocity } else { [0.0; 2] };
        Direction::of(body, self.turns().then_some(found.turning_rate), drift)
    }

    /// The turning rate of the motion (rad per model time): 0 for straight motion; `None` at rest, where nothing has a heading.
    pub fn turning(&self) -> Option<f64> {
        match (self.moves(), self.turns()) {
            (_, true) => Some(self.turning_rate.value),
            (true, false) => Some(0.0),
            (false, false) => None,
        }
    }
}

/// The ratio of a rate to its threshold, or the inverse where it is below.
fn sure(rate: Estimate) -> f64 {
    let (value, least) = (rate.value.abs(), CLEAR * rate.error);
    match value > least {
        true if least > 0.0 => value / least,
        false if value > 0.0 => (least / value).min(1e3),
        _ => f64::MAX,
    }
}

/// The speed, and how far it may be away for a shape that is wrong by this much: by the change of the
/// velocity over the error, and by its own rounding.
fn speed(body: &dyn Equivariant, found: &RelativeEquilibrium, uncertainty: &Uncertainty) -> Estimate {
    let value = found.speed();
    let known = uncertainty.shape.iter().all(|x| x.is_finite());
    if !known {
        return Estimate { value, error: f64::INFINITY };
    }
    let mut error = body.speed_resolution(&found.shape, 0.0);
    for (i, &bound) in uncertainty.shape.iter().enumerate().filter(|(_, bound)| **bound > 0.0) {
        let mut beside = vec![0.0; found.shape.len()];
        beside[i] = bound;
        add(&mut beside, 1.0, &found.shape);
        let velocity = model::velocity(body, &beside);
        error += libm::hypot(velocity[0] - found.velocity[0], velocity[1] - found.velocity[1]);
    }
    Estimate { value, error }
}
