//! The null hypothesis of motion: a velocity that decays, and noise that renews it.

use crate::fit::{reached, refit};
use crate::subsets::reduced;
use crate::{Fit, Result, Selection, Track};
use motiform_dynamics::Watch;
use motiform_dynamics::distributions::chi_square_tail;

/// Rate at which a persistent random walk may be given the name of a motion: rare enough for a thousand cells.
pub const WALK_RATE: f64 = 1e-4;

/// Promised gain of log-likelihood at which first steps of the walk end, and what it may gain after them: far more than in any trial.
const ENOUGH: f64 = 10.0;
const LEFT: f64 = 100.0;

/// The p-value of the selected equation of the velocity against `dz1/dt = c z1` with noise, a persistent random
/// walk, beside the same equations of the shape; 1 where it has no other term.
///
/// Likelihood ratio, chi-square with as many degrees of freedom as terms are left out. The terms were chosen
/// for their likelihood, so ratios are too large where the null hypothesis holds: hence the low
/// [`WALK_RATE`]. Where the walk is far from that after first steps already, the value is a bound from above.
///
/// # Errors    [`crate::Error::Interrupted`] where the watch stops it
/// # Checked by  `tests/all/null.rs`: random walks, and a cell that moves straight; bounds against walks at their maximum
pub fn walk_p_value(tracks: &[Track], whole: &Fit, selection: &Selection, watch: &dyn Watch) -> Result<f64> {
    let kept = selection.subsets.best().map(|set| set.kept.clone()).unwrap_or_default();
    let is_decay = |i: &usize| whole.coefficients[*i].name == "z1: z1";
    let of_shape = |i: &usize| whole.coefficients[*i].term.equation > 0;
    let decay = (0..whole.coefficients.len()).filter(is_decay);
    let null: Vec<usize> = decay.chain(kept.iter().copied().filter(of_shape)).collect();
    let more = kept.iter().filter(|i| !of_shape(i) && !is_decay(i)).count();
    if more == 0 {
        return Ok(1.0);
    }
    let Some((settings, start)) = reduced(whole, &null) else { return Ok(1.0) };
    let tail =
        |height: f64| chi_square_tail(2.0 * (selection.fit.log_likelihood - height).max(0.0), more as f64);
    let (near, height) = reached(tracks, &settings, &whole.scales, &start, ENOUGH, watch)?;
    if let Some(bound) =
        height.map(|height| tail(height + LEFT)).filter(|bound| *bound < WALK_RATE * WALK_RATE)
    {
        return Ok(bound);
    }
    Ok(tail(refit(tracks, &settings, &whole.scales, &near, watch)?.log_likelihood))
}
