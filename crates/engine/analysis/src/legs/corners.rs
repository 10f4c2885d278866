//! The corners of a path.

use super::path::{PathSample, wrapped};
use std::f64::consts::TAU;

/// A speed below this part of the top speed is rest: no heading is taken from it and no corner is seen inside it.
pub(super) const REST: f64 = 1e-6;

/// A stop is deeper than this part of the smaller of the adjacent maxima.
const DEEP: f64 = 0.5;

/// A turning rate below this part of its maximum counts as zero.
const STRAIGHT: f64 = 0.01;

/// A turn between two samples above this is a reversal: its sense is round-off. (3/4 of pi.)
const REVERSAL: f64 = 2.356;

/// Headings along a path, unwrapped, with their times; samples at rest are left out.
///
/// A reversal between two samples is taken back into the range of headings seen so far.
pub(super) fn headings(path: &[PathSample]) -> Vec<(f64, f64)> {
    let rest = REST * top_speed(path);
    let mut all: Vec<(f64, f64)> = Vec::with_capacity(path.len());
    let mut range = None;
    for sample in path.iter().filter(|sample| sample.speed() > rest) {
        let heading = match (range, all.last()) {
            (Some((low, high)), Some(last)) => {
                let counter_clockwise = last.1 <= 0.5 * (low + high);
                last.1 + turn_between(last.1, sample.heading(), counter_clockwise)
            }
            _ => sample.heading(),
        };
        let (low, high) = range.unwrap_or((heading, heading));
        range = Some((heading.min(low), heading.max(high)));
        all.push((sample.t, heading));
    }
    all
}

/// The turn from one heading to the next: the shorter way, or for a reversal the way asked for.
fn turn_between(from: f64, to: f64, counter_clockwise: bool) -> f64 {
    let turn = wrapped(to - from);
    match turn.abs() > REVERSAL {
        true if counter_clockwise && turn < 0.0 => turn + TAU,
        true if !counter_clockwise && turn > 0.0 => turn - TAU,
        _ => turn,
    }
}

pub(super) fn top_speed(path: &[PathSample]) -> f64 {
    path.iter().fold(0.0, |m: f64, sample| m.max(sample.speed()))
}

/// Times of the deep minima of the speed: below half of the smaller of the maxima beside them.
pub(super) fn stops(path: &[PathSample]) -> Vec<f64> {
    let speeds: Vec<f64> = path.iter().map(PathSample::speed).collect();
    let rest = REST * top_speed(path);
    let (mut found, mut highest, mut lowest) = (Vec::new(), speeds[0], None);
    for (index, &speed) in speeds.iter().enumerate() {
        match lowest {
            None if speed < DEEP * highest && highest > rest => lowest = Some(index),
            None => highest = highest.max(speed),
            Some(low) if speed < speeds[low] => lowest = Some(index),
            Some(low) if DEEP * speed > speeds[low].max(rest) => {
                found.push(extremum(path, low, |i| speeds[i] * speeds[i]));
                (lowest, highest) = (None, speed);
            }
            Some(_) => {}
        }
    }
    found
}

/// Times of the largest |turning rate| of each stretch between two zeros of it.
pub(super) fn bends(path: &[PathSample]) -> Vec<f64> {
    let headings = headings(path);
    let rate = |pair: &[(f64, f64)]| {
        (0.5 * (pair[0].0 + pair[1].0), (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0))
    };
    let rates: Vec<(f64, f64)> = headings.windows(2).map(rate).collect();
    let largest = rates.iter().fold(0.0, |m: f64, r| m.max(r.1.abs()));
    let duration = path[path.len() - 1].t - path[0].t;
    if largest * duration < 1e-6 {
        return Vec::new(); // straight up to rounding
    }
    // +1, 0, -1; the stretches between changes, without the first and the last, which have one end only
    let sense = |rate: f64| if rate.abs() < STRAIGHT * largest { 0.0 } else { rate.signum() };
    let mut changes: Vec<usize> =
        (1..rates.len()).filter(|&i| sense(rates[i].1) != sense(rates[i - 1].1)).collect();
    changes.dedup();
    let stretch = |ends: &[usize]| {
        let bent = sense(rates[ends[0]].1) != 0.0;
        let top = (ends[0]..ends[1]).max_by(|&a, &b| rates[a].1.abs().total_cmp(&rates[b].1.abs()))?;
        bent.then(|| vertex(&rates, top))
    };
    changes.windows(2).filter_map(stretch).collect()
}

/// Time of the extremum of `value` near sample `index`, by a parabola.
fn extremum(path: &[PathSample], index: usize, value: impl Fn(usize) -> f64) -> f64 {
    let near: Vec<(f64, f64)> =
        (index.saturating_sub(1)..=(index + 1).min(path.len() - 1)).map(|i| (path[i].t, value(i))).collect();
    if near.len() < 3 { path[index].t } else { vertex(&near, 1) }
}

/// Time of the vertex of the parabola through the points `index - 1 ..= index + 1`, kept between the outer two.
fn vertex(points: &[(f64, f64)], index: usize) -> f64 {
    let (Some(&b), Some(&c)) = (points.get(index), points.get(index + 1)) else { return points[index].0 };
    let Some(&a) = index.checked_sub(1).and_then(|before| points.get(before)) else { return b.0 };
    let (left, right) = ((b.1 - a.1) / (b.0 - a.0), (c.1 - b.1) / (c.0 - b.0));
    let curvature = (right - left) / (c.0 - a.0);
    let t = 0.5 * (a.0 + b.0) - 0.5 * left / curvature;
    if t.is_finite() { t.clamp(a.0, c.0) } else { b.0 }
}
