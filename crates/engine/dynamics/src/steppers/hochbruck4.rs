//! Exponential Runge-Kutta of stiff order 4, Hochbruck and Ostermann.

use super::exponential::{ExponentialTableau, Node, PhiValues};

/// `a_52 = a_53 = phi2(z/2)/2 - phi3(z) + phi2(z)/4 - phi3(z/2)/2`.
fn a52(p: &PhiValues) -> f64 {
    0.5 * p.half[2] - p.full[3] + 0.25 * p.full[2] - 0.5 * p.half[3]
}

/// Order 4 on stiff problems too: five stages meet the conditions for a stiff nonlinearity, four cannot.
///
/// The error is estimated as in [`super::KROGSTAD4`]: in the embedded method of order 3 the slope at the end takes the place of the fourth
/// stage's, both of which lie at `t + h`. On the active cell see docs/records/convolution.md.
///
/// Source: Hochbruck and Ostermann (2005), SIAM J. Numer. Anal. 43, 1069, eq. (5.19); the embedded pair: Whalen, Brio, Moloney (2015),
/// J. Comput. Phys. 280, 579.
pub static HOCHBRUCK4: ExponentialTableau = ExponentialTableau {
    name: "hochbruck4",
    order: 4,
    rows: &[
        (Node::Half, &[(0, |p| 0.5 * p.half[1])]),
        (Node::Half, &[(0, |p| 0.5 * p.half[1] - p.half[2]), (1, |p| p.half[2])]),
        (Node::Full, &[(0, |p| p.full[1] - 2.0 * p.full[2]), (1, |p| p.full[2]), (2, |p| p.full[2])]),
        (
            Node::Half,
            &[
                (0, |p| 0.5 * p.half[1] - 0.25 * p.half[2] - a52(p)),
                (1, a52),
                (2, a52),
                (3, |p| 0.25 * p.half[2] - a52(p)),
            ],
        ),
    ],
    weights: &[(0, |p| p.weights[0]), (3, |p| p.weights[2]), (4, |p| 4.0 * p.weights[1])],
    error: Some(&[(3, |p| p.weights[2]), (5, |p| -p.weights[2])]),
};
