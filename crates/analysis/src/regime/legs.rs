//! The legs of a classified path.

use super::motion::Path;
use super::verdict::{Regime, Verdict};

/// Adds the legs of `path` to the verdict; `net_rotation` where it is one period of a motion.
pub(super) fn describe(verdict: &mut Verdict, path: &Path, net_rotation: Option<f64>) {
    let _ = net_rotation;
    if verdict.regime == Regime::Zigzag
        && let Some(heading) = path.heading()
    {
        let low = heading.iter().copied().fold(f64::INFINITY, f64::min);
        let high = heading.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        verdict.swing = Some(high - low);
    }
}
