//! The plan of a run: exactly the numbers that a simulation or an analysis of one body depends on.

use super::{Control, Named, NoiseSettings, Plan, Question};
use crate::checks::{check, check_figure, check_stability, check_start, check_steps};
use crate::scan::Axis;
use crate::study::{FigureSettings, ReturnMapSettings, Study};
use crate::{Error, Scales, initial};
use motiform_dynamics::steppers::Method;
use motiform_dynamics::{Model, Noise, Semilinear};
use motiform_models::ModelName;
use motiform_store::Kind;
use serde::{Deserialize, Serialize};

/// Version of the meaning of a plan; part of the hash.
pub const PLAN_FORMAT: u32 = 2;

/// Maximum number of rows of a trajectory (a file of about 2 TB).
pub const MOST_ROWS: f64 = 2e10;

/// Maximum number of rows of a trajectory in memory (about 2 GB).
pub const MOST_IN_MEMORY: f64 = 2e7;

/// Default step of steppers without step control: that of the paper.
pub const DEFAULT_STEP: f64 = 1e-3;

/// Everything that the numbers depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Computation {
    /// [`PLAN_FORMAT`].
    pub format: u32,
    /// The model.
    pub model: ModelName,
    /// All parameters, in registry order.
    pub parameters: Named,
    /// The complete start, position included.
    pub initial: Named,
    /// Seed (the start above was drawn with it, if drawn).
    pub seed: u64,
    /// Time before the recording.
    pub transient: f64,
    /// Time recorded.
    pub t_end: f64,
    /// Time between rows.
    pub dt_out: f64,
    /// Stepper.
    pub stepper: String,
    /// Step control.
    pub control: Control,
    /// Maximum number of steps (transient and recording each).
    pub max_steps: u64,
    /// A shape beyond this norm has escaped.
    pub escape_norm: f64,
    /// The return map.
    pub return_map: Option<ReturnMapSettings>,
    /// Noise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub noise: Option<NoiseSettings>,
}

/// The plan of a run.
pub type RunPlan = Plan<Computation>;

impl Question for Computation {
    type Figure = FigureSettings;
    const KIND: Kind = Kind::Dataset;
    const KEY: &'static str = "plan";

    fn value(&self) -> serde_json::Value {
        serde_json::to_value(self).unwrap_or_default()
    }

    fn model(&self) -> &ModelName {
        &self.model
    }

    fn title(&self, name: &str) -> String {
        crate::titles::of_run(self, name, None)
    }
}

impl RunPlan {
    /// Rejects a trajectory that is too long to be held in memory; [`RunPlan::new`] takes those that are
    /// written as they are computed.
    ///
    /// # Errors
    /// [`Error::Setting`].
    pub fn check_in_memory(&self) -> Result<(), Error> {
        let Computation { t_end, dt_out, .. } = self.computation;
        let remedy = "this gives more than 20 million rows, too many for memory: give a longer time, \
                      or write the run to a folder as it is computed";
        check("dt_out", dt_out, t_end / dt_out <= MOST_IN_MEMORY, remedy)
    }

    /// Resolves a study and checks every number.
    ///
    /// # Errors
    /// [`Error`] naming the key, the value and the remedy.
    pub fn new(study: &Study) -> Result<Self, Error> {
        Self::over(study, &[])
    }

    /// The same, with tolerances and bounds in the units of the equations at the ends of these axes.
    pub(crate) fn over(study: &Study, axes: &[Axis]) -> Result<Self, Error> {
        let info = study.info()?;
        let method = stepper(&study.run.stepper)?;
        let run = &study.run;
        let scales = study.scales_over(axes)?;
        scales.check_time("t_end", run.t_end, true)?;
        scales.check_time("transient", run.transient, false)?;
        let dt_out = if run.dt_out == 0.0 { run.t_end / 2000.0 } else { run.dt_out };
        check("dt_out", dt_out, dt_out > 0.0, "give a time above 0")?;
        check(
            "dt_out",
            dt_out,
            run.t_end / dt_out <= MOST_ROWS,
            "this gives more than 20 thousand million rows: give a longer time",
        )?;
        study.starts(1)?.check()?;
        if run.max_steps == 0 {
            return Err(Error::Setting { key: "max_steps", value: "0".into(), remedy: "give at least 1" });
        }
        if let Some(map) = &study.return_map {
            check("return_map.x_max", map.x_max, map.x_min < map.x_max, "give a number above x_min")?;
        }
        check_figure(&study.figure)?;
        let control = control(study, method, scales)?;
        let names = info.parameters().iter().map(|spec| spec.name.to_owned());
        let parameters = Named(names.zip(study.values()?).collect());
        let model = info.build(&parameters.values())?;
        check_stability(model.as_ref(), method, control)?;
        check_steps(model.as_ref(), method, control, run.transient + run.t_end)?;
        let initial = initial::resolve(study, info)?;
        check_start(model.as_ref(), &initial)?;
        let look = info.look_at(&parameters.values());
        let noise = noise(study, model.as_ref(), look, dt_out)?;
        let scales = if info.is_built_in() { scales } else { scales.under(run.largest_noise(), look) };
        let escape_norm = escape_norm(study, scales)?;
        let computation = Computation {
            format: PLAN_FORMAT,
            model: ModelName::from(info),
            parameters,
            initial,
            seed: run.seed,
            transient: run.transient,
            t_end: run.t_end,
            dt_out,
            stepper: method.name().to_owned(),
            control,
            max_steps: run.max_steps,
            escape_norm,
            return_map: study.return_map.clone(),
            noise,
        };
        let (name, title) = (study.name.clone(), study.title.clone());
        Ok(Self { name, title, computation, figure: study.figure.clone() })
    }

    /// The body that it describes: its model at its parameters.
    ///
    /// # Errors
    /// An unknown model, or parameters that it refuses.
    pub fn body(&self) -> Result<Box<dyn Model>, Error> {
        Ok(self.info()?.build(&self.computation.parameters.values())?)
    }

    /// The look of its body.
    ///
    /// # Errors
    /// An unknown model.
    pub fn look(&self) -> Result<f64, Error> {
        Ok(self.info()?.look_at(&self.computation.parameters.values()))
    }

    /// Its stepper.
    ///
    /// # Errors
    /// An unknown stepper.
    pub fn method(&self) -> Result<Method, Error> {
        stepper(&self.computation.stepper)
    }
}

/// The noise of a study, if it has any.
fn noise(study: &Study, model: &dyn Model, look: f64, dt_out: f64) -> Result<Option<NoiseSettings>, Error> {
    let run = &study.run;
    let remedy = "give an amplitude above 0, or 0 for none";
    check("noise", run.noise, run.noise >= 0.0, remedy)?;
    let unknown = model.velocities() > 0;
    let velocity = run.noise_velocity.unwrap_or(if unknown { run.noise } else { 0.0 });
    check("noise_velocity", velocity, velocity >= 0.0, remedy)?;
    let remedy = "the velocity of this model is read off its shape: give noise, which is on the shape";
    check("noise_velocity", velocity, unknown || velocity == 0.0, remedy)?;
    let mut rates = vec![0.0; model.dim()];
    Semilinear::<f64>::linear(model, &mut rates);
    let own = model.noise();
    rates.extend(own.diffusion.as_ref().map(|diffusion| diffusion.rate()));
    // A look is some tens of the slowest ordinary time scale. Within a step the path has one bridge: a second sample in it would follow
    // from the first.
    let step = Noise::step_for(&rates, look / 20.0).min(libm::exp2(libm::log2(dt_out).floor()));
    let settings = NoiseSettings { velocity, shape: run.noise, step };
    Ok((settings.largest() > 0.0 || !own.is_none()).then_some(settings))
}

/// Relative tolerances that are allowed: with larger ones periods are followed twice, and motions have wrong names.
const RTOL: std::ops::RangeInclusive<f64> = 1e-14..=1e-4;

/// A stepper by name.
///
/// # Errors
/// An unknown name, with the nearest one.
pub fn stepper(name: &str) -> Result<Method, Error> {
    Method::find(name).ok_or_else(|| {
        let known = Method::names();
        Error::unknown("stepper", name, &known, format!("the steppers are {}", known.join(", ")))
    })
}

/// The norm beyond which a shape of a study has escaped.
///
/// # Errors
/// [`Error::Setting`].
pub(crate) fn escape_norm(study: &Study, scales: Scales) -> Result<f64, Error> {
    let norm = study.run.escape_norm.unwrap_or(scales.escape_norm());
    check("escape_norm", norm, norm > 0.0, "give a number above 0")?;
    Ok(norm)
}

/// The step control of a study.
///
/// # Errors
/// [`Error::Setting`]; a step and a tolerance together.
pub(crate) fn control(study: &Study, method: Method, scales: Scales) -> Result<Control, Error> {
    let run = &study.run;
    let control = match run.step {
        None if method.is_adaptive() => {
            let info = study.info()?;
            let atol = match run.atol {
                Some(atol) => atol,
                None => scales.absolute_tolerance(info.absolute_tolerance(run.rtol)),
            };
            Control::Adaptive { rtol: run.rtol, atol }
        }
        step => Control::Fixed { step: step.unwrap_or(DEFAULT_STEP) },
    };
    if matches!(control, Control::Adaptive { rtol, .. } if !RTOL.contains(&rtol)) {
        let remedy = "give a number from 1e-14 to 1e-4: with larger ones orbits do not close, and motions have wrong names";
        return Err(Error::Setting { key: "rtol", value: format!("{:?}", run.rtol), remedy });
    }
    method.validate(control.into())?;
    Ok(control)
}
