//! A curve among simulated ones: a rank test over all its points together.

use motiform_dynamics::sample::{ascending, quantile};
use serde::{Deserialize, Serialize};

/// A statistic differs below the first p-value, is doubtful below the second.
const LEVELS: [f64; 2] = [0.01, 0.05];
/// Share of the simulated curves within the band, point by point.
const BAND: f64 = 0.95;

motiform_dynamics::named! {
    /// `true` if the observed cell could be one of the simulated ones, by one statistic.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "lowercase")]
    pub enum Agreement by name {
        /// p above 0.05.
        Agrees = "agrees",
        /// p from 0.01 to 0.05.
        Doubtful = "doubtful",
        /// p up to 0.01.
        Differs = "differs",
    }
}

/// Where a curve lies among simulated ones.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Envelope {
    /// The verdict.
    pub agreement: Agreement,
    /// The probability of a curve at least as far off, if the cell is one of the simulated ones.
    pub p_value: f64,
    /// Place of the point that is farthest off, and how far: in standard deviations of the simulated curves, positive where the cell has
    /// more.
    pub worst: (usize, f64),
    /// Median of the simulated curves, point by point.
    pub median: Vec<f64>,
    /// The band of 95 % of them.
    pub low: Vec<f64>,
    /// See `low`.
    pub high: Vec<f64>,
}

impl Envelope {
    /// Compares a curve with simulated ones:
    ///
    /// `u = max_k |T(k) - m(k)|/s(k)`,   `p = (1 + #{simulated with u at least that of the curve})/(n + 1)`
    ///
    /// with mean m and standard deviation s over all n + 1 curves: under the null hypothesis they are exchangeable, so `P(p <= a) <= a`
    /// exactly, for all points together. Points where all curves agree to round-off, or that are not finite in some curve, do not count;
    /// `None` if none is left.
    ///
    /// Source: Myllymaki et al. (2017), J. R. Stat. Soc. B 79, 381 (studentised maximum absolute difference); Barnard (1963), J. R. Stat.
    /// Soc. B 25, 294.
    ///
    /// # Checked by  tests/all/prediction.rs; the tests below: p-values of exchangeable curves
    pub fn of(own: &[f64], others: &[&[f64]]) -> Option<Self> {
        let count = others.len() as f64 + 1.0;
        let all = || others.iter().copied().chain([own]);
        let mut off = vec![0.0_f64; others.len() + 1];
        let mut worst: Option<(usize, f64)> = None;
        for k in 0..own.len() {
            if all().any(|curve| !curve[k].is_finite()) {
                continue;
            }
            let mean = all().map(|curve| curve[k]).sum::<f64>() / count;
            let square = all().map(|curve| (curve[k] - mean) * (curve[k] - mean)).sum::<f64>() / count;
            let spread = square.sqrt();
            if spread <= 1e-12 * mean.abs() || spread == 0.0 {
                continue;
            }
            for (off, curve) in off.iter_mut().zip(all()) {
                *off = off.max((curve[k] - mean).abs() / spread);
            }
            let here = (own[k] - mean) / spread;
            if worst.is_none_or(|(_, most)| here.abs() > most.abs()) {
                worst = Some((k, here));
            }
        }
        let worst = worst?;
        let own_off = off.pop()?;
        let p_value = (1.0 + off.iter().filter(|u| **u >= own_off).count() as f64) / count;
        let agreement = match p_value {
            p if p <= LEVELS[0] => Agreement::Differs,
            p if p <= LEVELS[1] => Agreement::Doubtful,
            _ => Agreement::Agrees,
        };
        let [low, median, high] =
            [0.5 - 0.5 * BAND, 0.5, 0.5 + 0.5 * BAND].map(|q| quantiles(others, own.len(), q));
        Some(Self { agreement, p_value, worst, median, low, high })
    }
}

/// A quantile of the curves, point by point.
fn quantiles(curves: &[&[f64]], points: usize, share: f64) -> Vec<f64> {
    let at = |k: usize| {
        let mut values: Vec<f64> = curves.iter().map(|curve| curve[k]).collect();
        ascending(&mut values);
        quantile(&values, share).unwrap_or(f64::NAN)
    };
    (0..points).map(at).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test may fail")]
mod tests {
    use super::*;
    use motiform_dynamics::Normal;

    /// A random walk of 20 steps.
    fn walk(normal: &mut Normal, step: f64) -> Vec<f64> {
        (0..20)
            .scan(0.0, |at, _| {
                *at += step * normal.next();
                Some(*at)
            })
            .collect()
    }

    #[test]
    fn curves_of_one_law_are_rejected_at_the_level_of_the_test_and_others_nearly_always() {
        let mut normal = Normal::new(5, 0);
        let (mut false_alarms, mut found) = (0, 0);
        for _ in 0..400 {
            let others: Vec<Vec<f64>> = (0..99).map(|_| walk(&mut normal, 1.0)).collect();
            let others: Vec<&[f64]> = others.iter().map(Vec::as_slice).collect();
            let p = |own: &[f64]| Envelope::of(own, &others).unwrap().p_value;
            false_alarms += usize::from(p(&walk(&mut normal, 1.0)) <= 0.05);
            found += usize::from(p(&walk(&mut normal, 8.0)) <= 0.05);
        }
        // 20 +- 4.4 of 400
        assert!((7..=34).contains(&false_alarms), "{false_alarms}");
        assert!(found > 250, "{found}");
    }

    #[test]
    fn the_point_that_is_farthest_off_is_named_with_its_side() {
        let others: Vec<Vec<f64>> = (0..99).map(|k| vec![f64::from(k), 1.0, f64::from(k % 10)]).collect();
        let others: Vec<&[f64]> = others.iter().map(Vec::as_slice).collect();
        let found = Envelope::of(&[50.0, 1.0, -40.0], &others).unwrap();
        assert_eq!((found.worst.0, found.agreement), (2, Agreement::Differs));
        assert!(found.worst.1 < -4.0 && (found.p_value - 0.01).abs() < 1e-12, "{found:?}");
        assert_eq!(found.median, [49.0, 1.0, 4.0]);
        assert!(Envelope::of(&[1.0], &[&[1.0], &[1.0]]).is_none());
    }
}
