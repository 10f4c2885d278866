//! What is computed for one row.

use super::ScanPlan;
use crate::Error;
use crate::analyse::Stop;
use crate::simulate::Monitor;
use motiform_analysis::regime::{Settings, Verdict, classify};
use motiform_models::ModelInfo;

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
        let info = ModelInfo::find(&c.model)?;
        let model = plan.model_of(cell)?;
        let start = plan.start(cell, sample, model.as_ref())?;
        let settings = Settings {
            method: plan.method()?,
            control: c.control.into(),
            first_look: info.look,
            budget: if c.budget > 0.0 { c.budget } else { info.budget },
            escape_norm: c.escape_norm,
            max_steps: c.max_steps,
        };
        Ok(classify(model.as_ref(), &start, &settings, &mut Stop::new(stop))?)
    }
}
