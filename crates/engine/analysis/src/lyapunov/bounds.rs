//! The part of the error of an exponent that the scatter of growth rates does not show.

use super::separation::GROWN;
use super::{Lyapunov, means};
use crate::Estimate;

impl Lyapunov {
    /// The same exponents with errors of at least their change since half of the time averaged over; and where the growth or decay over
    /// that time is below `e^10`, which may be a power of time, of at least their size.
    ///
    /// The scatter of rates says too little of an average that approaches its limit as `1/time`, as on a cycle with rests, or as
    /// `log(time)/time`, as in a shear: on the tori of Hamiltonian equations all exponents are 0.
    #[must_use]
    pub fn bounded(mut self) -> Self {
        bound(&mut self.exponents, &self.history, self.transient);
        self
    }
}

/// Widens the errors of the averages of this history, which begins at `start`.
pub(super) fn bound(exponents: &mut [Estimate], history: &[(f64, Vec<f64>)], start: f64) {
    let Some(time) = history.last().map(|last| last.0 - start) else { return };
    let half = history.partition_point(|entry| entry.0 - start <= 0.5 * time);
    let then = means(&history[..half], start, 0.0, f64::INFINITY).unwrap_or_default();
    for (now, then) in exponents.iter_mut().zip(then) {
        now.error = now.error.max((now.value - then.value).abs()); // an error that is not known stays infinite
        if now.value.abs() * time < GROWN {
            now.error = now.error.max(now.value.abs());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::bound;
    use crate::Estimate;

    /// A length that grows in proportion to the time t has the rate 1/t; the average from 1 to T is log(T)/(T - 1). The error of an
    /// exponent of the same motion that does not fall with T stays as it is.
    #[test]
    fn growth_like_a_power_of_time_is_no_exponent() {
        let rates = |t: f64| vec![0.05 + 1e-4 * libm::sin(7.0 * t), 1.0 / t];
        let history: Vec<(f64, Vec<f64>)> = (2..=400).map(f64::from).map(|t| (t, rates(t - 0.5))).collect();
        let mut found = vec![
            Estimate { value: 0.05, error: 1e-5 },
            Estimate { value: libm::log(400.0) / 399.0, error: 1e-4 },
        ];
        bound(&mut found, &history, 1.0);
        assert!(found[0].error < 1e-3, "{found:?}");
        assert!(found[1].error >= found[1].value, "{found:?}");
    }
}
