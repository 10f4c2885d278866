//! Power spectra over bodies, with confidence bands.

use crate::{Quantity, Result, Series, Tracks};
use motiform_analysis::welch;
use motiform_dynamics::distributions::chi_square_quantile;
use std::ops::Range;

/// Segments per track: at least so many half-overlapping ones where there are few bodies, and where there are many.
const SEGMENTS: (usize, usize) = (16, 2);

/// A power spectral density with its band.
#[derive(Debug, Clone, PartialEq)]
pub struct PowerSpectrum {
    /// The quantity.
    pub quantity: Quantity,
    /// Frequencies above 0 (cycles per model time), without the last one of even segments.
    pub frequencies: Vec<f64>,
    /// Power spectral density, summed over the components.
    pub power: Vec<f64>,
    /// The band is `power` times these two factors: 95 %, at every single frequency.
    pub band: [f64; 2],
    /// Segments that were averaged, half overlapping.
    pub segments: usize,
    /// Samples of a segment.
    pub length: usize,
}

/// The mean over all bodies and segments of the periodograms of Welch's method ([`welch`]), with the chi-square band.
///
/// band: power times n/chi2(0.975; n) to n/chi2(0.025; n); n = 36 K/19 for K half-overlapping segments with a
/// Hann window (a little more where a body has only one). That is the band of a Gaussian process whose
/// spectrum is smooth over 1/(N dt). For a vector n is that of one component: exact where the two are bound
/// to each other (turning one way), too wide by up to sqrt 2 where they are independent.
///
/// Segments: a power of 2 of samples, at least 16 segments in all. `None` if the tracks are too short for that.
///
/// Source: Welch (1967), IEEE Trans. Audio Electroacoust. 15, 70; Percival and Walden (1993), Spectral
/// Analysis for Physical Applications, 6.17 (degrees of freedom).
///
/// # Errors    none for samples that [`Tracks`] accepts
/// # Checked by  tests/all/power.rs: white noise and Ornstein-Uhlenbeck within their bands
pub fn power_spectrum(tracks: &Tracks, quantity: &Quantity) -> Result<Option<PowerSpectrum>> {
    let all: Vec<Series> = tracks.bodies().iter().map(|track| quantity.of(track)).collect();
    let runs: Vec<(&Series, Range<usize>)> =
        all.iter().flat_map(|series| series.runs().into_iter().map(move |run| (series, run))).collect();
    let Some(length) = segment(&runs.iter().map(|(_, run)| run.len()).collect::<Vec<_>>()) else {
        return Ok(None);
    };
    let (mut power, mut segments) = (vec![0.0; length / 2 + 1], 0);
    for (series, run) in runs.into_iter().filter(|(_, run)| run.len() >= length) {
        let mut counted = 0;
        for component in &series.components {
            let spectrum = welch(&component[run.clone()], tracks.dt(), length)?;
            counted = spectrum.segments;
            for (sum, value) in power.iter_mut().zip(spectrum.power) {
                *sum += value * counted as f64;
            }
        }
        segments += counted;
    }
    power.iter_mut().for_each(|sum| *sum /= segments as f64);
    let freedom = 36.0 / 19.0 * segments as f64;
    let band = [0.975, 0.025].map(|share| freedom / chi_square_quantile(share, freedom));
    let frequencies = (1..length / 2).map(|k| k as f64 / (length as f64 * tracks.dt())).collect();
    let power = power[1..length / 2].to_vec();
    Ok(Some(PowerSpectrum { quantity: quantity.clone(), frequencies, power, band, segments, length }))
}

/// The largest power of 2 that leaves enough segments of stretches of these lengths.
fn segment(lengths: &[usize]) -> Option<usize> {
    let segments = |size: usize| -> usize {
        lengths.iter().filter(|&&n| n >= size).map(|n| (n - size) / (size - size / 2) + 1).sum()
    };
    let longest = *lengths.iter().max()?;
    let each = |size: usize| longest >= size && (longest - size) / (size - size / 2) + 1 >= SEGMENTS.1;
    (3..40).map(|k| 1_usize << k).filter(|&size| segments(size) >= SEGMENTS.0 && each(size)).max()
}
