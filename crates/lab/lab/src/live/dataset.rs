//! A recorded motion as a dataset: what files and figures are made of.

use super::Record;
use crate::readings::{measures, motion};
use crate::simulate::finite;
use motiform_dynamics::model::velocity;
use motiform_dynamics::{Model, Outcome, Sink, Trajectory};
use motiform_store::table::Table;
use motiform_study::dataset::{Dataset, Manifest, VERSION};
use motiform_study::plan::Named;
use motiform_study::{Error, Plan};

/// The record of a plan's model as a dataset: times start at 0, and the plan in its manifest starts from the first state that
/// is kept, so that `simulate` gives the same motion again (up to the steps that were taken, and without noise). `None` with fewer
/// than two samples.
///
/// # Errors
/// An unknown model.
pub fn dataset(
    plan: &Plan,
    model: &dyn Model,
    record: &Record,
    outcome: Option<Outcome>,
    crossings: Option<Table>,
) -> Result<Option<Dataset>, Error> {
    let (Some(first), Some(last)) = (record.rows().next(), record.rows().next_back()) else {
        return Ok(None);
    };
    if record.len() < 2 {
        return Ok(None);
    }
    let mut trajectory = Trajectory::new(first.state.len());
    for row in record.rows() {
        trajectory.sample(row.t - first.t, row.state);
    }
    let mut plan = plan.clone();
    let c = &mut plan.computation;
    (c.transient, c.t_end) = (0.0, last.t - first.t);
    c.initial = named(model, first.state);
    let (shape, position) = last.state.split_at(last.state.len() - 2);
    let table = motion(model, &trajectory, c);
    let mut state = named(model, last.state);
    state.0.truncate(shape.len());
    let manifest = Manifest {
        motiform: VERSION.to_owned(),
        plan_hash: plan.hash(),
        seed: plan.computation.seed,
        outcome: finite(outcome.unwrap_or(Outcome::Completed { t: last.t - first.t }).into()),
        regime: None,
        steps: 0,
        rejected_steps: 0,
        state,
        position: [position[0], position[1]],
        velocity: velocity(model, shape),
        measures: measures(model, shape),
        step_error: None,
        centre: None,
        plan,
    };
    Ok(Some(Dataset { manifest, trajectory: table, crossings }))
}

/// A state `(shape, x, y)` by its names.
fn named(model: &dyn Model, state: &[f64]) -> Named {
    let (shape, position) = state.split_at(state.len() - 2);
    let mut values = model.decoded(shape);
    values.extend(position);
    let names = model.coordinates().iter().map(|coordinate| coordinate.name).chain(["x", "y"]);
    Named(names.map(str::to_owned).zip(values).collect())
}
