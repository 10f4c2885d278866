//! What a series of returns says.

/// K of the 0-1 test; `None` for fewer than 200 returns.
pub(super) fn zero_one(returns: &[f64]) -> Option<f64> {
    let _ = returns;
    None
}

/// Dimension of the set of returns; `None` for fewer than 200 returns.
pub(super) fn dimension(returns: &[f64]) -> Option<f64> {
    let _ = returns;
    None
}
