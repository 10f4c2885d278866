//! Step control and noise, as written in plans and files.

#[allow(unused_imports, reason = "for links of the documentation")]
use motiform_dynamics::Noise;
use motiform_dynamics::StepControl;
use serde::{Deserialize, Serialize};

/// Additive white noise: `du = f(u) dt + eta dW` for every named coordinate u ([`Noise::on`]), beside that of the model itself.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct NoiseSettings {
    /// Amplitude eta on the velocity, if that is an unknown (unit of velocity / sqrt(model time)).
    pub velocity: f64,
    /// Amplitude eta on the shape (unit of its coordinates / sqrt(model time)).
    pub shape: f64,
    /// Model time of a step of the noise, from the rates of the model, at most the time between samples ([`Noise::step_for`]).
    pub step: f64,
}

/// `amplitude 0.001 on the shape and 0 on the velocity, steps of 0.0625`.
impl std::fmt::Display for NoiseSettings {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { velocity, shape, step } = self;
        if self.largest() == 0.0 {
            return write!(f, "as in the equations, steps of {step}");
        }
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
