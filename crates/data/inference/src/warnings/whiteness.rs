//! The whiteness of innovations.

use crate::Fit;
use crate::observation::NAMES;
use motiform_dynamics::distributions::chi_square_tail;
use serde::{Deserialize, Serialize};

/// Largest lag of the test.
const LAGS: usize = 10;

/// Standardised innovations of one observed number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Channel {
    /// The observed number (x, y, Re z2, ..); its innovations are what it adds to those of the numbers before
    /// it.
    pub name: String,
    /// Variance: 1 if the model is right.
    pub variance: f64,
    /// Autocorrelation at 1, 2, .. frames.
    pub autocorrelation: Vec<f64>,
    /// Probability of autocorrelations as large as these in white noise.
    ///
    /// Ljung and Box (1978), Biometrika 65, 297:  `Q = n (n + 2) sum_k rho_k^2/(n - k)`, chi-square.
    pub p_value: f64,
}

/// Autocorrelations of a fit's standardised innovations, with the test of Ljung and Box.
pub fn whiteness(fit: &Fit) -> Vec<Channel> {
    (0..fit.observed()).map(|channel| test(fit, channel)).collect()
}

fn test(fit: &Fit, channel: usize) -> Channel {
    let series: Vec<Vec<f64>> =
        fit.innovations.iter().map(|stretch| stretch.iter().map(|e| e[channel]).collect()).collect();
    let n: usize = series.iter().map(Vec::len).sum();
    let squares: f64 = series.iter().flatten().map(|e| e * e).sum();
    let (autocorrelation, p_value) = ljung_box(&series);
    Channel {
        name: NAMES[channel].to_owned(),
        variance: squares / (n as f64).max(1.0),
        autocorrelation,
        p_value,
    }
}

/// Autocorrelation at 1, 2, .. of series of mean 0, up to 10 lags and a quarter of their samples, and the
/// probability of as large ones in white noise.
pub(crate) fn ljung_box(series: &[Vec<f64>]) -> (Vec<f64>, f64) {
    let n: usize = series.iter().map(Vec::len).sum();
    let lagged = |lag: usize| -> f64 {
        let of = |s: &Vec<f64>| s.iter().zip(s.get(lag..).unwrap_or(&[])).map(|(a, b)| a * b).sum::<f64>();
        series.iter().map(of).sum()
    };
    let squares = lagged(0);
    let lags = LAGS.min(n / 4);
    let scale = if squares > 0.0 { 1.0 / squares } else { 0.0 };
    let autocorrelation: Vec<f64> = (1..=lags).map(|lag| lagged(lag) * scale).collect();
    let size = n as f64;
    let weighted = autocorrelation.iter().enumerate().map(|(k, rho)| rho * rho / (size - k as f64 - 1.0));
    let q = size * (size + 2.0) * weighted.sum::<f64>();
    (autocorrelation, chi_square_tail(q, lags as f64))
}
