//! Runge-Kutta with an integrating factor.

use super::exponential::{ExponentialTableau, Node};

/// The classical Runge-Kutta method for `e^{-Lambda t} u`: what 'spectral method with the 4th order Runge-Kutta
/// algorithm' most likely means in the paper. Fixed points of the flow are not fixed points of the method (they are
/// off by order `h^4`), so prefer [`super::KROGSTAD4`].
///
/// Source: Lawson (1967), SIAM J. Numer. Anal. 4, 372; Trefethen (2000), Spectral Methods in MATLAB, program 27.
pub static IFRK4: ExponentialTableau = ExponentialTableau {
    name: "ifrk4",
    order: 4,
    rows: &[
        (Node::Half, &[(0, |p| 0.5 * p.half[0])]),
        (Node::Half, &[(1, |_| 0.5)]),
        (Node::Full, &[(2, |p| p.half[0])]),
    ],
    weights: &[
        (0, |p| p.full[0] / 6.0),
        (1, |p| p.half[0] / 3.0),
        (2, |p| p.half[0] / 3.0),
        (3, |_| 1.0 / 6.0),
    ],
    error: None,
};
