//! What is computed for one row.

use super::ScanPlan;
use crate::Error;
use crate::analyse::{Stop, settings_of};
use crate::simulate::Monitor;
use motiform_analysis::regime::{Verdict, classify};

/// What is asked of each row.
pub trait Evaluate: Sync {
    /// The verdict on initial state `sample` of `cell`, a function of the plan and these two numbers alone; `None` if
    /// `stop` asked to stop.
    ///
    /// # Errors
    /// Input that only the numerics can refuse; the row then says so and is undetermined.
    fn evaluate(
        &self,
        plan: &ScanPlan,
        cell: usize,
        sample: usize,
        stop: &dyn Monitor,
    ) -> Result<Option<Verdict>, Error>;
}

/// Names the motion of each row.
#[derive(Clone, Copy, Debug, Default)]
pub struct Classify;

impl Evaluate for Classify {
    fn evaluate(
        &self,
        plan: &ScanPlan,
        cell: usize,
        sample: usize,
        stop: &dyn Monitor,
    ) -> Result<Option<Verdict>, Error> {
        let c = &plan.computation;
        let model = plan.model_of(cell)?;
        let start = plan.start(cell, sample, model.as_ref())?;
        let bounds = (c.escape_norm, c.max_steps);
        let settings = settings_of(plan.info()?, plan.method()?, c.control, bounds, c.budget);
        Ok(classify(model.as_ref(), &start, &settings, &mut Stop::new(stop))?)
    }
}
