//! Answers to questions about a plan: each is lines for people, and an object for programs.
//!
//! The program prints one of the two, Python reads the object. What an object has beside the answer is what it is about: the model, its
//! parameters, the accuracy.

mod apart;
mod classified;
mod exponents;
mod lived;
mod motions;
mod saddle;
mod scanned;
mod steady;

pub use classified::Classified;
pub use exponents::{Exponents, MeanExponents, OfOrbit};
pub use lived::Lived;
pub use motions::Motions;
pub use scanned::Scanned;
pub use steady::SteadyMotions;

use motiform_analysis::Estimate;
use motiform_dynamics::digits::value_and_error;
use motiform_models::ModelName;
use motiform_study::Plan;
use motiform_study::plan::{Control, Named};
use serde::Serialize;
use std::fmt::Display;

/// An answer: lines for people, and an object for programs.
pub trait Answer: Display + Serialize {
    /// The object on one line, if `json`, or else the lines.
    ///
    /// # Errors
    /// An object that cannot be written as JSON.
    fn said(&self, json: bool) -> serde_json::Result<String> {
        if json { serde_json::to_string(self) } else { Ok(self.to_string()) }
    }
}

impl<A: Display + Serialize> Answer for A {}

/// The subject of an answer.
#[derive(Clone, Copy, Debug, Serialize)]
struct About<'a> {
    model: &'a ModelName,
    parameters: &'a Named,
    control: Control,
}

impl<'a> About<'a> {
    fn of(plan: &'a Plan) -> Self {
        let c = &plan.computation;
        Self { model: &c.model, parameters: &c.parameters, control: c.control }
    }
}

/// Decimals of a list of rates: so many, and more where all of them are below 1e-3, as in slow units of time.
fn decimals(all: &[Estimate], usual: usize) -> usize {
    let largest = all.iter().map(|one| one.value.abs()).filter(|value| value.is_finite()).fold(0.0, f64::max);
    let slow = largest > 0.0 && largest < 1e-3;
    let more = if slow { -libm::log10(largest).floor() - 3.0 } else { 0.0 };
    usual + more.clamp(0.0, 12.0) as usize
}

/// `0.0902 +- 0.0021`, or a note that there is no error, with so many decimals.
fn estimate(estimate: &Estimate, width: usize, decimals: usize) -> String {
    let Estimate { value, error } = *estimate;
    if !estimate.has_error() {
        return format!("{value:>width$.decimals$} (no error)");
    }
    let [value, error] = value_and_error(value, error, 2);
    format!("{value:>width$} +- {error}")
}
