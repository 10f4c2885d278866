//! The regime of a simulated motion, from a short integration after the end of the run.

use crate::analyse;
use motiform_analysis::regime::{Regime, Verdict};
use motiform_dynamics::Outcome;
use motiform_dynamics::Watch;
use motiform_study::{Error, Manifest};

/// Maximum model time, in looks of the model: a motion that has settled is identified within the first.
const LOOKS: f64 = 2.0;

/// Classifies the motion at the end of a run within a few looks of the model. `None` if this is inconclusive; for a
/// run that did not complete, or is under noise; and if the watch stopped it. The full classification is done by
/// [`analyse::classify`].
///
/// # Errors
/// Input that only the numerics can reject.
///
/// # Checked by  tests/all/naming.rs: the presets' motions, other parameters, noise, blow-up
pub fn name(manifest: &Manifest, watch: &dyn Watch) -> Result<Option<Verdict>, Error> {
    let mut plan = manifest.plan.clone();
    let complete = matches!(*manifest.outcome, Outcome::Completed { .. });
    if !complete || plan.computation.noise.is_some() || watch.stopped() {
        return Ok(None);
    }
    for (entry, state) in plan.computation.initial.0.iter_mut().zip(&manifest.state.0) {
        entry.1 = state.1;
    }
    let budget = LOOKS * plan.info()?.look;
    let verdict = analyse::classify(&plan, budget, watch)?;
    Ok(verdict.filter(|verdict| verdict.regime != Regime::Undetermined))
}
