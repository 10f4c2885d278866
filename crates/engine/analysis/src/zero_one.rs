//! The 0-1 test for chaos.

use crate::{Error, Result, checks};
use motiform_dynamics::Normal;
use motiform_dynamics::sample::ascending;
use std::f64::consts::PI;

/// Number of frequencies c.
const FREQUENCIES: usize = 100;

/// Below this the largest lag (a tenth) is too short for a correlation.
const LEAST: usize = 200;

/// Outcome of the 0-1 test: K near 0 is regular, near 1 chaotic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ZeroOne {
    /// K, the median of K_c over the frequencies c.
    pub k: f64,
    /// A quarter of the K_c lie below.
    pub lower: f64,
    /// A quarter of the K_c lie above.
    pub upper: f64,
}

/// The 0-1 test for chaos, by the correlation method with the oscillatory term subtracted.
///
/// p(n) = sum_{j=1}^n x_j cos(jc), q(n) = sum_{j=1}^n x_j sin(jc)
/// M(n) = mean over j of (p(j+n) - p(j))^2 + (q(j+n) - q(j))^2, j = 1 ..= N - N/10; n = 1 ..= N/10
/// D(n) = M(n) - m^2 (1 - cos(nc))/(1 - cos c),   m the mean of x
/// K_c = corr(n, D(n)),   K = median of K_c over 100 values of c drawn from (pi/5, 4 pi/5)
///
/// (p, q) stays bounded for regular motion (K = 0) and walks at random for chaotic motion (K = 1). Values between mean
/// that the series is too short, sampled too finely, or weakly chaotic; `lower` and `upper` say how far the K_c agree.
///
/// Sampling: give one value per return to a section (or per period of the forcing). A finely sampled flow shows K = 0
/// even where it is chaotic, as neighbouring samples are nearly equal.
///
/// Source: Gottwald and Melbourne (2009), SIAM J. Appl. Dyn. Syst. 8, 129; (2004), Proc. R. Soc. A
/// 460, 603. c from ChaCha8 (key = seed): the same on every machine. Costs 10 N^2 additions.
///
/// # Errors    [`Error::TooFew`] below 200 samples, [`Error::Constant`], [`Error::NotFinite`], [`Error::Overflow`]
/// # Not       for noisy series: noise walks at random like chaos
/// # Checked by  tests/all/zero_one.rs: logistic map, quasi-periodic and periodic series, an added constant
pub fn zero_one(samples: &[f64], seed: u64) -> Result<ZeroOne> {
    checks::at_least("the 0-1 test, in samples,", LEAST, samples.len())?;
    checks::finite(samples)?;
    if samples.iter().all(|x| *x == samples[0]) {
        return Err(Error::Constant { value: samples[0] });
    }
    let mut growth = Vec::with_capacity(FREQUENCIES);
    for c in frequencies(seed) {
        let k = correlation(&displacements(samples, c));
        growth.push(k.ok_or_else(|| checks::overflow(samples))?);
    }
    ascending(&mut growth);
    let middle = |at: usize| 0.5 * (growth[at - 1] + growth[at]);
    Ok(ZeroOne { k: middle(50), lower: middle(25), upper: middle(75) })
}

/// The values of c, uniform in (pi/5, 4 pi/5): resonances with slow parts of the series lie outside.
fn frequencies(seed: u64) -> impl Iterator<Item = f64> {
    let mut random = Normal::new(seed, 0);
    std::iter::repeat_with(move || random.uniform()).take(FREQUENCIES).map(|x| PI * (0.2 + 0.6 * x))
}

/// D(n) for n = 1 ..= N/10.
fn displacements(samples: &[f64], c: f64) -> Vec<f64> {
    let walk = walk(samples, c);
    let longest = samples.len() / 10;
    let mean = samples.iter().sum::<f64>() / samples.len() as f64;
    let oscillation = mean * mean / (1.0 - libm::cos(c));
    let from = &walk[..samples.len() - longest];
    let square = |lag: usize| -> f64 {
        let pairs = from.iter().zip(&walk[lag..]);
        pairs.map(|(a, b)| (b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1])).sum()
    };
    let spread = |lag: usize| square(lag) / from.len() as f64;
    (1..=longest).map(|n| spread(n) - oscillation * (1.0 - libm::cos(n as f64 * c))).collect()
}

/// (p(n), q(n)) for n = 1 ..= N.
fn walk(samples: &[f64], c: f64) -> Vec<[f64; 2]> {
    let mut place = [0.0; 2];
    let step = |(j, x): (usize, &f64)| {
        let (sin, cos) = libm::sincos((j + 1) as f64 * c);
        place = [place[0] + x * cos, place[1] + x * sin];
        place
    };
    samples.iter().enumerate().map(step).collect()
}

/// corr(n, D(n)); 0 where D does not change at all (it does not grow). `None` if the squares overflow.
fn correlation(values: &[f64]) -> Option<f64> {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let middle = 0.5 * (count - 1.0);
    let (mut along, mut square, mut lags) = (0.0, 0.0, 0.0);
    for (n, value) in values.iter().enumerate() {
        let (x, y) = (n as f64 - middle, value - mean);
        along += x * y;
        square += y * y;
        lags += x * x;
    }
    let scale = (lags * square).sqrt();
    let k = if scale == 0.0 { 0.0 } else { along / scale };
    (square.is_finite() && k.is_finite()).then_some(k)
}
