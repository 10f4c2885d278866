//! Orbits far out: whether one that crawls there leaves every bound.
//!
//! Far out nonlinear terms make the equations stiff: an orbit may grow exponentially along a slow direction
//! at a rate of some tens, while its fast directions decay at a rate of `|u|^2`, so that an explicit method
//! takes half a million steps from one bound to the next. A singularity takes some hundred. Such an orbit is
//! followed ahead by an implicit method ([`Ascent`]), of the same equations, to the same bound: where that
//! leaves, the look is over; where it does not, nothing has happened.

use crate::implicit::Ascent;
use crate::linear::norm;
use crate::periodic::is_small;
use motiform_dynamics::{Equivariant, Integration, Outcome, Request};

/// A shape is far out beyond this part of the bound of escape.
pub(super) const FAR: f64 = 1e-3;

/// An orbit crawls that has made so many steps far out. (The singularities of the tensor model take 200 to 2000 from there to the bound.)
const CRAWLS: u64 = 4000;

/// The steps of a look far out.
pub(super) struct Far {
    /// The norm beyond which a shape is far out.
    norm: f64,
    /// The time for which the orbit is followed ahead: as long as the look.
    ahead: f64,
    steps: u64,
    /// The number of steps at which the orbit is followed ahead next.
    next: u64,
}

impl Far {
    /// A look of length `time`.
    pub(super) fn new(request: &Request<'_>, time: f64) -> Self {
        Self { norm: FAR * request.escape_norm, ahead: time, steps: 0, next: CRAWLS }
    }

    /// Counts a step; the escape of an orbit that crawls far out and leaves soon.
    pub(super) fn leaves(
        &mut self,
        body: &dyn Equivariant,
        orbit: &dyn Integration,
        request: &Request<'_>,
    ) -> Option<Outcome> {
        if norm(orbit.state()) <= self.norm || !is_small(body.dim()) {
            return None;
        }
        self.steps += 1;
        if self.steps < self.next {
            return None;
        }
        self.next *= 2;
        let t = orbit.t();
        Ascent { t, t_end: t + self.ahead, bound: request.escape_norm, watch: request.watch }
            .follow(body, orbit.state())
    }
}
