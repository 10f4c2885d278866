//! Euler's method.

use super::tableau::{Dense, ErrorEstimate, Tableau};

/// `u_new = u + h f(u)`: order 1. The paper's scheme for the reduced tensor model (Simulations I, dt = 1e-3).
///
/// Source: Euler (1768), Institutiones calculi integralis.
pub static EULER: Tableau = Tableau {
    name: "euler",
    order: 1,
    nodes: &[0.0],
    rows: &[&[]],
    weights: &[(0, 1.0)],
    error: ErrorEstimate::None,
    dense: Dense::hermite(1),
};
