//! The noise of each mode of the shape, against the one amplitude that a fit has for all of them.

use crate::Fit;
use motiform_dynamics::distributions::chi_square_tail;
use serde::{Deserialize, Serialize};

/// Variances of two modes' innovations differ by at least this factor, and with this significance.
const LEAST: f64 = 1.3;
const CLEAR: f64 = 1e-4;

/// Two modes whose innovations have different variances.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct UnequalNoise {
    /// The modes: 2 for z2.
    pub modes: [usize; 2],
    /// The variance of the standardised innovations of the first over that of the second; 1 if the model is right.
    pub ratio: f64,
    /// Probability of such a ratio, or one farther from 1, where it is 1.
    pub p_value: f64,
}

/// The innovations of one mode, both parts together.
struct Mode {
    number: usize,
    variance: f64,
    /// The variance of its logarithm: `(m4/m2^2 - 1)/n`.
    error: f64,
}

impl Mode {
    fn of(fit: &Fit, number: usize) -> Self {
        let both = [2 * number - 2, 2 * number - 1];
        let frames = fit.innovations.iter().flatten();
        let all: Vec<f64> = frames.flat_map(|frame| both.map(|channel| frame[channel])).collect();
        let mean = |power: i32| all.iter().map(|x| x.powi(power)).sum::<f64>() / all.len() as f64;
        let variance = mean(2);
        Self { number, variance, error: (mean(4) / (variance * variance) - 1.0) / all.len() as f64 }
    }
}

impl UnequalNoise {
    /// The clearest pair of modes; `None` where all have the same noise within the errors.
    ///
    /// The logarithm of the ratio of variances over its standard error, heavy tails allowed for by the fourth moment, is normal.
    ///
    /// # Checked by  tests/all/warnings.rs: modes of equal and of unequal noise
    pub(super) fn of(fit: &Fit) -> Option<Self> {
        let all: Vec<Mode> = (2..=fit.observed() / 2).map(|number| Mode::of(fit, number)).collect();
        let pairs =
            all.iter().enumerate().flat_map(|(k, one)| all[k + 1..].iter().map(move |two| (one, two)));
        let compare = |(one, two): (&Mode, &Mode)| {
            let ratio = one.variance / two.variance;
            let deviation = libm::log(ratio);
            let p_value = chi_square_tail(deviation * deviation / (one.error + two.error), 1.0);
            let clear = p_value < CLEAR && deviation.abs() > libm::log(LEAST);
            clear.then_some(Self { modes: [one.number, two.number], ratio, p_value })
        };
        pairs.filter_map(compare).min_by(|a, b| a.p_value.total_cmp(&b.p_value))
    }
}
