//! Sums of lagged products by fast Fourier transforms.
//!
//! Here, beside [`crate::welch`]: the transforms are generic, and a second crate that called them would compile all of them again.

use crate::Result;
use crate::transforms::planned;

/// sum_t a(t) . a(t + k) for k = 0 .. `longest`, the scalar product over the components; 0 beyond the series.
///
/// The series, and components that are shorter, are padded with zeros, so that nothing is periodic; error about 1e-16 sum a^2.
///
/// # Errors   none for finite series
/// # Checked by  statistics, tests/all/correlation.rs: direct sums
pub fn lagged_sums(components: &[Vec<f64>], longest: usize) -> Result<Vec<f64>> {
    let samples = components.iter().map(Vec::len).max().unwrap_or(0);
    let size = (samples + longest + 1).next_power_of_two();
    let (forward, inverse) = planned(|plans| (plans.plan_fft_forward(size), plans.plan_fft_inverse(size)));
    let (mut input, mut total) = (forward.make_input_vec(), forward.make_output_vec());
    let mut output = forward.make_output_vec();
    for component in components {
        input.fill(0.0);
        input[..component.len()].copy_from_slice(component);
        forward.process(&mut input, &mut output)?;
        for (sum, z) in total.iter_mut().zip(&output) {
            sum.re += z.norm_sqr();
        }
    }
    inverse.process(&mut total, &mut input)?;
    input.truncate(longest + 1);
    input.iter_mut().for_each(|x| *x /= size as f64);
    Ok(input)
}
