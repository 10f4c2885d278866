//! Sums of lagged products of a series.

pub use motiform_analysis::lagged_sums;

use crate::{Result, Series};

impl Series {
    /// Its lagged sums, and the number of pairs of defined samples at each lag.
    pub(crate) fn lagged(&self, longest: usize) -> Result<(Vec<f64>, Vec<f64>)> {
        let samples = self.components.first().map_or(0, Vec::len);
        let pairs = match &self.defined {
            None => (0..=longest).map(|lag| samples.saturating_sub(lag) as f64).collect(),
            Some(defined) => {
                let mask = defined.iter().map(|&there| f64::from(u8::from(there))).collect();
                lagged_sums(&[mask], longest)?.into_iter().map(f64::round).collect()
            }
        };
        Ok((lagged_sums(&self.components, longest)?, pairs))
    }

    /// The same of pairs that begin in a range, by direct sums.
    pub(crate) fn lagged_from(&self, range: std::ops::Range<usize>, longest: usize) -> (Vec<f64>, Vec<f64>) {
        let samples = self.components.first().map_or(0, Vec::len);
        let there = |at: usize| self.defined.as_ref().is_none_or(|defined| defined[at]);
        let at_lag = |lag: usize| {
            let (mut sum, mut count) = (0.0, 0.0);
            for at in range.clone().take_while(|at| at + lag < samples) {
                if there(at) && there(at + lag) {
                    sum += self.components.iter().map(|x| x[at] * x[at + lag]).sum::<f64>();
                    count += 1.0;
                }
            }
            (sum, count)
        };
        (0..=longest).map(at_lag).unzip()
    }
}
