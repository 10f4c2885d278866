//! Rows classified in the lanes of vector registers.

use super::ScanPlan;
use super::evaluate::{Done, Evaluate};
use crate::analyse::settings_of;
use motiform_analysis::regime::{Settings, Verdict, classifies_in_lanes};
use motiform_dynamics::Watch;
use motiform_kernels::{Kernel, Row, classify_rows};
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
    let Some((settings, kernel)) = kernel(plan) else { return false };
    LaneRows { single, plan, settings, kernel, next, done, stop }.run();
    true
}

/// The settings, and the kernel that a corner of the plan needs; `None` if there is none. Where the corners differ it is the last one's: an
/// axis from 0 on adds a term in all columns but the first.
fn kernel(plan: &ScanPlan) -> Option<(Settings, Kernel)> {
    let c = &plan.computation;
    let (info, values, method) = (plan.info().ok()?, plan.parameters_of(0).ok()?, plan.method().ok()?);
    let settings = settings_of(info, &values, method, c.control, c.escape_norm, c.max_steps, c.budget);
    if !classifies_in_lanes(&settings) {
        return None;
    }
    let corners = [0, plan.cells() - 1].map(|cell| Kernel::of(plan.model_of(cell).ok()?.as_ref()));
    Some((settings, corners[1].or(corners[0])?))
}

/// The rows of one thread.
struct LaneRows<'w> {
    single: &'w dyn Evaluate,
    plan: &'w ScanPlan,
    settings: Settings,
    kernel: Kernel,
    next: Next<'w>,
    done: Done<'w>,
    stop: &'w dyn Watch,
}

impl LaneRows<'_> {
    /// Runs the kernel; a row that it does not compute is classified separately.
    fn run(self) {
        let Self { single, plan, settings, kernel, next, done, stop } = self;
        let done = RefCell::new(done);
        let samples = plan.computation.samples;
        let mut candidate = || loop {
            let (cell, sample) = next()?;
            match row_in_lanes(plan, &settings, kernel, cell, sample) {
                Ok(Some(candidate)) => return Some(candidate),
                Ok(None) => (done.borrow_mut())((cell, sample), single.evaluate(plan, cell, sample, stop)),
                Err(error) => (done.borrow_mut())((cell, sample), Err(error)),
            }
        };
        let mut decided = |key: usize, verdict: motiform_analysis::Result<Option<Verdict>>| {
            (done.borrow_mut())((key / samples, key % samples), verdict.map_err(Error::from));
        };
        classify_rows(kernel, &settings, &mut candidate, &mut decided, stop);
    }
}

/// A row for a lane of this kernel; `None` if it does not compute it, or the body is looked at over other times.
fn row_in_lanes(
    plan: &ScanPlan,
    settings: &Settings,
    kernel: Kernel,
    cell: usize,
    sample: usize,
) -> Result<Option<Row>, Error> {
    let body = plan.model_of(cell)?;
    let start = plan.start(cell, sample, body.as_ref())?;
    let key = cell * plan.computation.samples + sample;
    let suits = kernel.computes(body.as_ref()) && plan.look_of(cell)? == settings.first_look;
    Ok(suits.then_some(Row { key, body, start }))
}
