//! A plan: a study made explicit. Every number that a run depends on stands in it; nothing else does.

use crate::error::nearest_of;
pub use crate::named::Named;
use crate::random::Random;
use crate::study::{FigureSettings, ReturnMapSettings, Study};
use crate::{Error, initial};
use motiform_dynamics::steppers::Method;
use motiform_dynamics::{Model, Noise, Obstacle, Semilinear, StepControl};
use motiform_models::ModelInfo;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// Version of the meaning of a plan; part of the hash.
pub const PLAN_FORMAT: u32 = 2;

/// Most rows a trajectory may have (about 2 GB in memory).
const MOST_ROWS: f64 = 2e7;

/// Longest model time: beyond it, time itself has too few digits for steps of order 1.
pub const LONGEST: f64 = 1e9;

/// Most steps of a run: hours of computing.
const MOST_STEPS: f64 = 1e10;

/// An adaptive explicit step times the fastest rate: the edge of stability of methods of order 5 and 8.
const STEP_TIMES_RATE: f64 = 5.0;

/// Step of steppers that cannot control it, where none is given: the paper's.
const DEFAULT_STEP: f64 = 1e-3;

/// What will be computed, and how it is called and drawn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plan {
    /// Short name of the study.
    pub name: String,
    /// Title of the figures as typed, or nothing: see [`Plan::title`].
    pub title: String,
    /// What is computed: the hash covers this.
    pub computation: Computation,
    /// How it is drawn.
    pub figure: FigureSettings,
}

/// Everything that the numbers depend on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Computation {
    /// [`PLAN_FORMAT`].
    pub format: u32,
    /// The model.
    pub model: String,
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
    /// Most steps (transient and recording each).
    pub max_steps: u64,
    /// A shape beyond this norm has escaped.
    pub escape_norm: f64,
    /// The return map.
    pub return_map: Option<ReturnMapSettings>,
    /// Noise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub noise: Option<NoiseSettings>,
}

/// Additive white noise: `du = f(u) dt + eta dW` for every coordinate u that people see ([`Noise::on`]).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct NoiseSettings {
    /// Amplitude eta on the velocity, where that is an unknown (unit of velocity / sqrt(model time)).
    pub velocity: f64,
    /// Amplitude eta on the shape (unit of its coordinates / sqrt(model time)).
    pub shape: f64,
    /// Model time of a step of the noise, from the rates of the model alone ([`Noise::step_for`]).
    pub step: f64,
}

/// `amplitude 0.001 on the shape and 0 on the velocity, steps of 0.0625`.
impl std::fmt::Display for NoiseSettings {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { velocity, shape, step } = self;
        write!(f, "amplitude {shape:?} on the shape, {velocity:?} on the velocity, steps of {step}")
    }
}

impl NoiseSettings {
    /// The larger amplitude.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.velocity.max(self.shape)
    }
}

/// [`StepControl`] as it is written to files.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
#[allow(missing_docs, reason = "as in StepControl")]
pub enum Control {
    Adaptive { rtol: f64, atol: f64 },
    Fixed { step: f64 },
}

impl Control {
    /// The absolute tolerance; 0 for fixed steps.
    #[must_use]
    pub fn absolute_tolerance(self) -> f64 {
        match self {
            Self::Adaptive { atol, .. } => atol,
            Self::Fixed { .. } => 0.0,
        }
    }
}

/// `rtol 1e-9, atol 1e-12`, or `step 0.001`.
impl std::fmt::Display for Control {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Adaptive { rtol, atol } => write!(f, "rtol {rtol:e}, atol {atol:e}"),
            Self::Fixed { step } => write!(f, "step {step:?}"),
        }
    }
}

impl From<Control> for StepControl {
    fn from(control: Control) -> Self {
        match control {
            Control::Adaptive { rtol, atol } => Self::Adaptive { rtol, atol },
            Control::Fixed { step } => Self::Fixed { step },
        }
    }
}

impl Plan {
    /// Makes a study explicit and checks every number.
    ///
    /// # Errors
    /// [`Error`] naming the key, the value and the remedy.
    pub fn new(study: &Study) -> Result<Self, Error> {
        let info = study.info()?;
        let method = stepper(&study.run.stepper)?;
        let run = &study.run;
        check(
            "t_end",
            run.t_end,
            run.t_end > 0.0 && run.t_end <= LONGEST,
            "give a time above 0, at most 1e9",
        )?;
        let transient = run.transient >= 0.0 && run.transient <= LONGEST;
        check("transient", run.transient, transient, "give a time from 0 to 1e9")?;
        let dt_out = if run.dt_out == 0.0 { run.t_end / 2000.0 } else { run.dt_out };
        check("dt_out", dt_out, dt_out > 0.0, "give a time above 0")?;
        check(
            "dt_out",
            dt_out,
            run.t_end / dt_out <= MOST_ROWS,
            "that is over 20 million rows: give a longer time",
        )?;
        check("escape_norm", run.escape_norm, run.escape_norm > 0.0, "give a number above 0")?;
        study.random.unwrap_or(Random::SMALL).check()?;
        if run.max_steps == 0 {
            return Err(Error::Setting { key: "max_steps", value: "0".into(), remedy: "give at least 1" });
        }
        if let Some(map) = &study.return_map {
            check("return_map.x_max", map.x_max, map.x_min < map.x_max, "give a number above x_min")?;
        }
        check_figure(&study.figure)?;
        let control = control(study, method)?;
        let names = info.parameters().iter().map(|spec| spec.name.to_owned());
        let parameters = Named(names.zip(study.values()?).collect());
        let model = info.build(&parameters.values())?;
        check_stability(model.as_ref(), method, control)?;
        check_steps(model.as_ref(), method, control, run.transient + run.t_end)?;
        let initial = initial::resolve(study, info)?;
        check_start(model.as_ref(), &initial)?;
        let computation = Computation {
            format: PLAN_FORMAT,
            model: info.name.to_owned(),
            parameters,
            initial,
            seed: run.seed,
            transient: run.transient,
            t_end: run.t_end,
            dt_out,
            stepper: method.name().to_owned(),
            control,
            max_steps: run.max_steps,
            escape_norm: run.escape_norm,
            return_map: study.return_map.clone(),
            noise: noise(study, model.as_ref(), info.look)?,
        };
        let (name, title) = (study.name.clone(), study.title.clone());
        Ok(Self { name, title, computation, figure: study.figure.clone() })
    }

    /// SHA-256 of the computation as compact JSON, in hexadecimal: equal hashes mean equal numbers.
    #[must_use]
    pub fn hash(&self) -> String {
        sha256_hex(&serde_json::to_vec(&self.computation).unwrap_or_default())
    }

    /// The registry entry of its model.
    ///
    /// # Errors
    /// An unknown model (a plan read from a newer program's file, say).
    pub fn info(&self) -> Result<&'static ModelInfo, Error> {
        Ok(ModelInfo::find(&self.computation.model)?)
    }

    /// Its stepper.
    ///
    /// # Errors
    /// An unknown stepper.
    pub fn method(&self) -> Result<Method, Error> {
        stepper(&self.computation.stepper)
    }
}

/// SHA-256 in hexadecimal.
pub fn sha256_hex(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().fold(String::new(), |hex, byte| hex + &format!("{byte:02x}"))
}

/// Whether a setting is finite and `ok`.
///
/// # Errors
/// [`Error::Setting`] with the remedy.
pub fn check(key: &'static str, value: f64, ok: bool, remedy: &'static str) -> Result<(), Error> {
    if ok && value.is_finite() {
        Ok(())
    } else {
        // Debug, for it writes 1e-300 and not 300 zeros.
        let value = format!("{value:?}").trim_end_matches(".0").to_owned();
        Err(Error::Setting { key, value, remedy })
    }
}

/// The noise of a study, if it has any.
fn noise(study: &Study, model: &dyn Model, look: f64) -> Result<Option<NoiseSettings>, Error> {
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
    // A look is some tens of the slowest ordinary time scale.
    let settings = NoiseSettings { velocity, shape: run.noise, step: Noise::step_for(&rates, look / 20.0) };
    Ok((settings.largest() > 0.0).then_some(settings))
}

/// Refuses a study with noise where only the flow without it has an answer.
pub fn check_no_noise(amplitude: f64) -> Result<(), Error> {
    check(
        "noise",
        amplitude,
        amplitude == 0.0,
        "motions are named, and exponents computed, without noise: set it to 0",
    )
}

/// An explicit method is stable where its step times every rate of the linear part is small.
pub fn check_stability(model: &dyn Model, method: Method, control: Control) -> Result<(), Error> {
    let (Method::Explicit(tableau), Control::Fixed { step }) = (method, control) else { return Ok(()) };
    let mut rates = vec![0.0; model.dim()];
    Semilinear::<f64>::linear(model, &mut rates);
    let fastest = rates.iter().fold(0.0, |fastest: f64, rate| fastest.max(-rate));
    // The real stability intervals: 2 for orders 1 and 2, 2.785 for the classical method of order 4.
    let largest = if tableau.order < 4 { 2.0 } else { 2.785 } / fastest;
    if step > largest { Err(Error::UnstableStep { step, stepper: tableau.name, largest }) } else { Ok(()) }
}

/// Refuses a run that could not end: steps that are too many for the time, because they are fixed and tiny, or because the fastest
/// rate of the linear part keeps an explicit method to steps of some times its inverse.
pub fn check_steps(model: &dyn Model, method: Method, control: Control, time: f64) -> Result<(), Error> {
    if let Control::Fixed { step } = control {
        let remedy = "that is over 10 thousand million steps: give a larger step, or a shorter time";
        return check("step", step, time / step <= MOST_STEPS, remedy);
    }
    let Method::Explicit(tableau) = method else { return Ok(()) };
    let mut rates = vec![0.0; model.dim()];
    Semilinear::<f64>::linear(model, &mut rates);
    let rate = rates.iter().fold(0.0, |fastest: f64, rate| fastest.max(rate.abs()));
    if rate * time / STEP_TIMES_RATE <= MOST_STEPS {
        return Ok(());
    }
    Err(Error::Stiff { rate, time, stepper: tableau.name })
}

/// A start must be a body.
fn check_start(model: &dyn Model, initial: &Named) -> Result<(), Error> {
    let values = initial.values();
    let mut shape = vec![0.0; model.dim()];
    model.encode(&values[..model.dim()], &mut shape);
    check_closed(model, &shape)
}

/// A shape must be a body.
pub fn check_closed(model: &dyn Model, shape: &[f64]) -> Result<(), Error> {
    match model.obstacle(shape) {
        Some(Obstacle::Closure { residual }) => Err(Error::NotClosed { residual }),
        _ => Ok(()),
    }
}

/// Checks settings of figures that were changed after the plan was made.
///
/// # Errors
/// [`Error::Setting`] naming the key, the value and the remedy.
pub fn check_figure(figure: &FigureSettings) -> Result<(), Error> {
    check("figure.radius", figure.radius, figure.radius >= 0.0, "give a radius above 0, or 0 to choose it")?;
    check("figure.scale", figure.scale, figure.scale >= 0.0, "give a factor above 0, or 0 to choose it")?;
    check("figure.from", figure.from, figure.from >= 0.0, "give a time of at least 0")?;
    let after = figure.to == 0.0 || figure.to > figure.from;
    check("figure.to", figure.to, after, "give a time after figure.from, or 0 for the end")?;
    if figure.outlines > 2000 {
        let value = figure.outlines.to_string();
        return Err(Error::Setting { key: "figure.outlines", value, remedy: "give at most 2000" });
    }
    Ok(())
}

/// A stepper by name.
///
/// # Errors
/// An unknown name, with the nearest one.
pub fn stepper(name: &str) -> Result<Method, Error> {
    Method::find(name).ok_or_else(|| {
        let known = Method::names();
        Error::UnknownStepper { name: name.to_owned(), nearest: nearest_of(name, &known), known }
    })
}

/// The step control that a study asks for.
///
/// # Errors
/// [`Error::Setting`]; a step and a tolerance together.
pub fn control(study: &Study, method: Method) -> Result<Control, Error> {
    let run = &study.run;
    let control = match run.step {
        None if method.is_adaptive() => {
            let follows = study.info()?.absolute_tolerance(run.rtol);
            Control::Adaptive { rtol: run.rtol, atol: run.atol.unwrap_or(follows) }
        }
        step => Control::Fixed { step: step.unwrap_or(DEFAULT_STEP) },
    };
    method.validate(control.into())?;
    Ok(control)
}
