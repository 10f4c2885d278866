//! The classical Runge-Kutta method.

use super::tableau::{Dense, ErrorEstimate, Tableau};

/// The classical method of order 4.
///
/// Source: Kutta (1901), Z. Math. Phys. 46, 435.
pub static RK4: Tableau = Tableau {
    name: "rk4",
    order: 4,
    nodes: &[0.0, 0.5, 0.5, 1.0],
    rows: &[&[], &[(0, 0.5)], &[(1, 0.5)], &[(2, 1.0)]],
    weights: &[(0, 1.0 / 6.0), (1, 1.0 / 3.0), (2, 1.0 / 3.0), (3, 1.0 / 6.0)],
    error: ErrorEstimate::None,
    dense: Dense::hermite(4),
};
