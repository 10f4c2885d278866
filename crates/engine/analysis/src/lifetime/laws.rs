//! The two laws of mean lives, fitted to counts of events.

use super::LifeCount;
use crate::Estimate;
use motiform_dynamics::distributions::{NORMAL_95, chi_square_tail};
use serde::Serialize;

/// 95 % quantile of chi-square with one degree of freedom.
const PROFILE: f64 = 3.841_458_820_694_124;

/// Places of the crisis that are tried on each side before the best one is refined.
const PLACES: usize = 240;

/// The nearest place that is tried, relative to the range of the parameter.
const NEAREST: f64 = 1e-4;

/// The goodness of fit of a law to the counts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Goodness {
    /// Twice the log-likelihood that is lacking to a law through all points.
    pub deviance: f64,
    /// Free parameters of the law.
    pub parameters: usize,
    /// Values of the parameter that it is fitted to.
    pub values: usize,
}

impl Goodness {
    /// Akaike's criterion, up to a constant that all laws share: `deviance + 2 parameters`.
    pub fn aic(&self) -> f64 {
        self.deviance + 2.0 * self.parameters as f64
    }

    /// The probability of a deviance of this size or more if the law holds (chi-square; for at least a few events per value). 1 without
    /// degrees of freedom.
    pub fn probability(&self) -> f64 {
        chi_square_tail(self.deviance, self.values.saturating_sub(self.parameters) as f64)
    }
}

/// tau(p) = life exp(-k (p - at)): no crisis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ExponentialLife {
    /// k, inverse unit of the parameter: above 0 if lives shorten as the parameter grows; 95 % error.
    pub k: Estimate,
    /// The value at which `life` is independent of k.
    pub at: f64,
    /// Mean life there (model time), 95 % error.
    pub life: Estimate,
    /// The goodness of the fit.
    pub goodness: Goodness,
}

/// The value of the parameter at which a crisis makes the chaos transient.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Critical {
    /// The most likely value.
    pub value: f64,
    /// Lower end of its 95 % profile interval; `None` where the data set no limit within the range that was searched.
    pub lower: Option<f64>,
    /// Upper end.
    pub upper: Option<f64>,
    /// `true` if the most likely value is the last one that was searched: the data do not place the crisis, and the exponent is that of
    /// this place alone.
    pub at_end: bool,
}

/// tau(p) = coefficient |p - critical|^-exponent on one side of a crisis, for ever on the other.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PowerLawLife {
    /// The place of the crisis.
    pub critical: Critical,
    /// `true` if chaos is transient above the crisis, `false` if below.
    pub above: bool,
    /// The critical exponent gamma, with its 95 % error (that of the crisis' place included).
    pub exponent: Estimate,
    /// C: model time times the parameter's unit to the power gamma.
    pub coefficient: f64,
    /// The goodness of the fit.
    pub goodness: Goodness,
}

impl ExponentialLife {
    /// The most likely law; it needs events at two values at least.
    pub(super) fn fit(counts: &[LifeCount]) -> Self {
        let tilt = Tilt::fit(counts, |p| p, f64::NEG_INFINITY);
        let spread = 1.0 / tilt.events.sqrt();
        let life = libm::exp(-tilt.log_rate - tilt.slope * tilt.mean);
        let k = Estimate { value: tilt.slope, error: NORMAL_95 * spread / tilt.variance.sqrt() };
        let mut law = Self {
            k,
            at: tilt.mean,
            life: Estimate { value: life, error: NORMAL_95 * spread * life },
            goodness: Goodness { deviance: 0.0, parameters: 2, values: counts.len() },
        };
        law.goodness.deviance = deviance(counts, |p| law.life(p));
        law
    }

    /// Mean life (model time) at a value of the parameter.
    pub fn life(&self, parameter: f64) -> f64 {
        self.life.value * libm::exp(-self.k.value * (parameter - self.at))
    }
}

impl PowerLawLife {
    /// The most likely law whose crisis lies within the range of the values, or beyond it by its length at most: a crisis further
    /// away cannot be told from none. It needs events at two values at least.
    pub(super) fn fit(counts: &[LifeCount]) -> Self {
        let (above, below) = (Side::new(counts, true).fit(counts), Side::new(counts, false).fit(counts));
        if below.goodness.deviance < above.goodness.deviance { below } else { above }
    }

    /// Mean life (model time) at a value of the parameter; infinite beyond the crisis.
    pub fn life(&self, parameter: f64) -> f64 {
        let distance = (parameter - self.critical.value) * if self.above { 1.0 } else { -1.0 };
        if distance <= 0.0 {
            return f64::INFINITY;
        }
        self.coefficient * libm::pow(distance, -self.exponent.value)
    }

    fn at(counts: &[LifeCount], critical: f64, above: bool) -> Self {
        let sign = if above { 1.0 } else { -1.0 };
        let near = |p: f64| sign * (p - critical);
        let transient: Vec<LifeCount> = counts.iter().copied().filter(|c| near(c.parameter) > 0.0).collect();
        let tilt = Tilt::fit(&transient, |p| libm::log(near(p)), 0.0);
        let mut law = Self {
            critical: Critical { value: critical, lower: None, upper: None, at_end: false },
            above,
            exponent: Estimate { value: tilt.slope, error: f64::INFINITY },
            coefficient: libm::exp(-tilt.log_rate),
            goodness: Goodness { deviance: 0.0, parameters: 3, values: counts.len() },
        };
        law.goodness.deviance = deviance(counts, |p| law.life(p));
        law
    }

    /// The 95 % error of the exponent from the expected information of (ln C, gamma, critical).
    fn error(&self, counts: &[LifeCount]) -> f64 {
        let row = |count: &LifeCount| {
            let distance = (count.parameter - self.critical.value).abs();
            let weight = count.watched / self.life(count.parameter);
            (weight, libm::log(distance), self.exponent.value / distance)
        };
        let rows: Vec<_> = counts.iter().map(row).filter(|row| row.0 > 0.0).collect();
        let total: f64 = rows.iter().map(|row| row.0).sum();
        let mean = |of: fn(&(f64, f64, f64)) -> f64| rows.iter().map(|r| r.0 * of(r)).sum::<f64>() / total;
        let (x, y) = (mean(|r| r.1), mean(|r| r.2));
        let sum = |of: &dyn Fn(f64, f64) -> f64| rows.iter().map(|r| r.0 * of(r.1 - x, r.2 - y)).sum::<f64>();
        let (xx, xy, yy) = (sum(&|x, _| x * x), sum(&|x, y| x * y), sum(&|_, y| y * y));
        let variance = yy / (xx * yy - xy * xy);
        if variance > 0.0 { NORMAL_95 * variance.sqrt() } else { f64::INFINITY }
    }
}

/// The places of a crisis with the transient side above or below it: distances from the first value with events.
struct Side {
    above: bool,
    edge: f64,
    nearest: f64,
    furthest: f64,
}

impl Side {
    fn new(counts: &[LifeCount], above: bool) -> Self {
        let sign = if above { 1.0 } else { -1.0 };
        let least = |values: &mut dyn Iterator<Item = f64>| {
            sign * values.map(|p| sign * p).fold(f64::INFINITY, f64::min)
        };
        let edge = least(&mut counts.iter().filter(|c| c.events > 0).map(|c| c.parameter));
        let first = least(&mut counts.iter().map(|c| c.parameter));
        let span = spread(counts);
        Self { above, edge, nearest: NEAREST * span, furthest: span + (edge - first).abs() }
    }

    /// The law for a crisis at the distance `e^log` from the edge.
    fn law(&self, counts: &[LifeCount], log: f64) -> PowerLawLife {
        let distance = libm::exp(log);
        PowerLawLife::at(
            counts,
            if self.above { self.edge - distance } else { self.edge + distance },
            self.above,
        )
    }

    fn fit(&self, counts: &[LifeCount]) -> PowerLawLife {
        let (from, to) = (libm::log(self.nearest), libm::log(self.furthest));
        let step = (to - from) / PLACES as f64;
        let place = |i: usize| from + i as f64 * step;
        let deviance = |log: f64| self.law(counts, log).goodness.deviance;
        let tried: Vec<f64> = (0..=PLACES).map(|i| deviance(place(i))).collect();
        let best = (0..=PLACES).min_by(|&a, &b| tried[a].total_cmp(&tried[b])).unwrap_or(0);
        let log = least(deviance, place(best.saturating_sub(1)), place((best + 1).min(PLACES)));
        let mut law = self.law(counts, if deviance(log) < tried[best] { log } else { place(best) });
        law.critical.at_end = best == PLACES && deviance(log) >= tried[best];
        law.exponent.error = if law.critical.at_end { f64::INFINITY } else { law.error(counts) };
        let limit = law.goodness.deviance + PROFILE;
        let outside = |log: f64| deviance(log) > limit;
        let near =
            (0..best).rev().find(|&i| tried[i] > limit).map(|i| change(outside, place(i), place(best)));
        let far =
            (best + 1..=PLACES).find(|&i| tried[i] > limit).map(|i| change(outside, place(i), place(best)));
        let value = |log: f64| self.law(counts, log).critical.value;
        let (near, far) = (Some(near.map_or(self.edge, value)), far.map(value));
        (law.critical.lower, law.critical.upper) = if self.above { (far, near) } else { (near, far) };
        law
    }
}

/// The length of the range of the values.
pub(super) fn spread(counts: &[LifeCount]) -> f64 {
    let (low, high) = counts.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), count| {
        (low.min(count.parameter), high.max(count.parameter))
    });
    high - low
}

/// `2 sum d ln(d / mu) - (d - mu)` with the expected counts `mu = watched / life(p)`.
fn deviance(counts: &[LifeCount], life: impl Fn(f64) -> f64) -> f64 {
    let one = |count: &LifeCount| {
        let (d, mu) = (count.events as f64, count.watched / life(count.parameter));
        let log = if count.events == 0 { 0.0 } else { d * libm::log(d / mu) };
        2.0 * (log - (d - mu))
    };
    counts.iter().map(one).sum()
}

/// The most likely rates `exp(log_rate + slope x)` of Poisson counts, `slope` at least `least`.
struct Tilt {
    slope: f64,
    log_rate: f64,
    events: f64,
    /// Mean and variance of x over the expected counts.
    mean: f64,
    variance: f64,
}

impl Tilt {
    /// The slope solves `mean of x over expected counts = mean over events`, whose left side grows with it.
    fn fit(counts: &[LifeCount], x: impl Fn(f64) -> f64, least: f64) -> Self {
        let entries: Vec<(f64, f64)> =
            counts.iter().map(|c| (x(c.parameter), libm::log(c.watched))).collect();
        let events: f64 = counts.iter().map(|c| c.events as f64).sum();
        let target = counts.iter().zip(&entries).map(|(c, e)| c.events as f64 * e.0).sum::<f64>() / events;
        let low = entries.iter().map(|e| e.0).fold(f64::INFINITY, f64::min);
        let width = entries.iter().map(|e| e.0 - low).fold(f64::MIN_POSITIVE, f64::max);
        let beyond = |slope: f64| moments(&entries, slope).1 > target;
        let slope = if least.is_finite() && beyond(least) { least } else { root(beyond, 1.0 / width) };
        let (log_sum, mean, variance) = moments(&entries, slope);
        Self { slope, log_rate: libm::log(events) - log_sum, events, mean, variance }
    }
}

/// ln of the sum of `watched e^(slope x)`, and mean and variance of x with these weights.
fn moments(entries: &[(f64, f64)], slope: f64) -> (f64, f64, f64) {
    let logs: Vec<f64> = entries.iter().map(|(x, log)| log + slope * x).collect();
    let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let weights: Vec<f64> = logs.iter().map(|log| libm::exp(log - most)).collect();
    let total: f64 = weights.iter().sum();
    let mean = weights.iter().zip(entries).map(|(w, e)| w * e.0).sum::<f64>() / total;
    let squares = weights.iter().zip(entries).map(|(w, e)| w * (e.0 - mean) * (e.0 - mean)).sum::<f64>();
    (most + libm::log(total), mean, squares / total)
}

/// The place where `beyond` becomes true: between bounds that double from `unit` on.
fn root(beyond: impl Fn(f64) -> bool, unit: f64) -> f64 {
    let (mut low, mut high) = (-unit, unit);
    for _ in 0..40 {
        match (beyond(low), beyond(high)) {
            (true, _) => low *= 2.0,
            (_, false) => high *= 2.0,
            _ => break,
        }
    }
    change(|slope| !beyond(slope), low, high)
}

/// The end of a condition that holds at `yes` and not at `no`, by bisection.
fn change(holds: impl Fn(f64) -> bool, mut yes: f64, mut no: f64) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (yes + no);
        *(if holds(middle) { &mut yes } else { &mut no }) = middle;
    }
    0.5 * (yes + no)
}

/// The least value of a function with one minimum in a range, by golden sections.
fn least(value: impl Fn(f64) -> f64, mut from: f64, mut to: f64) -> f64 {
    let part = 0.5 * (3.0 - 5.0_f64.sqrt());
    for _ in 0..60 {
        let (left, right) = (from + part * (to - from), to - part * (to - from));
        if value(left) < value(right) { to = right } else { from = left }
    }
    0.5 * (from + to)
}
