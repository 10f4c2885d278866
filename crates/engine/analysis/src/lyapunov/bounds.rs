//! The part of the error of an exponent that the scatter of growth rates does not show.

use super::separation::{GROWN, SECULAR};
use super::{Lyapunov, durations, rates};
use crate::series_mean::mean;
use crate::{Estimate, sort_by_number};

/// After this part of a run, time grows by the factor that [`SECULAR`] is for, or less.
const EARLY: f64 = 1.0 / 6.0;

impl Lyapunov {
    /// The same exponents with errors of at least their change since half of the time averaged over; and of at least their size, where the
    /// growth or decay may be a power of time: below `e^10` over that time, or below that of its second power over the last five sixths.
    ///
    /// The scatter of rates says too little of an average that approaches its limit as `1/time`, as on a cycle with rests, or as
    /// `log(time)/time`, as in a shear: on the tori of Hamiltonian equations all exponents are 0.
    #[must_use]
    pub fn bounded(mut self) -> Self {
        bound(&mut self.exponents, &self.history, self.time);
        self
    }
}

/// Widens the errors of the averages of this history over `time`, largest first.
pub(super) fn bound(exponents: &mut [Estimate], history: &[(f64, Vec<f64>)], time: f64) {
    let durations = durations(history, history.last().map_or(0.0, |last| last.0 - time));
    let all: Vec<Vec<f64>> = (0..exponents.len()).map(|k| rates(history, k)).collect();
    let mut order: Vec<(f64, &Vec<f64>)> =
        all.iter().map(|rates| (mean(rates, &durations, rates[0]), rates)).collect();
    sort_by_number(&mut order, |a| -a.0);
    for (exponent, (_, rates)) in exponents.iter_mut().zip(order) {
        *exponent = with_unseen(*exponent, rates, &durations, GROWN);
    }
}

/// The mean of the growth rates of a vector over these durations, with the part of its error that their scatter does not show, where growth
/// below `least` may be a power of time. An error that is not known stays infinite.
pub(crate) fn with_unseen(found: Estimate, rates: &[f64], durations: &[f64], least: f64) -> Estimate {
    let time: f64 = durations.iter().sum();
    let until = |part: f64| {
        let (mut growth, mut end) = (0.0, 0.0);
        for (rate, lasted) in rates.iter().zip(durations) {
            if end + lasted > part * time * (1.0 + 1e-12) {
                break;
            }
            growth += rate * lasted;
            end += lasted;
        }
        (growth, end)
    };
    let ((all, _), (first, half), (early, _)) = (until(1.0), until(0.5), until(EARLY));
    let change = if half > 0.0 { (found.value - first / half).abs() } else { 0.0 };
    let secular = all.abs() < least || (all - early).abs() < SECULAR;
    let size = if secular { found.value.abs() } else { 0.0 };
    Estimate { error: found.error.max(change).max(size), ..found }
}

#[cfg(test)]
mod tests {
    use super::with_unseen;
    use crate::Estimate;
    use crate::lyapunov::GROWN;

    /// A vector in a shear has the length t: the average of its rate from 1 to T is log(T)/(T - 1), also where T is so large that this is
    /// growth by e^14. The error of an exponent of the same motion that does not fall with T stays as it is.
    #[test]
    fn growth_like_a_power_of_time_is_no_exponent() {
        for end in [400.0, 1e6] {
            let times: Vec<f64> = (0..=400).map(|k| libm::pow(end, f64::from(k) / 400.0)).collect();
            let durations: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
            let shear: Vec<f64> = times.windows(2).map(|t| libm::log(t[1] / t[0]) / (t[1] - t[0])).collect();
            let error = |value: f64, rates: &[f64]| {
                with_unseen(Estimate { value, error: 1e-9 }, rates, &durations, GROWN).error
            };
            let value = libm::log(end) / (end - 1.0);
            assert!(error(value, &shear) >= value, "{end}");
            let steady: Vec<f64> = times[1..].iter().map(|t| 0.05 + 1e-4 * libm::sin(7.0 * t)).collect();
            assert!(error(0.05, &steady) < 1e-3, "{end}");
        }
    }
}
