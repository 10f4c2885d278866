//! Rows of the tensor model, classified in the lanes of vector registers.

use super::ScanPlan;
use super::evaluate::{Done, Evaluate};
use crate::analyse::settings_of;
use motiform_analysis::regime::{Settings, Verdict, classifies_in_lanes};
use motiform_dynamics::Watch;
use motiform_kernels::{TensorRow, classify_tensors, covering};
use motiform_models::tensor::Tensor;
use motiform_study::Error;
use std::cell::RefCell;

type Next<'n> = &'n mut dyn FnMut() -> Option<(usize, usize)>;

/// Classifies all rows that `next` gives, in lanes; returns `false`, and takes none, if there is no kernel for the plan.
pub(super) fn classify(
    single: &dyn Evaluate,
    plan: &ScanPlan,
    next: Next<'_>,
    done: Done<'_>,
    stop: &dyn Watch,
) -> bool {
    let Some((settings, terms)) = kernel(plan) else { return false };
    Work { single, plan, settings, terms: covering(terms), next, done, stop }.run();
    true
}

/// The settings, and the terms that the corners of the plan need; `None` if there is no kernel.
fn kernel(plan: &ScanPlan) -> Option<(Settings, u32)> {
    let c = &plan.computation;
    let bounds = (c.escape_norm, c.max_steps);
    let settings = settings_of(plan.info().ok()?, plan.method().ok()?, c.control, bounds, c.budget);
    if !classifies_in_lanes(&settings) {
        return None;
    }
    let corners = [0, plan.cells() - 1].map(|cell| tensor(plan, cell).map(|tensor| tensor.terms()));
    Some((settings, corners[0]? | corners[1]?))
}

/// The model of a cell, if it is a tensor model.
fn tensor(plan: &ScanPlan, cell: usize) -> Option<Tensor> {
    plan.model_of(cell).ok()?.as_any()?.downcast_ref().copied()
}

/// The rows of one thread.
struct Work<'w> {
    single: &'w dyn Evaluate,
    plan: &'w ScanPlan,
    settings: Settings,
    terms: u32,
    next: Next<'w>,
    done: Done<'w>,
    stop: &'w dyn Watch,
}

impl Work<'_> {
    /// Runs the kernel with these terms; a row that has others is classified separately.
    fn run(self) {
        let Self { single, plan, settings, terms, next, done, stop } = self;
        let done = RefCell::new(done);
        let samples = plan.computation.samples;
        let mut candidate = || loop {
            let (cell, sample) = next()?;
            match row_in_lanes(plan, terms, cell, sample) {
                Ok(Some(candidate)) => return Some(candidate),
                Ok(None) => (done.borrow_mut())((cell, sample), single.evaluate(plan, cell, sample, stop)),
                Err(error) => (done.borrow_mut())((cell, sample), Err(error)),
            }
        };
        let mut decided = |key: usize, verdict: motiform_analysis::Result<Option<Verdict>>| {
            (done.borrow_mut())((key / samples, key % samples), verdict.map_err(Error::from));
        };
        classify_tensors(terms, &settings, &mut candidate, &mut decided, stop);
    }
}

/// A row for a lane of the kernel with these terms; `None` if it needs others.
fn row_in_lanes(plan: &ScanPlan, terms: u32, cell: usize, sample: usize) -> Result<Option<TensorRow>, Error> {
    let body = plan.model_of(cell)?;
    let start = plan.start(cell, sample, body.as_ref())?;
    let Some(&tensor) = body.as_any().and_then(|any| any.downcast_ref::<Tensor>()) else { return Ok(None) };
    let Ok(start) = start.try_into() else { return Ok(None) };
    Ok((tensor.terms() & !terms == 0).then_some(TensorRow {
        key: cell * plan.computation.samples + sample,
        body,
        tensor,
        start,
    }))
}
