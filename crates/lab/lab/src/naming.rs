//! The regime of a simulated motion, from a short integration after the end of the run.

use crate::analyse;
use motiform_analysis::regime::{Regime, Verdict};
use motiform_analysis::{Lyapunov, RelativeEquilibrium, SteadyMotion};
use motiform_dynamics::escape::norm;
use motiform_dynamics::{Model, Outcome, StopOnly, Watch};
use motiform_study::{Error, Manifest, Plan};

/// Maximum model time, in looks of the model ([`motiform_models::ModelInfo::look_at`]): a motion that has
/// settled is identified within the first.
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
    let Some(plan) = from_its_end(manifest).filter(|_| !watch.stopped()) else { return Ok(None) };
    let budget = LOOKS * plan.look()?;
    let verdict = analyse::classify(&plan, budget, &StopOnly(watch))?;
    Ok(verdict.filter(|verdict| verdict.regime != Regime::Undetermined))
}

/// The unstable steady motion that a run ended on, and its growth rate (inverse model time): only an orbit of exact symmetry stays there.
/// `None` where it ended elsewhere, did not complete, or is under noise.
///
/// # Errors
/// Input that only the numerics can reject.
pub fn unstable(manifest: &Manifest) -> Result<Option<(Regime, f64)>, Error> {
    let Some(plan) = from_its_end(manifest) else { return Ok(None) };
    let first = analyse::start(&manifest.plan)?.1;
    let (model, shape) = analyse::start(&plan)?;
    Ok(unstable_at(model.as_ref(), &shape, norm(&first)))
}

/// As [`unstable`], of a run whose exponents were computed: they are those of the steady motion, not of what a typical start does.
///
/// # Errors
/// An unknown model.
pub fn unstable_under(plan: &Plan, run: &Lyapunov) -> Result<Option<(Regime, f64)>, Error> {
    if !matches!(run.outcome, Outcome::Completed { .. }) {
        return Ok(None);
    }
    let (model, first) = analyse::start(plan)?;
    Ok(unstable_at(model.as_ref(), &run.shape, norm(&first)))
}

fn unstable_at(model: &dyn Model, shape: &[f64], size: f64) -> Option<(Regime, f64)> {
    let found = RelativeEquilibrium::reached(model, shape, size).filter(RelativeEquilibrium::is_unstable)?;
    Some((SteadyMotion::of(model, &found).regime(), found.growth()))
}

/// The plan of a run with its end as the start; `None` for a run that did not complete, or is under noise.
fn from_its_end(manifest: &Manifest) -> Option<Plan> {
    let complete = matches!(manifest.outcome.outcome, Outcome::Completed { .. });
    let mut plan = manifest.plan.clone();
    for (entry, state) in plan.computation.initial.0.iter_mut().zip(&manifest.state.0) {
        entry.1 = state.1;
    }
    (complete && plan.computation.noise.is_none()).then_some(plan)
}
