//! Histograms with intervals that know of correlations.

use crate::jackknife::Sums;
use motiform_dynamics::distributions::wilson;
use serde::Serialize;

/// A bin of a histogram.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Bin {
    /// Lower edge.
    pub from: f64,
    /// Upper edge, which belongs to the next bin (in the last bin to this one).
    pub to: f64,
    /// Samples in it.
    pub count: usize,
    /// Probability density: share of the samples over the width.
    pub density: f64,
    /// Lower end of its 95 % interval.
    pub lower: f64,
    /// Upper end.
    pub upper: f64,
}

/// A histogram as a probability density, with the interval of each bin.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Histogram {
    /// Bins of equal width.
    pub bins: Vec<Bin>,
    /// Samples in all.
    pub samples: usize,
    /// Number of independent samples with the same information.
    pub independent: f64,
}

/// The histogram of samples, given as (group of units, value), between two edges; values outside count in the outermost bins.
///
/// Samples along a track are correlated, so the binomial (Wilson) interval of a bin's share is that for n/d
/// samples; the design effect d, at least 1, is the variance of the shares over the groups, summed over the
/// bins, over what n independent samples would have: d = sum_b var_b / sum_b p_b (1 - p_b)/n.
///
/// Source: Kish (1965), Survey Sampling, ch. 8 (design effect); Wilson (1927).
///
/// # Checked by  tests/all/distributions.rs: independent and repeated samples, a normal velocity; tests/all/coverage.rs
pub fn histogram(samples: &[(usize, f64)], groups: usize, (from, to): (f64, f64), bins: usize) -> Histogram {
    let width = (to - from) / bins as f64;
    let mut counts = vec![vec![0_usize; groups]; bins];
    let mut totals = vec![0_usize; groups];
    for &(group, value) in samples {
        let bin = (((value - from) / width).floor().max(0.0) as usize).min(bins - 1);
        counts[bin][group] += 1;
        totals[group] += 1;
    }
    let n = samples.len().max(1) as f64;
    let independent = n / design_effect(&counts, &totals, n);
    let bin = |(place, counts): (usize, &Vec<usize>)| {
        let count = counts.iter().sum::<usize>();
        let share = count as f64 / n;
        let [lower, upper] = wilson(share, independent).map(|end| end / width);
        let edge = |k: usize| from + width * k as f64;
        Bin { from: edge(place), to: edge(place + 1), count, density: share / width, lower, upper }
    };
    Histogram { bins: counts.iter().enumerate().map(bin).collect(), samples: samples.len(), independent }
}

fn design_effect(counts: &[Vec<usize>], totals: &[usize], n: f64) -> f64 {
    let groups = totals.len();
    if groups < 2 {
        return 1.0;
    }
    let (mut over_groups, mut binomial) = (0.0, 0.0);
    for counts in counts {
        let mut sums = Sums::new(groups);
        for (group, (&count, &total)) in counts.iter().zip(totals).enumerate() {
            sums.add(group, count as f64, total as f64);
        }
        let share = sums.mean(None);
        over_groups += sums.variance();
        binomial += share * (1.0 - share) / n;
    }
    if binomial > 0.0 && over_groups.is_finite() { (over_groups / binomial).max(1.0) } else { 1.0 }
}
