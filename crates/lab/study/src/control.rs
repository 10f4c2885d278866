//! Step control and noise, as written in plans and files.

#[allow(unused_imports, reason = "for links of the documentation")]
use motiform_dynamics::Noise;
use motiform_dynamics::digits::given;
use motiform_dynamics::{Model, StepControl};
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

impl NoiseSettings {
    /// The larger amplitude.
    pub fn largest(&self) -> f64 {
        self.velocity.max(self.shape)
    }

    /// The parts of a body that it acts on, with its amplitude there: the velocity where that is an unknown, the shape where there is one.
    pub fn parts(&self, body: &dyn Model) -> Vec<(&'static str, f64)> {
        let velocities = body.velocities();
        let shape = (body.dim() > velocities).then_some(("shape", self.shape));
        shape.into_iter().chain((velocities > 0).then_some(("velocity", self.velocity))).collect()
    }

    /// `amplitude 0.001 on the shape, 0 on the velocity, steps of 0.0625`.
    pub fn words(&self, body: &dyn Model) -> String {
        let steps = given(self.step);
        if self.largest() == 0.0 {
            return format!("as in the equations, steps of {steps}");
        }
        let on = |(what, amplitude): (&str, f64)| format!("{} on the {what}", given(amplitude));
        let parts: Vec<String> = self.parts(body).into_iter().map(on).collect();
        format!("amplitude {}, steps of {steps}", parts.join(", "))
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
