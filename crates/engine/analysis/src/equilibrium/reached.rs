//! The test that an orbit has come to a steady motion.

use super::RelativeEquilibrium;
use crate::linear::norm;
use motiform_dynamics::Equivariant;

/// An orbit this near to a stable steady motion, against the size of its shapes, stays near it: the basin is larger, but for the closest
/// neighbourhood of a subcritical bifurcation.
pub const REACHED: f64 = 1e-3;

/// An orbit this near to one that is not stable is on it: others pass by at a distance, and leave again.
const ON: f64 = 1e-6;

impl RelativeEquilibrium {
    /// The steady motion that an orbit has come to; `None` where it is on its way, or elsewhere.
    ///
    /// `shape` is where the orbit is, `size` that of its shapes: distances are small against it, for a circle has no size of its own.
    ///
    /// # Checked by  tests/all/lyapunov.rs: runs that end at circles, straight and circular motion, families; lab's tests/all/naming.rs
    pub fn reached(body: &dyn Equivariant, shape: &[f64], size: f64) -> Option<Self> {
        let found = Self::find(body, shape)?;
        let near = if found.is_stable() { REACHED } else { ON };
        (found.distance(body, shape) <= near * norm(&found.shape).max(size)).then_some(found)
    }
}
