//! The length of a lag window, and an integral with the bias of its window in the interval.

use crate::jackknife::jackknife;
use crate::lag_window::{Integral, integral};
use crate::{Answer, Measured, four_digits};

/// The shortest window is so many times the integral of |rho|: half of it is 5 decay times of an exponential, 3 of a damped cosine.
const LENGTH: f64 = 10.0;

/// Ratio of the lengths that are tried.
const RATIO: f64 = std::f64::consts::SQRT_2;

/// Half widths of 95 % intervals by which a longer window may differ.
const ALIKE: f64 = 1.5;

/// Its own variances that are taken from the square of a change: what chance alone gives on average.
const CHANCE: f64 = 1.0;

/// Largest part of an integral that may be the correction of the trapezoidal rule.
const CORRECTED: f64 = 0.15;

/// Largest part by which every other sample may give another integral.
const CHANGED: f64 = 0.2;

/// Half the width of an interval of a logarithm from which on a value is not resolved: a factor of e on both sides.
const UNRESOLVED: f64 = 1.0;

/// Sampled correlations C(k dt): of all groups, and without each of them.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Curves {
    /// Time between lags.
    pub(crate) dt: f64,
    /// Of all groups, then without group 0, 1, ...
    pub(crate) values: Vec<Vec<f64>>,
}

impl Curves {
    /// The longest window, in samples.
    pub(crate) fn longest(&self) -> usize {
        self.values[0].len() - 1
    }

    /// The integrals over a window, of all groups and without each.
    pub(crate) fn integrals(&self, length: usize) -> Vec<Integral> {
        self.values.iter().map(|curve| integral(curve, length, self.dt)).collect()
    }

    /// The integral of all groups.
    pub(crate) fn integral(&self, length: usize) -> Integral {
        integral(&self.values[0], length, self.dt)
    }

    /// The integrals from every other sample.
    pub(crate) fn coarser(&self, length: usize) -> Vec<Integral> {
        let every_other = |curve: &Vec<f64>| curve.iter().step_by(2).copied().collect::<Vec<f64>>();
        self.values
            .iter()
            .map(|curve| integral(&every_other(curve), length.div_ceil(2), 2.0 * self.dt))
            .collect()
    }

    /// rho with its interval at a lag.
    pub(crate) fn ratio(&self, lag: usize) -> Measured {
        let ratio = |curve: &Vec<f64>| curve[lag] / curve[0];
        let without: Vec<f64> = self.values[1..].iter().map(ratio).collect();
        jackknife(ratio(&self.values[0]), &without)
    }

    /// The shortest window W with W >= 10 int_0^W |rho|; what |rho| has by chance alone does not count.
    /// `None` if there is none within the lags.
    pub(crate) fn least(&self) -> Option<usize> {
        let mut sum = 0.5;
        for lag in 1..=self.longest() {
            let rho = self.ratio(lag);
            let error = 0.5 * rho.half_width();
            sum += (rho.value * rho.value - error * error).max(0.0).sqrt();
            if lag as f64 >= LENGTH * sum {
                return Some(lag);
            }
        }
        None
    }

    /// The window: the shortest one from [`Curves::least`] and `memory` on whose integral agrees with those of all longer ones.
    ///
    /// Its length follows the decay of |rho|, which is known well, and not the noise of the integral. A slow
    /// part of small size, which hardly adds to |rho|, shows as a change of the integral with the length of
    /// the window: then the window becomes longer until nothing changes beyond 1.5 half widths.
    ///
    /// Source: Sokal (1997), in Functional Integration, NATO ASI 361 (self-consistent window); Lepski (1991),
    /// Theory Probab. Appl. 35, 454 (comparison with all longer ones).
    pub(crate) fn window(&self, memory: usize) -> Result<usize, String> {
        let longest = self.longest();
        let not_decayed = || {
            let longest = four_digits(longest as f64 * self.dt);
            format!(
                "not reached: the integral of the correlation still changes at the longest lag {longest}; record longer"
            )
        };
        let least = self.least().ok_or_else(not_decayed)?.max(memory).min(longest);
        let lengths = lengths(least, longest);
        let values: Vec<Vec<f64>> = lengths
            .iter()
            .map(|&length| self.integrals(length).iter().map(|found| found.value).collect())
            .collect();
        let alike = |one: &[f64], other: &[f64]| {
            let change = difference(one, other);
            change.interval.is_some()
                && change.value.abs() <= ALIKE * change.half_width() + 1e-9 * one[0].abs()
        };
        let settled = |place: &usize| values[place + 1..].iter().all(|longer| alike(&values[*place], longer));
        let place = (0..lengths.len()).find(settled).unwrap_or(lengths.len() - 1);
        if place + 1 == lengths.len() && place > 0 {
            let longest = four_digits(longest as f64 * self.dt);
            return Err(format!(
                "not reached: the integral of the correlation still changes at the longest lag {longest}; record longer"
            ));
        }
        Ok(lengths[place])
    }
}

/// From the shortest to the longest, each 1.41 times the one before at most.
fn lengths(least: usize, longest: usize) -> Vec<usize> {
    let steps = (libm::log(longest as f64 / least as f64) / libm::log(RATIO)).ceil().max(0.0);
    let ratio = |k: f64| if steps > 0.0 { k / steps } else { 0.0 };
    let at = |k: usize| {
        let length = least as f64 * libm::pow(longest as f64 / least as f64, ratio(k as f64));
        length.round() as usize
    };
    (0..=steps as usize).map(at).collect()
}

/// The difference of two values, each of all groups and without each.
pub(crate) fn difference(one: &[f64], other: &[f64]) -> Measured {
    let differences: Vec<f64> = one.iter().zip(other).map(|(a, b)| a - b).collect();
    jackknife(differences[0], &differences[1..])
}

/// A positive value with what its window and its sampling leave out, each of all groups and without each.
pub(crate) struct Estimate {
    /// The values.
    pub(crate) values: Vec<f64>,
    /// The same over twice the window, or from every other sample: a change is a bias.
    pub(crate) longer: Vec<f64>,
    /// From every other sample, where the change is many times the error.
    pub(crate) coarser: Option<Vec<f64>>,
}

impl Estimate {
    /// The value with its interval, on logarithms:
    ///
    /// half^2 = jackknife^2 + t^2 max(0, c^2 - se(c)^2) + max(0, d^2 - se(d)^2),   t about 2,
    ///
    /// c the change to `longer`, d that to `coarser`, twice the sampling interval (which is 15 times the
    /// error where the correlation is smooth or has a cusp at lag 0). Unknown where a value is not above 0:
    /// then it is within its error of 0.
    pub(crate) fn answer(&self) -> Answer {
        let logarithms = |values: &[f64]| values.iter().map(|&x| libm::log(x)).collect::<Vec<f64>>();
        let values = logarithms(&self.values);
        let measured = jackknife(values[0], &values[1..]);
        if values.iter().any(|x| !x.is_finite()) || measured.half_width() > UNRESOLVED {
            let bound = jackknife(self.values[0], &self.values[1..]).upper().max(0.0);
            return Answer::unknown(format!(
                "not resolved: it is within its error of 0 (below {}); record longer, or more bodies",
                four_digits(bound)
            ));
        }
        let window = beyond_chance(&values, &logarithms(&self.longer));
        let sampling =
            self.coarser.as_ref().map_or(0.0, |coarser| beyond_chance(&values, &logarithms(coarser)));
        let half = (measured.half_width().powi(2) + 4.0 * window + sampling).sqrt();
        let interval = measured.interval.map(|_| [values[0] - half, values[0] + half].map(libm::exp));
        Answer::Known(Measured { value: self.values[0], interval })
    }
}

/// The square of a change, less what it is by chance.
fn beyond_chance(one: &[f64], other: &[f64]) -> f64 {
    let change = difference(one, other);
    let square = change.value * change.value - 0.25 * CHANCE * change.half_width() * change.half_width();
    if square.is_nan() { 0.0 } else { square.max(0.0) }
}

/// The reason why samples are too coarse for an integral, if they are: the correction of the trapezoidal rule
/// for an exponential is a large part of it, so that a correlation of another form would need another one; or
/// every other sample gives another value.
pub(crate) fn too_coarse(found: &Integral, coarser: &Integral, dt: f64) -> Option<String> {
    let value = found.value.abs();
    let changed = (coarser.value - found.value).abs() > CHANGED * value;
    (found.correction > CORRECTED * value || changed).then(|| {
        let (dt, about) = (four_digits(dt), four_digits(found.value));
        format!("sampled too coarsely: intervals of {dt} do not resolve the correlation (about {about}); record more often")
    })
}
