//! Heun's method.

use super::tableau::{Dense, ErrorEstimate, Tableau};

/// The explicit trapezoidal rule, order 2: the 'modified Euler method' of the paper (Simulations II, dt = 1e-3, 1e-4).
///
/// Source: Heun (1900), Z. Math. Phys. 45, 23.
pub static HEUN: Tableau = Tableau {
    name: "heun",
    order: 2,
    nodes: &[0.0, 1.0],
    rows: &[&[], &[(0, 1.0)]],
    weights: &[(0, 0.5), (1, 0.5)],
    error: ErrorEstimate::None,
    dense: Dense::hermite(2),
};
