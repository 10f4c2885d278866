//! The motions of many plans of one model, together.

use crate::analyse::{self, Body};
use motiform_analysis::regime::{Settings, Verdict, classifies_in_lanes};
use motiform_dynamics::{Model, StopOnly, Watch};
use motiform_kernels::{Kernel, Row, classify_rows};
use motiform_study::{Error, RunPlan};

/// A body with its shape at the start.
type Start = (Box<dyn Model>, Vec<f64>);

/// The motions of `plans`, in their order, on this thread; `None` if the watch stopped it. The plans are of one model with any parameters
/// and starts, and have the numerics of the first one, its look and budget among them: for plans of one look verdicts are those of
/// [`analyse::classify`] to the last bit. They are found in the lanes of vector registers where there are kernels for the model.
///
/// # Errors
/// Input that only the numerics can reject.
///
/// # Checked by  `verdicts_are_those_of_each_plan`
pub fn classify(plans: &[RunPlan], budget: f64, watch: &dyn Watch) -> Result<Option<Vec<Verdict>>, Error> {
    let Some(first) = plans.first() else { return Ok(Some(Vec::new())) };
    let settings = analyse::settings(first, budget)?;
    let starts = plans.iter().map(|plan| analyse::start(plan)).collect::<Result<Vec<Start>, Error>>()?;
    let kernel = Kernel::of_all(starts.iter().map(|(model, _)| model.as_ref()));
    match kernel.filter(|_| plans.len() > 1 && classifies_in_lanes(&settings)) {
        Some(kernel) => in_lanes(kernel, &settings, starts, watch),
        None => one_by_one(plans, &settings, &starts, watch),
    }
}

fn one_by_one(
    plans: &[RunPlan],
    settings: &Settings,
    starts: &[Start],
    watch: &dyn Watch,
) -> Result<Option<Vec<Verdict>>, Error> {
    let classify = |(plan, (model, shape)): (&RunPlan, &Start)| {
        let values = plan.computation.parameters.values();
        Body { info: plan.info()?, values, model: model.as_ref() }.classify(shape, settings, &StopOnly(watch))
    };
    plans.iter().zip(starts).map(classify).collect()
}

fn in_lanes(
    kernel: Kernel,
    settings: &Settings,
    starts: Vec<Start>,
    watch: &dyn Watch,
) -> Result<Option<Vec<Verdict>>, Error> {
    let mut found: Vec<Option<Result<Option<Verdict>, Error>>> = starts.iter().map(|_| None).collect();
    let mut left = starts.into_iter().enumerate();
    let mut next = || left.next().map(|(key, (body, start))| Row { key, body, start });
    let mut done = |key: usize, verdict: motiform_analysis::Result<Option<Verdict>>| {
        found[key] = Some(verdict.map_err(Error::from));
    };
    classify_rows(kernel, settings, &mut next, &mut done, &StopOnly(watch));
    found.into_iter().map(|verdict| verdict.unwrap_or(Ok(None))).collect()
}
