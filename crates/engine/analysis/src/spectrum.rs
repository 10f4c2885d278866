//! Power spectral density of evenly spaced samples.

use crate::transforms::planned;
use crate::{Error, Result, checks};
use std::f64::consts::TAU;

/// Shortest segment whose Hann window has more than one value above a half.
const LEAST_SEGMENT: usize = 4;

/// A one-sided power spectral density.
///
/// # Units   frequencies: cycles per model time; power: (unit of the samples)^2 x model time
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum {
    /// f_k = k/(N dt), k = 0..=N/2, for segments of N samples.
    pub frequencies: Vec<f64>,
    /// P(f_k), one per frequency, at least 0.
    pub power: Vec<f64>,
    /// Number of segments averaged; the relative standard error of a value is about 1/sqrt(segments).
    pub segments: usize,
}

impl Spectrum {
    /// Distance of neighbouring frequencies, 1/(N dt).
    pub fn spacing(&self) -> f64 {
        self.frequencies.get(1).copied().unwrap_or(0.0)
    }

    /// Variance carried by the frequencies from `from` to `to`: sum of P(f_k) / (N dt) over from <= f_k <= to.
    ///
    /// Over all frequencies this is the variance of the samples about the means of their segments, weighted by the
    /// squared window (Parseval); over the peak of a sine of amplitude A it is A^2/2.
    ///
    /// # Checked by  tests/all/welch.rs
    pub fn variance_between(&self, from: f64, to: f64) -> f64 {
        let inside = self.frequencies.iter().zip(&self.power).filter(|(f, _)| (from..=to).contains(f));
        inside.map(|(_, p)| p).sum::<f64>() * self.spacing()
    }
}

/// Power spectral density by Welch's method: the mean over half-overlapping segments of their periodograms.
///
/// P(f_k) = c_k dt / sum w_j^2 |sum_j w_j (x_j - m) exp(-2 pi i j k/N)|^2, averaged over the segments; Hann window
/// w_j = (1 - cos(2 pi j/N))/2; m the mean of the segment; c_k = 1 at f = 0 and (even N) at the last frequency, else 2.
/// Segments start every N - floor(N/2) samples; what remains at the end is not used.
///
/// Source: Welch (1967), IEEE Trans. Audio Electroacoust. 15, 70; conventions of `scipy.signal.welch` (window "hann",
/// detrend "constant", scaling "density").
///
/// # Units     `dt`: model time between samples; `segment`: N, in samples; result: see [`Spectrum`]
/// # Errors    `dt` not positive, N below 4 or above the number of samples, a sample not finite or too large to square
/// # Not       for unevenly spaced samples: interpolate first; lines closer than 2/(N dt) are not told apart
/// # Checked by  tests/all/welch.rs: Parseval (exact), sine (exact), white noise, SciPy (reference/welch.toml)
///
/// ```
/// // 3 sin(2 pi t/4), sampled at t = 0, 1, 2, ...: all its variance 3^2/2 is at frequency 1/4
/// let samples: Vec<f64> = [0.0, 3.0, 0.0, -3.0].repeat(100);
/// let spectrum = motiform_analysis::welch(&samples, 1.0, 64)?;
/// assert!((spectrum.variance_between(0.2, 0.3) - 4.5).abs() < 1e-12);
/// # Ok::<(), motiform_analysis::Error>(())
/// ```
pub fn welch(samples: &[f64], dt: f64, segment: usize) -> Result<Spectrum> {
    check(samples, dt, segment)?;
    let window = hann(segment);
    let (mut power, segments) = squares(samples, &window)?;
    let density = dt / (window.iter().map(|w| w * w).sum::<f64>() * segments as f64);
    for (k, sum) in power.iter_mut().enumerate() {
        let alone = k == 0 || 2 * k == segment; // its own mirror image
        *sum *= if alone { density } else { 2.0 * density };
    }
    if !power.iter().all(|p| p.is_finite()) {
        return Err(checks::overflow(samples));
    }
    let frequencies = (0..power.len()).map(|k| k as f64 / (segment as f64 * dt)).collect();
    Ok(Spectrum { frequencies, power, segments })
}

/// sum over segments of |sum_j w_j (x_j - m) exp(-2 pi i j k/N)|^2, and the number of segments.
fn squares(samples: &[f64], window: &[f64]) -> Result<(Vec<f64>, usize)> {
    let segment = window.len();
    let transform = planned(|plans| plans.plan_fft_forward(segment));
    let (mut input, mut output) = (transform.make_input_vec(), transform.make_output_vec());
    let mut scratch = transform.make_scratch_vec();
    let mut power = vec![0.0; output.len()];
    let mut segments = 0;
    for part in samples.windows(segment).step_by(segment - segment / 2) {
        let mean = part.iter().sum::<f64>() / segment as f64;
        for ((x, sample), w) in input.iter_mut().zip(part).zip(window) {
            *x = w * (sample - mean);
        }
        transform.process_with_scratch(&mut input, &mut output, &mut scratch)?;
        for (sum, z) in power.iter_mut().zip(&output) {
            *sum += z.norm_sqr();
        }
        segments += 1;
    }
    Ok((power, segments))
}

/// The periodic Hann window (1 - cos(2 pi j/N))/2.
fn hann(length: usize) -> Vec<f64> {
    (0..length).map(|j| 0.5 - 0.5 * libm::cos(TAU * j as f64 / length as f64)).collect()
}

fn check(samples: &[f64], dt: f64, segment: usize) -> Result<()> {
    if !(dt > 0.0 && dt.is_finite()) {
        return Err(Error::Interval { dt });
    }
    if segment < LEAST_SEGMENT {
        return Err(Error::Segment { segment, least: LEAST_SEGMENT });
    }
    if samples.len() < segment {
        return Err(Error::TooShort { samples: samples.len(), segment });
    }
    checks::finite(samples)
}
