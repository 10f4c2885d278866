//! The initial state of an interactive simulation.

use crate::clock::Moment;
use crate::simulate::after_transient;
use motiform_dynamics::Watch;
use motiform_dynamics::{Model, Outcome};
use motiform_study::{Error, Plan};
use std::time::Duration;

/// The initial state of a plan's body: the shape in the representation of `model` (the plan's model), then x and y.
pub fn start(plan: &Plan, model: &dyn Model) -> Vec<f64> {
    let mut state = plan.computation.initial.values();
    let shape = state.len() - 2;
    let values = state[..shape].to_vec();
    model.encode(&values, &mut state[..shape]);
    state
}

/// The state after the plan's transient, or as far into it as `within` allows; the initial state if the motion ends earlier.
/// The position is that of the start.
///
/// # Errors
/// Input that only the numerics can reject.
pub fn settled(plan: &Plan, model: &dyn Model, within: Duration) -> Result<Vec<f64>, Error> {
    let (ended, state) = after_transient(plan, model, &Patience { begun: Moment::now(), within })?;
    let usable = ended.is_none_or(|ending| matches!(ending.outcome, Outcome::Interrupted { .. }));
    Ok(if usable { state } else { start(plan, model) })
}

/// Stops after its time limit.
struct Patience {
    begun: Moment,
    within: Duration,
}

impl Watch for Patience {
    fn stopped(&self) -> bool {
        self.begun.elapsed() > self.within
    }
}
