//! After what time a motion that repeats is as it was.

use super::form::Form;
use super::verdict::Verdict;
use crate::isotropy::Isotropy;
use crate::periodic::{Flow, PeriodicOrbit};
use motiform_dynamics::{Equivariant, Watch};

/// The period of a motion that repeats, and the rotation that it adds up to.
///
/// A shape comes back as its own image under a rotation or a mirror. Where the symmetry of the motion leaves
/// a finite number of such images, the body is as it was after as many returns, and this is its period: two
/// returns of mirror images, and two of a shape with a mirror axis that comes back turned, for its axis comes
/// back as an axis. Where it leaves any angle, no number of returns brings the body back: the period is that
/// of the shape, with a net rotation. So the period does not change with modes that act on nothing and do not
/// turn: after it they are as they were, too.
///
/// Source: spatial and spatio-temporal symmetries, Golubitsky and Stewart (2002), The Symmetry Perspective, section 3.1.
///
/// # Checked by  tests/all/back_and_forth.rs: van der Pol's period for a body on a line, with and without a free phase
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Period {
    /// The period (model time).
    pub(super) time: f64,
    /// The net rotation over it (rad, in -pi..pi), exactly 0 where the symmetry makes it so.
    pub(super) rotation: f64,
}

impl Period {
    /// That of an orbit of this form, whose shapes all have the symmetry `symmetry`. Rotations below `no_turn` (rad) are none.
    pub(super) fn of(form: Form, symmetry: &Isotropy, orbit: &PeriodicOrbit, no_turn: f64) -> Self {
        let turned = libm::sin(0.5 * symmetry.folds as f64 * orbit.angle).abs() >= no_turn;
        let on_axis =
            form == Form::BackAndForth || form == Form::PulsatingAtRest && symmetry.mirror.is_some();
        if orbit.mirrored || on_axis && turned {
            Self { time: 2.0 * orbit.time, rotation: 0.0 }
        } else {
            Self { time: orbit.time, rotation: orbit.angle }
        }
    }
}

/// Newton's method has found the orbit of a verdict where the times differ by less than this part.
const SAME_TIME: f64 = 1e-3;

impl Verdict {
    /// The periodic orbit of this motion near `shape`, over its first return, as Newton's method has it;
    /// `None` for a motion that does not repeat.
    pub fn orbit(
        &self,
        body: &dyn Equivariant,
        shape: &[f64],
        flow: &Flow,
        watch: &dyn Watch,
    ) -> Option<PeriodicOrbit> {
        let (whole, half) = (self.period?, 0.5 * self.period?);
        let returns = match self.form? {
            Form::MirrorZigzag => vec![(half, true)],
            // where a mode that acts on nothing does not turn, the shape is not back before the whole period
            Form::BackAndForth | Form::PulsatingAtRest => vec![(half, false), (whole, false)],
            _ => vec![(whole, false)],
        };
        let near = |(time, mirrored): (f64, bool)| {
            let found = PeriodicOrbit::near(body, shape, time, mirrored, flow, watch)?;
            ((found.time / time - 1.0).abs() < SAME_TIME).then_some(found)
        };
        returns.into_iter().find_map(near)
    }
}
