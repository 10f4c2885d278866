//! An integral with the bias of its window, of its sampling and of its lags in the interval.

use crate::jackknife::jackknife;
use crate::lag_window::Integral;
use crate::plateau::difference;
use crate::slow::Beyond;
use crate::{Answer, Measured, in_unit};

/// Its own variances that are taken from the square of a change: what chance alone gives on average.
const CHANCE: f64 = 1.0;

/// Largest part of an integral that may be the correction of the trapezoidal rule.
const CORRECTED: f64 = 0.15;

/// Largest part by which every other sample may give another integral.
const CHANGED: f64 = 0.2;

/// Half the width of an interval of a logarithm from which on a value is not resolved: a factor of e on both sides.
const UNRESOLVED: f64 = 1.0;

/// Standard errors that 95 % intervals reach to both sides, and the share beyond one of the ends.
const NORMAL: f64 = 1.959_963_984_540_054;
const TAIL: f64 = 0.025;

/// Farthest upper end in standard errors, for a value at the very limit of what is known.
const FARTHEST: f64 = 30.0;

/// A positive value with what its window and its sampling leave out, each of all groups and without each.
pub(crate) struct Estimate {
    /// The values.
    pub(crate) values: Vec<f64>,
    /// The same over twice the window, from every other sample, or over other lags: a change is a bias.
    pub(crate) others: Vec<Vec<f64>>,
    /// From every other sample, where the change is many times the error.
    pub(crate) coarser: Option<Vec<f64>>,
    /// The logarithm of how many times larger it could be until it is unknown, since the lags do not reach it; infinite where that does
    /// not depend on it.
    pub(crate) room: f64,
    /// The part that may lie beyond the window, by slower quantities of the same bodies.
    pub(crate) slow: Option<Beyond>,
}

impl Estimate {
    /// The value with its interval, on logarithms:
    ///
    /// half^2 = jackknife^2 + t^2 sum max(0, c^2 - se(c)^2) + max(0, d^2 - se(d)^2),   t about 2,
    ///
    /// and to both sides the part that may lie beyond the window ([`Beyond`]); where that is seen and larger than half, or a
    /// factor of e, the value is unknown.
    ///
    /// c the changes to `others`, d that to `coarser`, twice the sampling interval (which is 15 times the
    /// error where the correlation is smooth or has a cusp at lag 0). Unknown where a value is not above 0:
    /// then it is within its error of 0.
    ///
    /// A value is known only if it is below a limit, by the lags. Near the limit those that are known are the low ones: the upper end is
    /// that of a normal variable of which only what is below the limit is seen.
    ///
    /// Source: Johnson, Kotz, Balakrishnan (1994), Continuous Univariate Distributions 1, 13.10 (truncated normal).
    pub(crate) fn answer(&self, unit: &str) -> Answer {
        let logarithms = |values: &[f64]| values.iter().map(|&x| libm::log(x)).collect::<Vec<f64>>();
        let values = logarithms(&self.values);
        let measured = jackknife(values[0], &values[1..]);
        if values.iter().any(|x| !x.is_finite()) || measured.half_width() > UNRESOLVED {
            let changed = self.coarser.as_ref().map_or(0.0, |coarser| (coarser[0] - self.values[0]).abs());
            let bound = jackknife(self.values[0], &self.values[1..]).upper().max(0.0) + changed;
            return Answer::unknown(format!(
                "not resolved: it is 0 within its error (below {}); a longer record, or more bodies, lower that bound",
                in_unit(bound, unit)
            ));
        }
        let window: f64 = self.others.iter().map(|other| beyond_chance(&values, &logarithms(other))).sum();
        let sampling =
            self.coarser.as_ref().map_or(0.0, |coarser| beyond_chance(&values, &logarithms(coarser)));
        let within = (measured.half_width().powi(2) + 4.0 * window + sampling).sqrt();
        let slow = self.slow.as_ref().map_or(0.0, |slow| slow.part);
        match &self.slow {
            Some(slow) if slow.is_seen && slow.part > within => return Answer::unknown(slow.reason()),
            Some(slow) if slow.part > UNRESOLVED => return Answer::unknown(slow.bound()),
            _ => {}
        }
        let half = within + slow;
        let up = half * farther(self.room * NORMAL / half);
        let interval = measured.interval.map(|_| [values[0] - half, values[0] + up].map(libm::exp));
        Answer::Known(Measured { value: self.values[0], interval })
    }
}

/// Factor by which the upper end of a 95 % interval is farther than that of a normal variable, where only what is below a limit is seen,
/// so many standard errors above the value.
///
/// The mean m, in standard errors above the value, for which a part 0.025 of what is below the limit is below the value: `P(-m) =
/// 0.025 P(limit - m)`.
fn farther(limit: f64) -> f64 {
    let below = |x: f64| 0.5 * libm::erfc(-x / std::f64::consts::SQRT_2);
    let (mut low, mut high) = (NORMAL, FARTHEST);
    if limit.is_nan() || below(-low) <= TAIL * below(limit - low) * (1.0 + 1e-9) {
        return 1.0;
    }
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if below(-middle) > TAIL * below(limit - middle) { low = middle } else { high = middle }
    }
    high / NORMAL
}

/// The square of a change, less what it is by chance.
fn beyond_chance(one: &[f64], other: &[f64]) -> f64 {
    let change = difference(one, other);
    let square = change.value * change.value - 0.25 * CHANCE * change.half_width() * change.half_width();
    if square.is_nan() { 0.0 } else { square.max(0.0) }
}

/// The reason why samples are too coarse for an integral, if they are: the correction of the trapezoidal rule
/// for an exponential is a large part of it, so that a correlation of another form would need another one; or
/// every other sample gives another value. It is a part of `size`: the integral, or where positive and negative
/// parts cancel, that without cancellation.
pub(crate) fn too_coarse(
    found: &Integral,
    coarser: &Integral,
    size: f64,
    dt: f64,
    [unit, of_integral]: [&str; 2],
) -> Option<String> {
    let changed = (coarser.value - found.value).abs() > CHANGED * size;
    (found.correction > CORRECTED * size || changed).then(|| {
        let (dt, about) = (in_unit(dt, unit), in_unit(found.value, of_integral));
        format!("sampled too coarsely: samples every {dt} do not resolve the correlation (about {about}); record more often")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a normal variable that is seen below a limit alone, what is seen is below the upper end of 97.5 %.
    #[test]
    fn ends_of_what_is_seen_below_a_limit() {
        assert!((farther(f64::INFINITY) - 1.0).abs() < 1e-6 && (farther(6.0) - 1.0).abs() < 0.01);
        let below = |x: f64| 0.5 * libm::erfc(-x / std::f64::consts::SQRT_2);
        for limit in [0.3, 1.0, 2.0] {
            let mean = NORMAL * farther(limit);
            assert!((below(-mean) / below(limit - mean) - TAIL).abs() < 1e-6, "{limit}: {mean}");
        }
        assert!(farther(0.0) * NORMAL > FARTHEST - 1e-6);
    }
}
