//! The legs of a classified path.

use super::motion::Path;
use super::verdict::Verdict;
use crate::symmetry::wrap;
use crate::{CornerKind, Ends, PathSample, legs};

/// A heteroclinic cycle is at rest below this part of its top speed.
const AT_REST: f64 = 1e-3;

/// A rest is at least one part in this many of the longest one.
const LONG: usize = 8;

/// Adds turns and swing of `path`, one period of a motion with this net rotation. For stop-and-go motion the turns are
/// those of the heading at top speed, else of the directions of the legs. A path without legs adds none.
pub(super) fn describe(verdict: &mut Verdict, path: &Path, rotation: f64) {
    let sample = |i: usize| PathSample {
        t: path.times[i],
        x: path.positions[i][0],
        y: path.positions[i][1],
        vx: path.velocities[i][0],
        vy: path.velocities[i][1],
    };
    let samples: Vec<PathSample> = (0..path.times.len()).map(sample).collect();
    let Ok(found) = legs(&samples, Ends::Periodic { rotation }) else { return };
    verdict.legs = match found.kind {
        Some(CornerKind::Stop) => found.heading_turns,
        _ => found.turns,
    };
    if rotation.abs() < 1e-3 {
        verdict.swing = Some(found.swing);
    }
}

/// Turns of a heteroclinic cycle, from one complete leg to the next: a leg is what lies between two long rests, its heading
/// that at top speed. The body may slow down or go back within a leg, which is no corner; and in a rest the speed is round-off.
pub(super) fn between_rests(path: &Path) -> Vec<f64> {
    let speeds = path.speeds();
    let slow = AT_REST * speeds.iter().copied().fold(0.0, f64::max);
    let moves: Vec<bool> = speeds.iter().map(|&speed| speed > slow).collect();
    let mut stretches: Vec<(bool, usize, usize)> = Vec::new(); // moving or not, first, end
    for (i, &moving) in moves.iter().enumerate() {
        match stretches.last_mut() {
            Some(last) if last.0 == moving => last.2 = i + 1,
            _ => stretches.push((moving, i, i + 1)),
        }
    }
    let lasts = |stretch: &(bool, usize, usize)| stretch.2 - stretch.1;
    let longest = stretches.iter().filter(|s| !s.0).map(lasts).max().unwrap_or(0);
    let rests: Vec<_> = stretches.iter().filter(|s| !s.0 && LONG * lasts(s) >= longest).collect();
    let heading = |pair: &[&(bool, usize, usize)]| {
        let top = (pair[0].2..pair[1].1).max_by(|&a, &b| speeds[a].total_cmp(&speeds[b]))?;
        Some(libm::atan2(path.velocities[top][1], path.velocities[top][0]))
    };
    let headings: Vec<f64> = rests.windows(2).filter_map(heading).collect();
    headings.windows(2).map(|pair| wrap(pair[1] - pair[0])).collect()
}
