//! The kind of the start of branches, where it was taken from an earlier result.

use serde::{Deserialize, Serialize};

/// The kind of the start's state, where it was taken from an earlier result. Without it, the start is simulated.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum Given {
    /// A steady motion, stable or not: Newton's method begins there, and nothing is simulated.
    Equilibrium,
    /// A shape on an orbit, stable or not, as shooting begins with it.
    Orbit {
        /// The time after which it comes back (model time); half the period of one that is its own mirror image.
        time: f64,
        /// The rotation by then (rad), after the mirror.
        angle: f64,
        /// `true` if its image is a mirror image.
        mirrored: bool,
    },
    /// A recorded state: if a steady motion is asked for, Newton's method is tried first; otherwise the flow is followed from there.
    State,
}

impl Given {
    /// Returns `true` if it is a motion, which is not simulated.
    pub const fn is_motion(self) -> bool {
        !matches!(self, Self::State)
    }
}
