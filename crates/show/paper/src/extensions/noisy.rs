//! A straight swimmer with noise: its heading diffuses.

use super::with;
use crate::claims::check;
use crate::context::Context;
use motiform_analysis::symmetry::wrap;
use motiform_figures::report::Claim;
use motiform_study::Error;

/// Amplitude of the noise: small, so that the speed hardly changes.
const NOISE: f64 = 0.05;

/// `<(heading(t + T) - heading(t))^2> = noise^2 T / gamma`, for a speed of sqrt(gamma).
pub(super) fn claims(context: &Context<'_>) -> Result<Vec<Claim>, Error> {
    let gamma = 1.0;
    let mut study = with(context, "noisy-heading", &[("gamma", gamma)])?;
    study.set_initial("v1", 1.0)?;
    (study.run.noise_velocity, study.run.t_end, study.run.dt_out) =
        (Some(NOISE), context.choose(20_000.0, 5_000.0), 1.0);
    study.run.transient = 0.0; // it starts as it moves
    let dataset = context.simulate(&study)?;
    let column = |name: &str| dataset.trajectory.get(name).unwrap_or(&[]);
    let headings: Vec<f64> =
        column("v1").iter().zip(column("v2")).map(|(x, y)| libm::atan2(*y, *x)).collect();
    let squares: Vec<f64> =
        headings.windows(2).map(|pair| wrap(pair[1] - pair[0])).map(|turn| turn * turn).collect();
    let count = squares.len() as f64;
    let mean = squares.iter().sum::<f64>() / count;
    // increments of a Brownian motion are independent: the variance of a variance
    let error = mean * libm::sqrt(2.0 / count);
    let expected = NOISE * NOISE / gamma;
    let says = "Under noise on the velocity the heading diffuses at the rate *η*^2/2*γ*.";
    let finds = format!(
        "mean square of the turn in a time of 1: {mean:.4e} ± {error:.1e}; expected 2 · *η*^2/2*γ* = \
        {expected:.4e}, and a part of *η*^2/*γ* more, which is left out"
    );
    let how = "*η* = 0.05, *γ* = 1, one long run; within 3 standard errors and *η*^2/*γ* of the value";
    let close = (mean - expected).abs() < 3.0 * error + expected * expected;
    Ok(vec![check(says, finds, how, close && count > 1000.0)])
}
