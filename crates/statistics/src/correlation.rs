//! Autocorrelations of velocity, heading, speed and modes of the shape, with their correlation times.

use crate::jackknife::{Sums, leave_out};
use crate::{Answer, Measured, Quantity, Result, Tracks, four_digits};

/// Most lags.
const LONGEST: usize = 1 << 14;

/// The sum for the correlation time ends at this many times the integral of the squared correlation: 8 decay times of an exponential.
const WINDOW: f64 = 16.0;

/// An autocorrelation against lag.
#[derive(Debug, Clone, PartialEq)]
pub struct Autocorrelation {
    /// The quantity.
    pub quantity: Quantity,
    /// Lags from 0 (model time).
    pub lags: Vec<f64>,
    /// rho(lag) = C(lag)/C(0), 1 at lag 0.
    pub correlation: Vec<Measured>,
    /// C(0): mean square of a vector, variance of a number.
    pub variance: Measured,
    /// Integral correlation time, the integral of rho.
    pub time: Answer,
}

/// C(tau) = <q(t) . q(t + tau)> over units and times, for numbers of the deviation from the mean over all of them; rho = C/C(0).
///
/// Correlation time: the integral of rho by the trapezoidal rule up to the shortest lag W with W >= 16 int_0^W rho^2 dt. For an exponential that is 8
/// decay times, and an oscillating rho, whose own integral may be small, is followed as long. Not reached: no such W within the lags.
///
/// Source: Sokal (1997), in Functional Integration, NATO ASI 361 (self-consistent window).
///
/// # Errors    none for samples that [`Tracks`] accepts
/// # Checked by  tests/all/correlation.rs: Ornstein-Uhlenbeck, chiral active Brownian, circle, direct sums; tests/all/coverage.rs
pub fn autocorrelation(tracks: &Tracks, quantity: &Quantity) -> Result<Autocorrelation> {
    let longest = tracks.longest_lag().min(LONGEST);
    let mean = if quantity.is_number() { mean(tracks, quantity) } else { 0.0 };
    let mut sums = vec![Sums::new(tracks.groups()); longest + 1];
    for starts in tracks.starts() {
        let mut series = quantity.of(starts.track);
        if mean != 0.0 {
            series.components.iter_mut().flatten().for_each(|x| *x -= mean);
        }
        let (products, pairs) = if starts.is_whole() {
            series.lagged(longest.min(starts.track.position.len() - 1))?
        } else {
            series.lagged_from(starts.range, longest)
        };
        for ((sums, product), pairs) in sums.iter_mut().zip(products).zip(pairs) {
            sums.add(starts.group, product, pairs);
        }
    }
    Ok(normalised(tracks, quantity, &sums))
}

/// The mean of a number over all samples.
fn mean(tracks: &Tracks, quantity: &Quantity) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for track in tracks.units() {
        for component in quantity.of(track).components {
            sum += component.iter().sum::<f64>();
            count += component.len() as f64;
        }
    }
    sum / count
}

fn normalised(tracks: &Tracks, quantity: &Quantity, sums: &[Sums]) -> Autocorrelation {
    let groups = tracks.groups();
    let variance = sums[0].measured();
    let lags: Vec<f64> = (0..sums.len()).map(|lag| lag as f64 * tracks.dt()).collect();
    let quantity = quantity.clone();
    let steady = variance.value.is_nan() || variance.value <= 1e-24 * typical(tracks, &quantity);
    if steady {
        let time = Answer::unknown("it does not vary");
        let variance = Measured { value: 0.0, interval: None };
        return Autocorrelation { quantity, lags: Vec::new(), correlation: Vec::new(), variance, time };
    }
    let without: Vec<Vec<f64>> = (0..groups).map(|group| ratios(sums, Some(group))).collect();
    let all = ratios(sums, None);
    let at = |lag: usize| leave_out(groups, |left| left.map_or(all[lag], |group| without[group][lag]), false);
    let correlation = (0..sums.len()).map(at).collect();
    let time = match window(&all) {
        Some(last) => Answer::Known(leave_out(
            groups,
            |left| tracks.dt() * integral(left.map_or(&all, |group| &without[group]), last),
            false,
        )),
        None => Answer::unknown(format!(
            "not reached: the correlation does not decay within the longest lag {}; record longer",
            four_digits(lags[lags.len() - 1])
        )),
    };
    Autocorrelation { quantity, lags, correlation, variance, time }
}

/// The mean square of a quantity: below 1e-24 of it, fluctuations are round-off.
fn typical(tracks: &Tracks, quantity: &Quantity) -> f64 {
    let squares = tracks.units().iter().map(|track| {
        let sizes = quantity.of(track).components;
        sizes.iter().flatten().map(|x| x * x).sum::<f64>() / sizes[0].len() as f64
    });
    squares.fold(0.0, f64::max)
}

/// C(lag)/C(0).
fn ratios(sums: &[Sums], left_out: Option<usize>) -> Vec<f64> {
    let first = sums[0].mean(left_out);
    sums.iter().map(|sum| sum.mean(left_out) / first).collect()
}

/// The last lag of the sum; `None` if the correlation has not decayed within the lags.
fn window(correlation: &[f64]) -> Option<usize> {
    let mut squares = 0.5;
    for (lag, rho) in correlation.iter().enumerate().skip(1) {
        squares += rho * rho;
        if lag as f64 >= WINDOW * squares {
            return Some(lag);
        }
    }
    None
}

/// Trapezoidal sum in units of the lag.
fn integral(correlation: &[f64], last: usize) -> f64 {
    correlation[1..last].iter().sum::<f64>() + 0.5 * (correlation[0] + correlation[last])
}
