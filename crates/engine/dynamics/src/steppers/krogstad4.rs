//! Exponential time differencing of order 4, Krogstad.

use super::etdrk4::WEIGHTS;
use super::exponential::{ExponentialTableau, Node};

/// The method of choice for stiff shapes: better stages than [`super::ETDRK4`] for the same four evaluations, error
/// estimated by an embedded method of order 3 that costs nothing (it uses the next step's first evaluation).
///
/// Source: Krogstad (2005), J. Comput. Phys. 203, 72 (ETDRK4-B); the embedded pair: Whalen, Brio, Moloney (2015),
/// J. Comput. Phys. 280, 579.
pub static KROGSTAD4: ExponentialTableau = ExponentialTableau {
    name: "krogstad4",
    order: 4,
    rows: &[
        (Node::Half, &[(0, |p| 0.5 * p.half[1])]),
        (Node::Half, &[(0, |p| 0.5 * p.half[1] - p.half[2]), (1, |p| p.half[2])]),
        (Node::Full, &[(0, |p| p.full[1] - 2.0 * p.full[2]), (2, |p| 2.0 * p.full[2])]),
    ],
    weights: WEIGHTS,
    error: Some(&[(3, |p| p.weights[2]), (4, |p| -p.weights[2])]),
};
