//! The course of the speed over time and direction, by blocks of the record.

use super::measures::{BLOCKS, mean, scatter};

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
