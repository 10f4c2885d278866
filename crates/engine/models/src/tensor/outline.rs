//! The boundary of the body: `dR(theta) = S_ij n_i n_j + U_ijk n_i n_j n_k`, which is `2 Re(z2 e^{2 i theta}) + 2 Re(z3 e^{3 i theta})`.

use crate::polar::{self, Mode};
use motiform_dynamics::Outline;

/// Ellipse and triangle of the Fourier state.
fn modes(shape: &[f64]) -> impl Iterator<Item = Mode> + Clone {
    [(2, [shape[2], shape[3]]), (3, [shape[4], shape[5]])].into_iter()
}

/// `dR(theta) = 2 Re(z2 e^{2 i theta}) + 2 Re(z3 e^{3 i theta})`. `shape` is the Fourier state.
pub fn radius_change(shape: &[f64], theta: f64) -> f64 {
    polar::radius_change(modes(shape), theta)
}

/// The closed curve of a body of undeformed radius `radius`: see [`polar::outline`].
pub fn outline(shape: &[f64], radius: f64, points: usize) -> Outline {
    polar::outline(&modes(shape), radius, points)
}

/// `2 |z2| + 2 |z3|`: see [`polar::deformation`].
pub fn deformation(shape: &[f64]) -> f64 {
    polar::deformation(modes(shape))
}
