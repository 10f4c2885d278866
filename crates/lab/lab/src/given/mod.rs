//! Vector fields given from outside: functions whose values can be asked for, and nothing else.
//!
//! Nothing is known of their symmetry, their outline or their position in the plane, so bodies are not classified and have no
//! branches. What needs values alone works: orbits, ensembles, crossings; exponents, too, with a Jacobian or with differences.

mod derivative;
mod exponents;
mod orbits;

use motiform_dynamics::steppers::Method;
use motiform_dynamics::{StepControl, System, VectorField};
use motiform_study::plan::{check, stepper};
use motiform_study::study::RunSettings;
use motiform_study::{Error, Scales, plan};
use std::sync::Mutex;

pub use exponents::exponents;
pub use orbits::{Recording, Span, record, tracks};

/// A function `dx/dt = f(t, x; p)`. Several threads may call it at once.
pub trait Given: Send + Sync {
    /// Number of coordinates n.
    fn dim(&self) -> usize;

    /// Writes `f(t, x; p)`. An entry that is not written is not a number.
    ///
    /// # Shapes
    /// `x` and `dx` have n entries, `parameters` those of the caller.
    fn rates(&self, t: f64, x: &[f64], parameters: &[f64], dx: &mut [f64]);

    /// Writes `df_i/dx_j` at place `n i + j`; `false`, which is the default, if it is not known.
    fn jacobian(&self, _t: f64, _x: &[f64], _parameters: &[f64], _matrix: &mut [f64]) -> bool {
        false
    }
}

/// A given function with its parameters, as a vector field.
pub struct Flow<'g> {
    given: &'g dyn Given,
    parameters: Vec<f64>,
    room: Mutex<derivative::Room>,
}

impl<'g> Flow<'g> {
    /// `given` with these parameters.
    pub fn new(given: &'g dyn Given, parameters: Vec<f64>) -> Self {
        Self { given, parameters, room: Mutex::new(derivative::Room::new(given.dim())) }
    }

    /// `f(t, x)`.
    pub fn rates(&self, t: f64, x: &[f64], dx: &mut [f64]) {
        self.given.rates(t, x, &self.parameters, dx);
    }
}

impl System for Flow<'_> {
    fn dim(&self) -> usize {
        self.given.dim()
    }
}

impl VectorField<f64> for Flow<'_> {
    fn eval(&self, t: f64, u: &[f64], du: &mut [f64]) {
        self.rates(t, u, du);
    }
}

/// The settings of orbits of a given function.
#[derive(Clone, Copy, Debug)]
pub struct Settings {
    /// An explicit method.
    pub method: Method,
    /// Its step control.
    pub control: StepControl,
    /// Most steps of one orbit.
    pub max_steps: u64,
    /// A state beyond this norm has escaped.
    pub escape_norm: f64,
    /// The scales of the function at the parameters of the flow that they were made for.
    pub scales: Scales,
}

/// Absolute tolerance over relative tolerance, where it is not given: as for the tensor model.
const ABSOLUTE: f64 = 1e-3;

impl Settings {
    /// The settings of `run` (its stepper, tolerances or step, and bounds). Those that are not given are in the units of the function,
    /// by its values at time 0; what is wrong whatever the units, of its times too, is refused before the function is called.
    ///
    /// # Errors
    /// An unknown or exponential stepper, a value out of range.
    pub fn new(run: &RunSettings, flow: &Flow<'_>) -> Result<Self, Error> {
        let method = stepper(&run.stepper)?;
        if let Method::Exponential(_) = method {
            let remedy = "exponential methods need the linear part of the equations, which a function does not tell: give dop853, \
                          dopri5, rk4, heun or euler";
            return Err(Error::Setting { key: "stepper", value: run.stepper.clone(), remedy });
        }
        let control = |scales: Scales| match run.step {
            None if method.is_adaptive() => StepControl::Adaptive {
                rtol: run.rtol,
                atol: run.atol.unwrap_or(scales.absolute_tolerance(ABSOLUTE * run.rtol)),
            },
            step => StepControl::Fixed { step: step.unwrap_or(plan::DEFAULT_STEP) },
        };
        method.validate(control(Scales::ORDINARY))?;
        check("t_end", run.t_end, run.t_end > 0.0, "give a time above 0")?;
        check("transient", run.transient, run.transient >= 0.0, "give a time of at least 0")?;
        let given = run.escape_norm.unwrap_or(1.0);
        check("escape_norm", given, given > 0.0, "give a number above 0")?;
        if run.max_steps == 0 {
            return Err(Error::Setting { key: "max_steps", value: "0".into(), remedy: "give at least 1" });
        }
        let scales = Scales::of(flow);
        let escape_norm = run.escape_norm.unwrap_or(scales.escape_norm());
        Ok(Self { method, control: control(scales), max_steps: run.max_steps, escape_norm, scales })
    }
}

/// A start must have one finite number for each coordinate.
fn check_start(flow: &Flow<'_>, start: &[f64]) -> Result<(), Error> {
    let whole = start.len() == flow.dim();
    check("start", start.len() as f64, whole, "give one number for each coordinate")?;
    start.iter().try_for_each(|&value| check("start", value, true, "give finite numbers"))
}
