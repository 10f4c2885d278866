//! Exponential time differencing of order 4, Cox and Matthews.

use super::exponential::{ExponentialTableau, ExponentialTerm, Node};

/// The weights of ETDRK4, shared with Krogstad's method.
pub(super) const WEIGHTS: &[ExponentialTerm] =
    &[(0, |p| p.weights[0]), (1, |p| 2.0 * p.weights[1]), (2, |p| 2.0 * p.weights[1]), (3, |p| p.weights[2])];

/// The classical exponential method of order 4, with the embedded third order by the slope at the end.
///
/// If `N` is stiff its order drops to 2 or 3; [`super::KROGSTAD4`] loses less order at the same cost.
///
/// Source: Cox and Matthews (2002), J. Comput. Phys. 176, 430, eqs. (26)-(29). The embedded method replaces `N_3` by
/// `N(u_new)` in the last weight: Whalen, Brio, Moloney (2015), J. Comput. Phys. 280, 579.
pub static ETDRK4: ExponentialTableau = ExponentialTableau {
    name: "etdrk4",
    order: 4,
    rows: &[
        (Node::Half, &[(0, |p| 0.5 * p.half[1])]),
        (Node::Half, &[(1, |p| 0.5 * p.half[1])]),
        (Node::Full, &[(0, |p| 0.5 * p.half[1] * (p.half[0] - 1.0)), (2, |p| p.half[1])]),
    ],
    weights: WEIGHTS,
    error: Some(&[(3, |p| p.weights[2]), (4, |p| -p.weights[2])]),
};
