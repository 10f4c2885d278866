//! The faults of a frame that show beside the others of its cell.

use super::breaks::areas;
use super::flag::Flag;
use super::frame::FrameModes;
use crate::after::digest;
use crate::{Cell, Outline};
use motiform_dynamics::sample::median;
use std::collections::BTreeMap;

/// Frames on each side whose areas are compared.
const AROUND: usize = 3;

/// Scatter of the areas, in standard deviations, beyond which one jumps.
const SCATTER: f64 = 6.0;

/// Frames whose outline is that of the frame before, vertex by vertex, whatever their first vertex.
pub(super) fn repeated(cell: &Cell, modes: &mut [FrameModes]) {
    for (k, pair) in cell.frames.windows(2).enumerate() {
        if !pair[1].points.is_empty() && same(&pair[0], &pair[1]) {
            modes[k + 1].flags.push(Flag::Repeated { of: pair[0].frame });
        }
    }
}

fn same(a: &Outline, b: &Outline) -> bool {
    a.points == b.points || a.points.len() == b.points.len() && digest(&a.points) == digest(&b.points)
}

/// Missing frames: steps of the frame number above the most frequent one.
pub(super) fn gaps(modes: &mut [FrameModes]) {
    let mut counts: BTreeMap<i64, usize> = BTreeMap::new();
    for pair in modes.windows(2) {
        *counts.entry(pair[1].frame - pair[0].frame).or_insert(0) += 1;
    }
    // of equally frequent steps the shortest: the map is in order, and only a greater count replaces it
    let usual =
        counts.iter().fold((1, 0), |best, (&step, &count)| if count > best.1 { (step, count) } else { best });
    for k in 1..modes.len() {
        let step = modes[k].frame - modes[k - 1].frame;
        let missing = step / usual.0.max(1) - 1;
        if missing > 0 {
            modes[k].flags.push(Flag::Gap { missing });
        }
    }
}

/// Areas that differ from the median of the 3 frames on each side by more than the threshold, and by more
/// than 6 robust standard deviations of all such differences (1.4826 times their median size). Logarithms:
/// half and double are as far. Areas of outlines that are not clipped which step to another level and stay there are flagged as steps; the
/// frames on both sides of a step are not compared.
pub(super) fn jumps(modes: &mut [FrameModes], threshold: f64) {
    let logs: Vec<Option<f64>> =
        modes.iter().map(|frame| (frame.area > 0.0).then(|| libm::log(frame.area))).collect();
    let scatter = median(deviations(&logs, &[]).iter().flatten().map(|d| d.abs())).unwrap_or(0.0);
    let limit = threshold.max(SCATTER * 1.4826 * scatter);
    // what the border of the images cuts off is no change of the cell
    let whole = |frame: &FrameModes| !frame.flags.iter().any(|flag| matches!(flag, Flag::Clipped { .. }));
    let known: Vec<Option<f64>> =
        logs.iter().zip(modes.iter()).map(|(log, frame)| log.filter(|_| whole(frame))).collect();
    let steps = areas(modes, &known, limit);
    for (frame, deviation) in modes.iter_mut().zip(deviations(&logs, &steps)) {
        if let Some(deviation) = deviation.filter(|deviation| deviation.abs() > limit) {
            frame.flags.push(Flag::AreaJump { factor: libm::exp(deviation) });
        }
    }
}

/// Differences from the median of the frames around, which lie on the same side of every step.
fn deviations(logs: &[Option<f64>], steps: &[usize]) -> Vec<Option<f64>> {
    let level = |k: usize| steps.iter().filter(|&&step| step <= k).count();
    (0..logs.len())
        .map(|k| {
            let around = k.saturating_sub(AROUND)..(k + AROUND + 1).min(logs.len());
            let others = around.filter(|&j| j != k && level(j) == level(k)).filter_map(|j| logs[j]);
            Some(logs[k]? - median(others)?)
        })
        .collect()
}
