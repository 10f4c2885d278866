//! Intervals by leaving out one group of units at a time.

use crate::Measured;
use motiform_dynamics::distributions::{student_quantile, unequal_freedom};

/// Fewest groups that give an interval.
const LEAST: usize = 8;

/// A value with the interval from what it is with each group left out.
///
/// value -+ t_{G-1} sqrt( (G-1)/G sum_g (v_g - mean v)^2 );  G groups, v_g the value without group g
///
/// No interval with fewer than 8 groups, or where one of the values is not finite.
///
/// Source: Tukey (1958), Ann. Math. Stat. 29, 614; Efron (1982), The Jackknife, the Bootstrap and Other Resampling Plans, ch. 3.
///
/// # Checked by  tests/all/coverage.rs; for a mean it is the usual standard error (tests/all/quantiles.rs)
pub fn jackknife(value: f64, without: &[f64]) -> Measured {
    Measured { value, interval: spread(without, None).map(|half| [value - half, value + half]) }
}

/// [`jackknife`] of the logarithm: for values above 0, whose interval then stays above 0.
pub(crate) fn jackknife_ratio(value: f64, without: &[f64]) -> Measured {
    ratio(value, without, None)
}

fn ratio(value: f64, without: &[f64], freedom: Option<usize>) -> Measured {
    let logarithms: Vec<f64> = without.iter().map(|&x| libm::log(x)).collect();
    let half = if value > 0.0 { spread(&logarithms, freedom) } else { None };
    Measured { value, interval: half.map(|half| [value * libm::exp(-half), value * libm::exp(half)]) }
}

/// Half the width of the interval; degrees of freedom are one less than the groups, or these.
fn spread(without: &[f64], freedom: Option<usize>) -> Option<f64> {
    let groups = without.len();
    // of unequal groups, such as blocks of one record by where windows begin, one may be empty
    let least = if freedom.is_some() { LEAST - 1 } else { LEAST };
    if groups < least || without.iter().any(|value| !value.is_finite()) {
        return None;
    }
    let half = student_quantile(freedom.unwrap_or(groups - 1)) * variance(without).sqrt();
    Some(half).filter(|half| half.is_finite())
}

/// `(G-1)/G sum_g (v_g - mean v)^2` of values without each of G groups.
fn variance(without: &[f64]) -> f64 {
    let n = without.len() as f64;
    let mean = without.iter().sum::<f64>() / n;
    (n - 1.0) / n * without.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>()
}

/// Sums over the groups of units: a mean is `sum / count`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sums {
    /// Sum and count of each group.
    groups: Vec<[f64; 2]>,
}

impl Sums {
    pub(crate) fn new(groups: usize) -> Self {
        Self { groups: vec![[0.0; 2]; groups] }
    }

    pub(crate) fn add(&mut self, group: usize, sum: f64, count: f64) {
        self.groups[group][0] += sum;
        self.groups[group][1] += count;
    }

    /// Adds a constant to every term.
    pub(crate) fn shift(&mut self, by: f64) {
        self.groups.iter_mut().for_each(|group| group[0] += by * group[1]);
    }

    /// The number of terms.
    pub(crate) fn count(&self) -> f64 {
        self.groups.iter().map(|group| group[1]).sum()
    }

    /// The mean, without group `left_out` if one is given.
    pub(crate) fn mean(&self, left_out: Option<usize>) -> f64 {
        let kept = self.groups.iter().enumerate().filter(|(number, _)| Some(*number) != left_out);
        let [sum, count] = kept.fold([0.0; 2], |[s, n], (_, group)| [s + group[0], n + group[1]]);
        sum / count
    }

    /// The number of terms of each group.
    pub(crate) fn sizes(&self) -> Vec<f64> {
        self.groups.iter().map(|group| group[1]).collect()
    }

    /// The variance of the mean, by leaving out each group that has terms.
    pub(crate) fn variance(&self) -> f64 {
        let there = (0..self.groups.len()).filter(|&group| self.groups[group][1] > 0.0);
        variance(&there.map(|group| self.mean(Some(group))).collect::<Vec<_>>())
    }

    pub(crate) fn measured(&self) -> Measured {
        leave_out(&self.sizes(), &|left_out| self.mean(left_out), false)
    }

    /// The mean with its interval, on its logarithm where it is above 0.
    pub(crate) fn skew(&self) -> Measured {
        let skew = leave_out(&self.sizes(), &|left_out| self.mean(left_out), true);
        if skew.interval.is_some() { skew } else { self.measured() }
    }
}

/// A function of sums over groups of these sizes with its interval over the groups that have terms; `positive` values on their logarithm.
/// Degrees of freedom are those of groups of unequal size ([`unequal_freedom`]).
pub(crate) fn leave_out(sizes: &[f64], value: &dyn Fn(Option<usize>) -> f64, positive: bool) -> Measured {
    let there = (0..sizes.len()).filter(|&group| sizes[group] > 0.0);
    let without: Vec<f64> = there.map(|group| value(Some(group))).collect();
    let freedom = Some(unequal_freedom(sizes.iter().copied()));
    let value = value(None);
    if positive {
        return ratio(value, &without, freedom);
    }
    let half = spread(&without, freedom);
    Measured { value, interval: half.map(|half| [value - half, value + half]) }
}
