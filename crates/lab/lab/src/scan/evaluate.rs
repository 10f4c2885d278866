//! The computation of one row.

use super::{ScanPlan, lanes};
use crate::analyse::{Body, settings_of};
use motiform_analysis::regime::Verdict;
use motiform_dynamics::{StopOnly, Watch};
use motiform_study::Error;

/// Receives verdicts, each with its cell and initial state.
pub type Done<'d> = &'d mut dyn FnMut((usize, usize), Result<Option<Verdict>, Error>);

/// The computation for each row.
pub trait Evaluate: Sync {
    /// The verdict on initial state `sample` of `cell`, a function of the plan and these two numbers alone; `None` if
    /// it was stopped.
    ///
    /// # Errors
    /// Input that only the numerics can reject; the row then states this and is undetermined.
    fn evaluate(
        &self,
        plan: &ScanPlan,
        cell: usize,
        sample: usize,
        stop: &dyn Watch,
    ) -> Result<Option<Verdict>, Error>;

    /// The verdicts on all rows that `next` gives (cell and sample), on this thread; each is passed to `done` with these
    /// two. Rows may be completed in any order. An implementation may compute many of them together, but
    /// every verdict must be that of [`Evaluate::evaluate`].
    fn evaluate_all(
        &self,
        plan: &ScanPlan,
        next: &mut dyn FnMut() -> Option<(usize, usize)>,
        done: Done<'_>,
        stop: &dyn Watch,
    ) {
        one_by_one(self, plan, next, done, stop);
    }
}

/// Each row separately.
fn one_by_one<E: Evaluate + ?Sized>(
    evaluate: &E,
    plan: &ScanPlan,
    next: &mut dyn FnMut() -> Option<(usize, usize)>,
    done: Done<'_>,
    stop: &dyn Watch,
) {
    while let Some((cell, sample)) = next() {
        done((cell, sample), evaluate.evaluate(plan, cell, sample, stop));
    }
}

/// Classifies the motion of each row, with its resolution: the verdict is that of `motiform classify` for the same start.
#[derive(Clone, Copy, Debug, Default)]
pub struct Classify;

impl Evaluate for Classify {
    fn evaluate(
        &self,
        plan: &ScanPlan,
        cell: usize,
        sample: usize,
        stop: &dyn Watch,
    ) -> Result<Option<Verdict>, Error> {
        let c = &plan.computation;
        let model = plan.model_of(cell)?;
        let start = plan.start(cell, sample, model.as_ref())?;
        let (info, values) = (plan.info()?, plan.parameters_of(cell)?);
        let settings =
            settings_of(info, &values, plan.method()?, c.control, c.escape_norm, c.max_steps, c.budget);
        let body = Body { info, values, model: model.as_ref() };
        body.classify(&start, &settings, &StopOnly(stop))
    }

    /// In the lanes of vector registers, if there are such kernels for the model and the method.
    fn evaluate_all(
        &self,
        plan: &ScanPlan,
        next: &mut dyn FnMut() -> Option<(usize, usize)>,
        done: Done<'_>,
        stop: &dyn Watch,
    ) {
        if !lanes::classify(self, plan, next, done, stop) {
            one_by_one(self, plan, next, done, stop);
        }
    }
}
