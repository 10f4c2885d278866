//! Power spectra over bodies, with confidence bands.

use crate::jackknife::Sums;
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
    /// The band is `power` times these two factors: 95 %, at every single frequency. NaN where the few bodies may differ.
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
/// Bodies that differ by more than chance have fewer degrees of freedom: n/d, d the variance of the powers over bodies (from 8 on), as a
/// part of that of n degrees, 2 P^2/n, both summed over frequencies (as for shares of a distribution).
///
/// The spectrum is that of the samples: what is faster than half a cycle per sample is folded back.
///
/// Segments: a power of 2 of samples, at least 16 segments in all. `None` if the tracks are too short for that.
///
/// Source: Welch (1967), IEEE Trans. Audio Electroacoust. 15, 70; Percival and Walden (1993), Spectral
/// Analysis for Physical Applications, 6.17 (degrees of freedom).
///
/// # Errors    none for samples that [`Tracks`] accepts
/// # Checked by  tests/all/power.rs: white noise and Ornstein-Uhlenbeck within their bands
pub fn power_spectrum(tracks: &Tracks, quantity: &Quantity) -> Result<Option<PowerSpectrum>> {
    let over_bodies = tracks.bodies().len() == tracks.units().len();
    let all: Vec<Series> = tracks.bodies().iter().map(|track| quantity.of(track)).collect();
    let runs_of = |(body, series): (usize, &'_ Series)| series.runs().into_iter().map(move |run| (body, run));
    let runs: Vec<(usize, &Series, Range<usize>)> =
        all.iter().enumerate().flat_map(runs_of).map(|(body, run)| (body, &all[body], run)).collect();
    let Some(length) = segment(&runs.iter().map(|(.., run)| run.len()).collect::<Vec<_>>()) else {
        return Ok(None);
    };
    let (mut sums, mut segments) = (vec![Sums::new(tracks.groups()); length / 2 - 1], 0);
    for (body, series, run) in runs.into_iter().filter(|(.., run)| run.len() >= length) {
        let mut power = vec![0.0; sums.len()];
        let mut counted = 0;
        for component in &series.components {
            let spectrum = welch(&component[run.clone()], tracks.dt(), length)?;
            counted = spectrum.segments;
            power.iter_mut().zip(&spectrum.power[1..]).for_each(|(sum, value)| *sum += value);
        }
        for (sums, power) in sums.iter_mut().zip(power) {
            sums.add(tracks.group(body), power * counted as f64, counted as f64);
        }
        segments += counted;
    }
    let power: Vec<f64> = sums.iter().map(|sums| sums.mean(None)).collect();
    let chance = 36.0 / 19.0 * segments as f64;
    let freedom = chance / if over_bodies { design_effect(&sums, chance) } else { 1.0 };
    let band = [0.975, 0.025].map(|share| freedom / chi_square_quantile(share, freedom));
    let frequencies = (1..length / 2).map(|k| k as f64 / (length as f64 * tracks.dt())).collect();
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

/// The variance of powers over groups of bodies as a part of that of Gaussian processes with so many degrees of freedom; 1 at least.
fn design_effect(sums: &[Sums], freedom: f64) -> f64 {
    let over_groups: f64 = sums.iter().map(Sums::variance).sum();
    let chance: f64 = sums.iter().map(|sums| 2.0 * sums.mean(None).powi(2) / freedom).sum();
    (over_groups / chance).max(1.0)
}
