//! The legs of a classified path.

use super::motion::Path;
use super::verdict::Verdict;
use crate::{CornerKind, Ends, PathSample, legs};

/// Adds turns and swing of `path` to the verdict; `net_rotation` where it is one period of a motion. For stop-and-go
/// motion the turns are those of the heading at top speed, else of the directions of the legs. A path without legs adds
/// none.
pub(super) fn describe(verdict: &mut Verdict, path: &Path, net_rotation: Option<f64>) {
    let sample = |i: usize| PathSample {
        t: path.times[i],
        x: path.positions[i][0],
        y: path.positions[i][1],
        vx: path.velocities[i][0],
        vy: path.velocities[i][1],
    };
    let samples: Vec<PathSample> = (0..path.times.len()).map(sample).collect();
    let ends = net_rotation.map_or(Ends::Open, |rotation| Ends::Periodic { rotation });
    let Ok(found) = legs(&samples, ends) else { return };
    verdict.legs = match found.kind {
        Some(CornerKind::Stop) => found.heading_turns,
        _ => found.turns,
    };
    if net_rotation.is_some_and(|rotation| rotation.abs() < 1e-3) {
        verdict.swing = Some(found.swing);
    }
}
