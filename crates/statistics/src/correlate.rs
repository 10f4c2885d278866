//! Sums of lagged products by fast Fourier transforms.

use crate::{Result, Series};
use realfft::RealFftPlanner;

/// sum_t a(t) . a(t + k) for k = 0 .. `longest`, the scalar product over the components; 0 beyond the series.
///
/// The series is padded with zeros, so that nothing is periodic; error about 1e-16 sum a^2.
///
/// # Errors   none for finite series
/// # Checked by  tests/all/correlation.rs: direct sums
pub fn lagged_sums(components: &[Vec<f64>], longest: usize) -> Result<Vec<f64>> {
    let samples = components.first().map_or(0, Vec::len);
    let size = (samples + longest + 1).next_power_of_two();
    let mut planner = RealFftPlanner::new();
    let (forward, inverse) = (planner.plan_fft_forward(size), planner.plan_fft_inverse(size));
    let (mut input, mut total) = (forward.make_input_vec(), forward.make_output_vec());
    let mut output = forward.make_output_vec();
    for component in components {
        input.fill(0.0);
        input[..samples].copy_from_slice(component);
        forward.process(&mut input, &mut output).map_err(motiform_analysis::Error::from)?;
        for (sum, z) in total.iter_mut().zip(&output) {
            sum.re += z.norm_sqr();
        }
    }
    inverse.process(&mut total, &mut input).map_err(motiform_analysis::Error::from)?;
    input.truncate(longest + 1);
    input.iter_mut().for_each(|x| *x /= size as f64);
    Ok(input)
}

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
