//! The length of a lag window.

use crate::jackknife::jackknife;
use crate::lag_window::{Integral, integral, size};
use crate::{Measured, in_unit};

/// The shortest window is so many times the integral of |rho|: half of it is 5 decay times of an exponential, 3 of a damped cosine.
const LENGTH: f64 = 10.0;

/// Ratio of the lengths that are tried.
const RATIO: f64 = std::f64::consts::SQRT_2;

/// Half widths of 95 % intervals by which a longer window may differ.
const ALIKE: f64 = 1.5;

/// Mean correlation over the longest lags from which on a quantity is not forgotten within them.
const KEPT: f64 = 0.05;

/// A correlation repeats itself where it is below the first over the first half of the lags, and above the second over the other one.
const LOST: f64 = 0.5;
const REPEATED: f64 = 0.999;

/// A window that is long enough.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Window {
    /// In samples.
    pub(crate) length: usize,
    /// The logarithm of how many times longer the memory could be until it is not reached within the lags: beyond, there is no window.
    pub(crate) room: f64,
}

/// Sampled correlations C(k dt): of all groups, and without each of them.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Curves {
    /// Time between lags.
    pub(crate) dt: f64,
    /// The unit of times in sentences.
    pub(crate) unit: String,
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

    /// The integral of |C| of all groups: what the integral would be without cancellation.
    pub(crate) fn size(&self, length: usize) -> f64 {
        size(&self.values[0], length, self.dt)
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

    /// The mean correlation over the second half of the lags, where it is one: what does not oscillate and is not forgotten.
    pub(crate) fn kept(&self) -> Option<f64> {
        let last = self.longest();
        let mean = |curve: &Vec<f64>| {
            let part = &curve[last / 2..=last];
            part.iter().sum::<f64>() / part.len() as f64 / curve[0]
        };
        let means: Vec<f64> = self.values.iter().map(mean).collect();
        let found = jackknife(means[0], &means[1..]);
        (found.value > KEPT && found.lower() > 0.0).then_some(found.value)
    }

    /// The window: the shortest one from [`Curves::least`] and `memory` on whose integral agrees with those of all longer ones.
    ///
    /// Its length follows the decay of |rho|, which is known well, and not the noise of the integral. A slow
    /// part of small size, which hardly adds to |rho|, shows as a change of the integral with the length of
    /// the window: then the window becomes longer until nothing changes beyond 1.5 half widths.
    ///
    /// Source: Sokal (1997), in Functional Integration, NATO ASI 361 (self-consistent window); Lepski (1991),
    /// Theory Probab. Appl. 35, 454 (comparison with all longer ones).
    pub(crate) fn window(&self, memory: usize) -> Result<Window, String> {
        let longest = self.longest();
        let forgotten = self.least().ok_or_else(|| self.not_reached())?;
        let room = libm::log(longest as f64 / forgotten as f64);
        let least = forgotten.max(memory).min(longest);
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
            return Err(self.not_reached());
        }
        Ok(Window { length: lengths[place], room })
    }

    /// The reason why there is no window. What comes back to its start repeats itself: no length of the record is enough.
    fn not_reached(&self) -> String {
        let lag = self.longest();
        let longest = in_unit(lag as f64 * self.dt, &self.unit);
        let rho = |lag: usize| self.values[0][lag] / self.values[0][0];
        let lost = (0..=lag / 2).any(|lag| rho(lag) < LOST);
        if lost && (lag / 2..=lag).any(|lag| rho(lag) > REPEATED) {
            return format!(
                "not reached: the motion repeats itself, its correlation is as large up to the longest lag {longest} as at the start, \
                 and no longer record changes that"
            );
        }
        format!(
            "not reached: the integral of the correlation still changes at the longest lag {longest}; record longer"
        )
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
