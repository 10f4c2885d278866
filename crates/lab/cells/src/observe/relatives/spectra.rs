//! Power spectra of a record, and the peaks that stand out of them.

use super::super::measures::Series;
use super::{along_and_across, middles};
use motiform_analysis::{Spectrum, welch};
use motiform_dynamics::sample::median;
use motiform_dynamics::sample::sort_by_number;
use serde::Serialize;

/// A peak is this many times the median power from half its frequency to twice.
const PROMINENT: f64 = 7.0;
/// A peak holds this share of the variance at least.
const LEAST_SHARE: f64 = 0.05;
/// Most peaks that are given.
const MOST: usize = 3;
/// First frequency that counts, in spacings: below, a segment holds less than two periods.
const FIRST: usize = 2;

/// A peak of a spectrum.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SpectralPeak {
    /// Its frequency (cycles per time): the vertex of a parabola through the logarithms of three powers.
    pub frequency: f64,
    /// Share of the variance within two spacings of it.
    pub share: f64,
    /// Its power over the median power from half its frequency to twice.
    pub prominence: f64,
}

/// The spectrum of a quantity: Welch's method, Hann windows of half the record that overlap by half.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ObservedSpectrum {
    /// `speed`, `|z2|` or `z2 across`.
    pub quantity: &'static str,
    /// Distance of neighbouring frequencies, from 0 on.
    pub spacing: f64,
    /// Power spectral density.
    pub power: Vec<f64>,
    /// The largest peaks, the largest share first. Noise, also with memory, has one in fewer than 5 % of spectra.
    pub peaks: Vec<SpectralPeak>,
}

pub(super) fn of(series: &Series) -> Vec<ObservedSpectrum> {
    let size = middles(series).iter().map(|frame| libm::hypot(frame.y[2], frame.y[3])).collect();
    let across = along_and_across(series).iter().map(|z| z[1]).collect();
    let all: [(&'static str, Vec<f64>); 3] =
        [("speed", series.speeds.clone()), ("|z2|", size), ("z2 across", across)];
    all.into_iter().filter_map(|(name, samples)| spectrum(name, &samples, series.dt)).collect()
}

fn spectrum(quantity: &'static str, samples: &[f64], dt: f64) -> Option<ObservedSpectrum> {
    let found = welch(samples, dt, samples.len() / 2).ok()?;
    let total = found.variance_between(0.0, f64::INFINITY);
    let mut peaks: Vec<SpectralPeak> =
        (FIRST..found.power.len() - 1).filter_map(|k| peak(&found, k, total)).collect();
    sort_by_number(&mut peaks, |a| -a.share);
    peaks.truncate(MOST);
    Some(ObservedSpectrum { quantity, spacing: found.spacing(), power: found.power, peaks })
}

/// The peak at the frequency number `k`, if there is one.
fn peak(spectrum: &Spectrum, k: usize, total: f64) -> Option<SpectralPeak> {
    let power = &spectrum.power;
    if !(power[k] > power[k - 1] && power[k] >= power[k + 1]) {
        return None;
    }
    let near = &power[(k / 2).max(1)..(2 * k + 1).min(power.len())];
    let prominence = power[k] / median(near.iter().copied())?;
    let broad = near.len() > 4; // with fewer, the peak is its own background
    let [left, middle, right] =
        [-1, 0, 1].map(|step: isize| libm::log(power[k.saturating_add_signed(step)].max(f64::MIN_POSITIVE)));
    let shift = 0.5 * (left - right) / (left - 2.0 * middle + right).min(-f64::MIN_POSITIVE);
    let frequency = (k as f64 + shift.clamp(-0.5, 0.5)) * spectrum.spacing();
    let width = 2.0 * spectrum.spacing();
    let share = spectrum.variance_between(frequency - width, frequency + width) / total;
    (broad && prominence > PROMINENT && share >= LEAST_SHARE).then_some(SpectralPeak {
        frequency,
        share,
        prominence,
    })
}

#[cfg(test)]
mod tests {
    use super::spectrum;
    use motiform_dynamics::Normal;

    /// An autoregressive series `x <- memory x + noise`.
    fn noise(memory: f64, count: usize, seed: u64) -> Vec<f64> {
        let mut normal = Normal::new(seed, 0);
        let mut x = 0.0;
        (0..count + 100)
            .map(|_| {
                x = memory * x + normal.next();
                x
            })
            .skip(100)
            .collect()
    }

    #[test]
    fn noise_has_no_peak() {
        for (memory, count) in [(0.0, 200), (0.9, 200), (0.98, 1000), (0.0, 1000)] {
            let peaks = |seed| spectrum("x", &noise(memory, count, seed), 1.0).unwrap().peaks.len();
            let wrong = (0..200).filter(|&seed| peaks(seed) > 0).count();
            println!("memory {memory}, {count} samples: {wrong} of 200 have a peak");
            assert!(wrong <= 10, "{memory} {count}: {wrong}"); // 5 %
        }
    }

    #[test]
    fn a_period_within_noise_is_a_peak_at_its_frequency() {
        for period in [9.0, 21.7, 60.0] {
            let samples: Vec<f64> = noise(0.8, 600, 5)
                .iter()
                .zip(0..)
                .map(|(x, t)| 0.5 * x + 2.0 * libm::sin(std::f64::consts::TAU * f64::from(t) / period))
                .collect();
            let found = spectrum("x", &samples, 0.5).unwrap();
            let first = found.peaks[0];
            assert!((first.frequency - 2.0 / period).abs() < 0.3 * found.spacing, "{period}: {first:?}");
            assert!(first.share > 0.7, "{first:?}");
        }
    }
}
