//! Analyses of the motion of a plan: its regime and its Lyapunov exponents.

use motiform_analysis::regime::{Settings, Verdict, settle};
use motiform_analysis::{Lyapunov, LyapunovSettings, SoFar};
use motiform_dynamics::Watch;
use motiform_dynamics::steppers::Method;
use motiform_dynamics::{Model, StopOnly};
use motiform_models::ModelInfo;
use motiform_study::plan::{Control, check, check_no_noise};
use motiform_study::{Error, Plan, Scales};

/// Classifies the motion that starts from the plan's initial state, within at most `budget` model time (the model's
/// default, if 0); `None` if the watch stopped it. Where the model has a number of modes, the motion is found again with half as many
/// more ([`Verdict::resolved_by`]). The plan's transient and recording do not matter.
///
/// # Errors
/// Input that only the numerics can reject.
pub fn classify(plan: &Plan, budget: f64, watch: &dyn Watch) -> Result<Option<Verdict>, Error> {
    let (model, shape) = start(plan)?;
    let body =
        Body { info: plan.info()?, values: plan.computation.parameters.values(), model: model.as_ref() };
    body.classify(&shape, &settings(plan, budget)?, watch)
}

/// The tolerance of the second look at a motion is tighter by this factor: steps of order 4 are 1.8 times as many.
const FINER: f64 = 0.1;

/// A model with what another one with more modes is built from.
pub(crate) struct Body<'m> {
    pub(crate) info: &'static ModelInfo,
    /// All parameters, in registry order.
    pub(crate) values: Vec<f64>,
    pub(crate) model: &'m dyn Model,
}

impl Body<'_> {
    /// The verdict on the motion that starts from `shape`, its resolution included: the same for every command that names a motion.
    pub(crate) fn classify(
        &self,
        shape: &[f64],
        settings: &Settings,
        watch: &dyn Watch,
    ) -> Result<Option<Verdict>, Error> {
        let Some((verdict, shape)) = settle(self.model, shape, settings, watch)? else {
            return Ok(None);
        };
        let Some(Finer { body, shape, parameter, value }) = self.finer(&shape)? else {
            return Ok(Some(verdict));
        };
        let finer = settings.tighter(FINER);
        Ok(Some(verdict.resolved_by(body.as_ref(), &shape, parameter, value, &finer, &StopOnly(watch))?))
    }

    /// With half as many modes again; `None` for a model without a parameter for their number, or at its largest value.
    fn finer(&self, shape: &[f64]) -> Result<Option<Finer>, Error> {
        let (info, model) = (self.info, self.model);
        let Some(parameter) = info.resolution else { return Ok(None) };
        let mut values = self.values.clone();
        let place = motiform_models::parameters::index_of(info.parameters(), info.name, parameter)?;
        let (_, most) = info.parameters()[place].allowed;
        let value = (1.5 * values[place]).ceil();
        if value > most {
            return Ok(None);
        }
        values[place] = value;
        let body = info.build(&values)?;
        let known = model.decoded(shape);
        let of = |name: &str| model.coordinates().iter().position(|coordinate| coordinate.name == name);
        let coordinates: Vec<f64> =
            body.coordinates().iter().map(|one| of(one.name).map_or(0.0, |place| known[place])).collect();
        let shape = body.encoded(&coordinates);
        Ok(Some(Finer { body, shape, parameter, value }))
    }
}

/// A body with more modes, and a shape in its representation.
struct Finer {
    body: Box<dyn Model>,
    shape: Vec<f64>,
    parameter: &'static str,
    value: f64,
}

/// The scales of a plan's equations.
fn scales(plan: &Plan) -> Result<Scales, Error> {
    Scales::of_model(plan.info()?, &plan.computation.parameters.values())
}

/// The classifier's settings for a plan.
///
/// # Errors
/// A budget below 0, an unknown model or stepper.
pub fn settings(plan: &Plan, budget: f64) -> Result<Settings, Error> {
    let (info, c) = (plan.info()?, &plan.computation);
    let allowed = (0.0..=scales(plan)?.longest()).contains(&budget);
    check("budget", budget, allowed, "give a model time above 0, at most 1e9, or 0 for the model's default")?;
    let values = c.parameters.values();
    Ok(settings_of(info, &values, plan.method()?, c.control, c.escape_norm, c.max_steps, budget))
}

/// The classifier's settings: looks and budget (if that is 0) are those of the model at these parameters, the rest is that of the plan.
pub fn settings_of(
    info: &ModelInfo,
    values: &[f64],
    method: Method,
    control: Control,
    escape_norm: f64,
    max_steps: u64,
    budget: f64,
) -> Settings {
    let budget = if budget > 0.0 { budget } else { info.budget_at(values) };
    let first_look = info.look_at(values);
    Settings { method, control: control.into(), first_look, budget, escape_norm, max_steps }
}

/// The times of an average of growth; nothing: the defaults of the analysis, in looks of the model.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spans {
    /// Model time that is left out at the beginning.
    pub transient: Option<f64>,
    /// Model time that is averaged over, at most.
    pub t_end: Option<f64>,
}

/// The `count` largest Lyapunov exponents of the plan's motion, by default averaged over twenty looks of the model after four.
///
/// # Errors
/// A count the model does not have; input that only the numerics can reject.
pub fn lyapunov(plan: &Plan, count: usize, spans: Spans, watch: &dyn Watch) -> Result<Lyapunov, Error> {
    lyapunov_followed(plan, count, spans, watch, &mut |_| {})
}

/// As [`lyapunov`]; `follow` receives the averages as they are computed.
///
/// # Errors
/// As [`lyapunov`].
pub fn lyapunov_followed(
    plan: &Plan,
    count: usize,
    spans: Spans,
    watch: &dyn Watch,
    follow: &mut dyn FnMut(SoFar<'_>),
) -> Result<Lyapunov, Error> {
    let (model, shape) = start(plan)?;
    let settings = lyapunov_settings(plan, count, spans)?;
    Ok(motiform_analysis::lyapunov_followed(model.as_ref(), &shape, &settings, watch, follow)?.bounded())
}

/// The settings of [`lyapunov`] for a plan.
pub(crate) fn lyapunov_settings(plan: &Plan, count: usize, spans: Spans) -> Result<LyapunovSettings, Error> {
    let (look, c) = (plan.look()?, &plan.computation);
    let dim = c.initial.0.len() - 2; // without the position
    if count == 0 || count > dim {
        return Err(Error::Count { count, dim });
    }
    let (transient, span) = (spans.transient.unwrap_or(4.0 * look), spans.t_end.unwrap_or(20.0 * look));
    let scales = scales(plan)?;
    scales.check_time("transient", transient, false)?;
    scales.check_time("t_end", span, true)?;
    Ok(LyapunovSettings {
        count,
        method: plan.method()?,
        control: c.control.into(),
        transient,
        span,
        escape_norm: c.escape_norm,
        max_steps: c.max_steps,
    })
}

/// The model of a plan without noise: analyses refer to the flow.
pub(crate) fn model(plan: &Plan) -> Result<Box<dyn Model>, Error> {
    check_no_noise(plan.computation.noise.map_or(0.0, |noise| noise.largest()))?;
    plan.body()
}

/// The model of a plan, and its initial shape.
pub(crate) fn start(plan: &Plan) -> Result<(Box<dyn Model>, Vec<f64>), Error> {
    let model = model(plan)?;
    let shape = model.encoded(&plan.computation.initial.values()[..model.dim()]);
    Ok((model, shape))
}
