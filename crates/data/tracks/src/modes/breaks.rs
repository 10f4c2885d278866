//! Positions and areas that step: jumps of the stage, and records that are not those of one cell in one unit.

use super::flag::Flag;
use super::frame::FrameModes;
use motiform_dynamics::sample::{ascending, median, quantile};
use std::f64::consts::PI;

/// Distance of two centroids, in mean radii, from which on they are two places.
const APART: f64 = 1.5;

/// Longest run of frames elsewhere after which the cell is back.
const EXCURSION: usize = 3;

/// Multiple of the 90 % quantile of all displacements that no cell covers between two frames.
const STEP: f64 = 4.0;

/// Share of frames elsewhere from which on the record is that of two cells.
const MIXED: f64 = 0.2;

/// Multiple of the 90 % quantile of all changes of shape between frames, from which on a shape does not go on.
const CHANGED: f64 = 2.1;

/// Frames on each side whose median areas are compared, and the fewest of them.
const LEVEL: usize = 8;
const LEAST_LEVEL: usize = 5;

/// Frames at another place for at most 3 frames, and displacements after which the cell stays at the other place.
///
/// Elsewhere: 1.5 mean radii and more from the place before, and back within half of that distance. A
/// displacement without a return is a step if it also exceeds 4 times the 90 % quantile of all displacements,
/// for each frame that passed: of the stage, where the shape goes on ([`Going`]), or to another cell.
pub(super) fn displacements(modes: &mut [FrameModes]) {
    let seen: Vec<usize> = (0..modes.len()).filter(|&k| modes[k].area > 0.0).collect();
    let steps: Vec<f64> = seen.windows(2).map(|pair| pace(&modes[pair[0]], &modes[pair[1]])).collect();
    let usual = usual(steps);
    let going = Going::of(modes, &seen);
    let mut k = 1;
    while k < seen.len() {
        let (before, here) = (&modes[seen[k - 1]], &modes[seen[k]]);
        let far = distance(before, here);
        if far <= apart(before, here) {
            k += 1;
            continue;
        }
        let back = (1..=EXCURSION)
            .find(|&m| seen.get(k + m).is_some_and(|&next| distance(before, &modes[next]) < 0.5 * far));
        if let Some(frames) = back {
            for &frame in &seen[k..k + frames] {
                modes[frame].flags.push(Flag::PositionJump { distance: far });
            }
            k += frames + 1;
        } else {
            if pace(before, here) > STEP * usual {
                let flag = match going.on(before, here) {
                    true => Flag::StageJump { distance: far },
                    false => Flag::PositionStep { distance: far },
                };
                modes[seen[k]].flags.push(flag);
            }
            k += 1;
        }
    }
}

/// The usual changes of the shape between successive frames: of area, z2 and z3.
struct Going {
    usual: [f64; 3],
}

impl Going {
    fn of(modes: &[FrameModes], seen: &[usize]) -> Self {
        let pairs = || seen.windows(2).map(|pair| changes(&modes[pair[0]], &modes[pair[1]]));
        Self { usual: [0, 1, 2].map(|k| usual(pairs().filter_map(|found| found[k]).collect())) }
    }

    /// Returns `true` if the shape of `here` is that of `before`, within the usual changes between frames.
    /// Where there are no modes, nothing tells one cell from another.
    fn on(&self, before: &FrameModes, here: &FrameModes) -> bool {
        let found = changes(before, here);
        found.iter().zip(self.usual).all(|(change, usual)| change.is_some_and(|x| x <= CHANGED * usual))
    }
}

/// |ln| of the ratio of the areas, and the changes of z2 and z3.
fn changes(a: &FrameModes, b: &FrameModes) -> [Option<f64>; 3] {
    let area = (a.area > 0.0 && b.area > 0.0).then(|| libm::log(b.area / a.area).abs());
    let mode = |n: usize| {
        let [a, b] = [a, b].map(|frame| frame.radius.as_ref()?.z.get(n));
        let (a, b) = (a?, b?);
        Some(libm::hypot(b[0] - a[0], b[1] - a[1]))
    };
    [area, mode(0), mode(1)]
}

/// Areas that change from one frame to the next and stay: the medians of up to 8 frames before and after (5
/// at least) differ by more than the limit in the logarithm, and more than half of the difference lies
/// between the two frames. The frames at which they step.
pub(super) fn areas(modes: &mut [FrameModes], logs: &[Option<f64>], limit: f64) -> Vec<usize> {
    let mut found = Vec::new();
    for k in LEAST_LEVEL..logs.len() {
        let (Some(before), Some(here)) = (logs[k - 1], logs[k]) else { continue };
        let level = |range: std::ops::Range<usize>| {
            let known: Vec<f64> = range.filter_map(|j| logs[j]).collect();
            (known.len() >= LEAST_LEVEL).then(|| median(known)).flatten()
        };
        let levels = (level(k.saturating_sub(LEVEL)..k), level(k..(k + LEVEL).min(logs.len())));
        let (Some(low), Some(high)) = levels else { continue };
        let step = high - low;
        if step.abs() > limit && (here - before) / step > 0.5 {
            modes[k].flags.push(Flag::AreaStep { factor: libm::exp(step) });
            found.push(k);
        }
    }
    found
}

/// The reason why a record is not that of one cell in one unit, with the first frame that shows it.
pub(super) fn reason(modes: &[FrameModes]) -> Option<String> {
    if let Some(reason) = mixed(modes) {
        return Some(reason);
    }
    if let [first, ..] = flagged(modes, |flag| matches!(flag, Flag::AreaStep { .. }))[..] {
        return Some(format!(
            "the area steps to another level at frame {first}: another unit, or another cell under the same \
            name; give the parts names of their own"
        ));
    }
    let steps = flagged(modes, |flag| matches!(flag, Flag::PositionStep { .. }));
    let first = steps.first()?;
    Some(format!(
        "the cell is at another place from frame {first} on: another cell under the same name; give the parts names of their own"
    ))
}

/// The reason why displacements from frame to frame are not those of one cell.
pub(super) fn mixed(modes: &[FrameModes]) -> Option<String> {
    let elsewhere = flagged(modes, |flag| matches!(flag, Flag::PositionJump { .. }));
    (elsewhere.len() > 3 && elsewhere.len() as f64 > MIXED * modes.len() as f64).then(|| {
        format!(
            "{} of {} frames are at another place than those around them, the first of them frame {}: two \
            cells have one name, or the frames are too far apart to follow the cell",
            elsewhere.len(),
            modes.len(),
            elsewhere[0]
        )
    })
}

/// The frames with such a flag.
fn flagged(modes: &[FrameModes], test: impl Fn(&Flag) -> bool) -> Vec<i64> {
    modes.iter().filter(|frame| frame.flags.iter().any(&test)).map(|frame| frame.frame).collect()
}

fn distance(a: &FrameModes, b: &FrameModes) -> f64 {
    libm::hypot(b.centroid[0] - a.centroid[0], b.centroid[1] - a.centroid[1])
}

/// The distance for each frame that passed.
fn pace(a: &FrameModes, b: &FrameModes) -> f64 {
    distance(a, b) / (b.frame - a.frame).max(1) as f64
}

fn apart(a: &FrameModes, b: &FrameModes) -> f64 {
    0.5 * APART * ((a.area / PI).sqrt() + (b.area / PI).sqrt())
}

/// The 90 % quantile; 0 of nothing.
fn usual(mut values: Vec<f64>) -> f64 {
    ascending(&mut values);
    quantile(&values, 0.9).unwrap_or(0.0)
}
