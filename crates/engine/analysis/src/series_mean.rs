//! The mean of a correlated series, with an error that can be trusted, or with none.

use crate::{Estimate, Result, checks};
use motiform_dynamics::distributions::student_quantile;

/// Errors of a short series of up to so many cosines are so many times wider: the spectrum falls over its lowest cosines, and where two
/// or three were taken the correlation time is often underestimated.
const WIDER: (usize, f64) = (3, 1.3);

/// Least and most cosines; below the least there is no error.
const COSINES: (usize, usize) = (4, 16);

/// Independent samples for each cosine: the highest one still has a period of `2 pi` correlation times and more, where the
/// spectrum of the series is flat to a few per cent (AR(1): 6 % lower at the highest one).
const PER_COSINE: f64 = 4.0;

/// Independent samples for each cosine of a short series, whose correlation time is underestimated.
const PER_COSINE_OF_FEW: f64 = 6.0;

/// Fewest samples, and fewest of a short series: its highest cosine has a period of two samples.
const LEAST: usize = 64;
const LEAST_OF_FEW: usize = 16;

/// Mean of a correlated stationary series, with its 95 % error from the lowest cosines of its fluctuations.
///
/// error = t_nu sqrt( (2/nu) sum_j c_j^2 ) / n,   c_j = sum_i (x_i - m) cos(pi j (i - 1/2)/n),   j = 1 .. nu
///
/// The mean is the component of frequency 0. Where the spectrum is flat, each of the slowest cosines has half its variance, and
/// they are independent and normal: the quotient has Student's t distribution. The number of independent samples, n / tau, says
/// how far the spectrum is flat: nu = n / (4 tau), at most 16, with the integrated correlation time tau = 1 + 2 sum rho_k by
/// Geyer's initial monotone sequence. Fewer than 16 independent samples have no error (it is infinite, see [`Estimate`]): such a
/// series does not show how much its mean would change if it went on.
///
/// Where the sum of the samples is the difference of two ends, as the growth along a neutral direction is, the mean is off by
/// `(b_n - b_0) / n`; the cosines show the ends, `c_j = -b_0 + (-1)^j b_n` and slow parts of `b` of order
/// `j sqrt(tau_b / n)`, and the error is some three times the usual difference: a bound, which shrinks like
/// 1/n.
///
/// Measured coverage (1000 series of 2000 samples, AR(1), tests/all/series_mean.rs): 93 to 96 % for correlation times of up to 1/50
/// of the series, half widths 1.05 to 1.2 times those of the known spectrum. One series in 30 of correlation time 1/50 has no error; a
/// still longer correlation time shows as no error, or as one that is too small: no method can see it in one series.
///
/// Source: Mueller (2007), J. Econometrics 141, 1331; Lazarus, Lewis, Stock, Watson (2018), J. Bus. Econ. Stat. 36, 541 (equal
/// weights on cosines); Geyer (1992), Stat. Sci. 7, 473 (monotone sequence).
///
/// # Units     those of the samples
/// # Errors    [`crate::Error::TooFew`] below 64 samples, [`crate::Error::NotFinite`], [`crate::Error::Overflow`]
/// # Not       for series with a trend or a transient: cut it off first
/// # Checked by  tests/all/series_mean.rs: coverage, a series by hand, ends, trends, constants; tests/all/lyapunov.rs: Lorenz
///
/// ```
/// let turning_rates: Vec<f64> = (0..640).map(|j| f64::from(j % 10)).collect();
/// let mean = motiform_analysis::series_mean(&turning_rates)?;
/// assert_eq!(mean.value, 4.5);
/// assert!(mean.error < 0.1); // ten values make a turn: the mean of whole turns is exact, and off by the ends otherwise
/// # Ok::<(), motiform_analysis::Error>(())
/// ```
pub fn series_mean(samples: &[f64]) -> Result<Estimate> {
    mean_over(samples, &vec![1.0; samples.len()])
}

/// [`series_mean`] of records that are what they are: 16 samples and more have an error, whatever their correlation time.
///
/// nu = n / (6 tau), at least 1; up to nu = 3 the error is 1.3 times that of [`series_mean`]
///
/// A rule that refuses series of few independent samples keeps those whose correlation time looks short by chance, and with it
/// their error: of AR(1) series of 20, 15 and 8 correlation times [`series_mean`] refuses 61, 75 and 93 %, and the others hold the mean
/// in 87, 78 and 57 %. Here one cosine has an error of its own, with 12.7 standard errors, and without the factor of 1.3 all of them hold
/// it in 91 to 93 %.
///
/// Measured coverage (3000 series each): AR(1) of 3 to 100 correlation times 93 to 96 %; log-normal series 89 to 92 % (standard deviation
/// of the logarithm 1) and 93 to 95 % (0.4); series that jump between two values 91 to 94 % from 12 correlation times on, below that they
/// hardly return (66 % of 3).
///
/// # Units     those of the samples
/// # Errors    [`crate::Error::TooFew`] below 16 samples, [`crate::Error::NotFinite`], [`crate::Error::Overflow`]
/// # Checked by  tests/all/series_mean.rs: coverage of short series
pub fn short_series_mean(samples: &[f64]) -> Result<Estimate> {
    // below twice as many independent samples as a cosine takes there is one, whatever their number
    with_cosines(samples, &vec![1.0; samples.len()], LEAST_OF_FEW, |off| {
        let count = cosines(independent(off, 2.0 * PER_COSINE_OF_FEW), PER_COSINE_OF_FEW).max(1);
        Some((count, if count <= WIDER.0 { WIDER.1 } else { 1.0 }))
    })
}

/// [`series_mean`] of samples that stand for times of different lengths: `m = sum d_i x_i / sum d_i`, and the error is that of
/// the sum of the `d_i (x_i - m)` (a ratio of sums), with cosines of the time.
pub(crate) fn mean_over(samples: &[f64], durations: &[f64]) -> Result<Estimate> {
    with_cosines(samples, durations, LEAST, |off| {
        let count = cosines(independent(off, FEWEST_INDEPENDENT), PER_COSINE);
        (count >= COSINES.0).then_some((count, 1.0))
    })
}

/// The mean with the error of as many cosines as the fluctuations have, so many times wider; infinite for `None`.
fn with_cosines(
    samples: &[f64],
    durations: &[f64],
    least: usize,
    count: impl Fn(&[f64]) -> Option<(usize, f64)>,
) -> Result<Estimate> {
    checks::at_least("the error of a mean, in samples,", least, samples.len())?;
    checks::finite(samples)?;
    let total: f64 = durations.iter().sum();
    let value = mean(samples, durations, samples[0]);
    let off: Vec<f64> = samples.iter().zip(durations).map(|(x, d)| (x - value) * d).collect();
    if !(value.is_finite() && off.iter().map(|x| x * x).sum::<f64>().is_finite()) {
        return Err(checks::overflow(samples));
    }
    let error = count(&off).map_or(f64::INFINITY, |(count, wider)| {
        wider * student_quantile(count) * (2.0 / count as f64 * slowest(&off, durations, total, count)).sqrt()
            / total
    });
    Ok(Estimate { value, error })
}

/// Number of independent samples that determine a mean as well as the samples of these durations: n over the
/// integrated correlation time.
pub(crate) fn independent_samples(samples: &[f64], durations: &[f64]) -> f64 {
    let value = mean(samples, durations, samples[0]);
    let off: Vec<f64> = samples.iter().zip(durations).map(|(x, d)| (x - value) * d).collect();
    independent(&off, 0.0)
}

/// Fewest independent samples that have an error.
pub(crate) const FEWEST_INDEPENDENT: f64 = PER_COSINE * COSINES.0 as f64;

/// The number of cosines for so many independent samples, `each` for one of them.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small number of at least 0")]
fn cosines(independent: f64, each: f64) -> usize {
    (independent / each).min(COSINES.1 as f64) as usize
}

/// `n / tau` for fluctuations around a mean; tau is at least 1, and 1 for none at all.
///
/// tau = -1 + 2 sum over m of (rho_2m + rho_2m+1), as long as the pairs are positive, none larger than the
/// one before. The sum only grows: where fewer than `least` are left it ends, and the number is a bound. (A
/// transient would otherwise take all its n^2 / 2 products.)
fn independent(off: &[f64], least: f64) -> f64 {
    let n = off.len();
    let lagged = |lag: usize| -> f64 { off.iter().zip(&off[lag..]).map(|(a, b)| a * b).sum() };
    let variance = lagged(0);
    if variance == 0.0 {
        return n as f64;
    }
    let (mut sum, mut last) = (-variance, f64::MAX);
    for lag in (0..n - 1).step_by(2) {
        let pair = lagged(lag) + lagged(lag + 1);
        if pair <= 0.0 {
            break;
        }
        last = pair.min(last);
        sum += 2.0 * last;
        if n as f64 * variance < least * sum {
            break;
        }
    }
    n as f64 / (sum / variance).max(1.0)
}

/// `sum_j c_j^2` over the slowest cosines, of fluctuations that are already weighted with their durations.
fn slowest(off: &[f64], durations: &[f64], total: f64, count: usize) -> f64 {
    let mut sums = [0.0; COSINES.1];
    let mut before = 0.0;
    for (x, d) in off.iter().zip(durations) {
        let first = libm::cos(std::f64::consts::PI * (before + 0.5 * d) / total);
        before += d;
        // cos((j + 1) a) = 2 cos(a) cos(j a) - cos((j - 1) a)
        let (mut last, mut now) = (1.0, first);
        for sum in &mut sums[..count] {
            *sum += x * now;
            (last, now) = (now, 2.0 * first * now - last);
        }
    }
    sums[..count].iter().map(|c| c * c).sum()
}

/// The mean over these durations, summed as differences to `origin`: exact for constants, accurate for small changes on a large value.
pub(crate) fn mean(samples: &[f64], durations: &[f64], origin: f64) -> f64 {
    let sum: f64 = samples.iter().zip(durations).map(|(x, d)| (x - origin) * d).sum();
    origin + sum / durations.iter().sum::<f64>()
}
