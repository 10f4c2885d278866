//! The course of the speed over time and direction, by blocks of the record, and that of the place, by turns of the heading.

use super::measures::{BLOCKS, mean, scatter};
use motiform_inference::Observation;
use std::f64::consts::TAU;

/// Fewest full turns that show whether a circle drifts.
const LEAST_TURNS: usize = 4;

/// Most lags at which turns are looked at.
const MOST_LAGS: usize = 32;

/// Standard errors beyond which a dependence is seen.
const CLEAR: f64 = 4.0;

/// Change of a series from its first to its last block by a straight line through the means of its blocks, relative to its mean; 0 within
/// its error.
pub(super) fn trend(values: &[f64]) -> f64 {
    let means: Vec<f64> = blocks(values.len()).map(|block| mean(values[block].iter().copied())).collect();
    let place = |k: usize| k as f64 - 0.5 * (means.len() as f64 - 1.0);
    let squares: f64 = (0..means.len()).map(|k| place(k) * place(k)).sum();
    let centre = mean(means.iter().copied());
    let slope = means.iter().enumerate().map(|(k, value)| place(k) * value).sum::<f64>() / squares;
    let left = means.iter().enumerate().map(|(k, value)| value - centre - slope * place(k));
    let variance = left.map(|value| value * value).sum::<f64>() / (means.len() as f64 - 2.0);
    let clear = slope.abs() > CLEAR * (variance / squares).sqrt();
    if clear { slope * (means.len() as f64 - 1.0) / centre } else { 0.0 }
}

/// Standard error of the mean turning rate of these headings, which is their change over the record over its time.
///
/// The mean square turn beside the mean rate grows with the lag as that of a random walk of the heading does, to which errors and
/// oscillations add what does not grow: `(max V(lag) + q n)/T^2` with the slope q of V over lags up to an eighth of the record. The scatter
/// of turns of blocks overstates errors of the headings, which blocks side by side share.
pub(super) fn turning_error(headings: &[f64], dt: f64, rate: f64) -> f64 {
    let n = headings.len().saturating_sub(1).max(1);
    let longest = (n / BLOCKS).max(1);
    let point = |lag: usize| {
        let off = headings.windows(lag + 1).map(|pair| pair[lag] - pair[0] - rate * dt * lag as f64);
        [lag as f64, mean(off.map(|turn| turn * turn))]
    };
    let points: Vec<[f64; 2]> = (1..=longest).step_by((longest / MOST_LAGS).max(1)).map(point).collect();
    let [lag, value] = [0, 1].map(|k| mean(points.iter().map(|point| point[k])));
    let (mut product, mut square) = (0.0, 0.0);
    for [x, y] in &points {
        product += (x - lag) * (y - value);
        square += (x - lag) * (x - lag);
    }
    let slope = if square > 0.0 { (product / square).max(0.0) } else { value };
    let most = points.iter().map(|point| point[1]).fold(0.0, f64::max);
    (most + slope * n as f64).sqrt() / (n as f64 * dt)
}

/// Amplitude of a series of speeds as `cos 2 (heading - axis)`, relative to its mean; 0 within its error, which is the scatter of the
/// blocks.
pub(super) fn axis(speeds: &[f64], headings: &[f64]) -> f64 {
    let centre = mean(speeds.iter().copied());
    let part = |of: fn(f64) -> f64| -> Vec<f64> {
        let block = |block: std::ops::Range<usize>| {
            let pairs = speeds[block.clone()].iter().zip(&headings[block]);
            2.0 * mean(pairs.map(|(speed, heading)| (speed - centre) * of(2.0 * heading)))
        };
        blocks(speeds.len()).map(block).collect()
    };
    let [re, im] = [part(libm::cos), part(libm::sin)];
    let amplitude = libm::hypot(mean(re.iter().copied()), mean(im.iter().copied()));
    let error = libm::hypot(scatter(&re), scatter(&im)) / (re.len() as f64 - 1.0).sqrt();
    if amplitude > CLEAR * error { amplitude / centre } else { 0.0 }
}

/// Speed of the place to which a cell comes back after each full turn of its heading, and its error: the mean of the displacements of the
/// turns and that of their scatter. `headings` are unwrapped, each over `lag` frames; `None` with fewer than four turns.
pub(super) fn drift(
    frames: &[Observation],
    headings: &[f64],
    lag: usize,
    turning: f64,
    dt: f64,
) -> Option<[f64; 2]> {
    let turned = |k: usize| turning.signum() * (headings[k] - headings[0]);
    // where each turn is complete, between two samples, as a place along the frames
    let mut ends = vec![0.5 * lag as f64];
    for k in 1..headings.len() {
        while turned(k) >= ends.len() as f64 * TAU {
            let part = (ends.len() as f64 * TAU - turned(k - 1)) / (turned(k) - turned(k - 1));
            ends.push((k - 1) as f64 + part.clamp(0.0, 1.0) + 0.5 * lag as f64);
        }
    }
    let count = ends.len().saturating_sub(1);
    if count < LEAST_TURNS {
        return None;
    }
    let moved = |axis: usize| -> Vec<f64> {
        ends.windows(2).map(|pair| place(frames, pair[1])[axis] - place(frames, pair[0])[axis]).collect()
    };
    let [x, y] = [moved(0), moved(1)];
    let size = libm::hypot(mean(x.iter().copied()), mean(y.iter().copied()));
    let error = libm::hypot(scatter(&x), scatter(&y)) / (count as f64 - 1.0).sqrt();
    let turn = (ends[count] - ends[0]) * dt / count as f64;
    Some([size / turn, error / turn])
}

/// The place between two frames, by a straight line.
pub(super) fn place(frames: &[Observation], at: f64) -> [f64; 2] {
    let first = (at as usize).min(frames.len() - 2);
    let part = at - first as f64;
    [0, 1].map(|k| frames[first].y[k] + part * (frames[first + 1].y[k] - frames[first].y[k]))
}

/// Equal blocks of a series.
fn blocks(length: usize) -> impl Iterator<Item = std::ops::Range<usize>> {
    (0..BLOCKS).map(move |k| length * k / BLOCKS..length * (k + 1) / BLOCKS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_trend_and_an_axis_are_seen_beside_noise() {
        let noise = |k: u32| 0.05 * libm::sin(1.7 * f64::from(k * k));
        let heading: Vec<f64> = (0..400).map(|k| 0.13 * f64::from(k)).collect();
        let steady: Vec<f64> = (0..400).map(|k| 2.0 + noise(k)).collect();
        let slows: Vec<f64> = (0..400).map(|k| 2.0 - 0.002 * f64::from(k) + noise(k)).collect();
        let ellipse: Vec<f64> =
            (0..400).map(|k| 2.0 + 0.5 * libm::cos(2.0 * (heading[k as usize] - 0.3)) + noise(k)).collect();
        assert_eq!([trend(&steady), axis(&steady, &heading)], [0.0; 2]);
        assert!((trend(&slows) + 0.7 / 1.6).abs() < 0.02, "{}", trend(&slows));
        assert!((axis(&ellipse, &heading) - 0.25).abs() < 0.02, "{}", axis(&ellipse, &heading));
    }
}
