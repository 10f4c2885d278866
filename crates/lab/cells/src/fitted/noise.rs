//! The noise of a fit, with an error where it has one.

use super::Fitted;
use motiform_inference::{Estimate, Noise};
use motiform_statistics::{four_digits, with_error};
use serde_json::{Value, json};

/// Places in [`Noise::at_bound`].
const FACTOR: usize = 0;
const VELOCITY: usize = 1;
const SHAPE: usize = 2;
const CENTRE: usize = 3;

impl Fitted {
    /// The noise of the velocity, with its error and unit; without an error where the search ended at its bound.
    #[must_use]
    pub fn noise_of_velocity(&self, unit: &str) -> String {
        let noise = &self.model().noise;
        in_words(&noise.eta_v, noise.at_bound[VELOCITY], unit)
    }

    /// The noise of the shape, in the same way.
    #[must_use]
    pub fn noise_of_shape(&self, unit: &str) -> String {
        let noise = &self.model().noise;
        in_words(&noise.eta_shape, noise.at_bound[SHAPE], unit)
    }
}

fn in_words(Estimate { value, error, .. }: &Estimate, at_bound: bool, unit: &str) -> String {
    match at_bound {
        true => format!("{} {unit} (at the bound of the search: no error)", four_digits(*value)),
        false => format!("{} {unit}", with_error(*value, *error)),
    }
}

/// All of it as JSON; errors are null at a bound of the search.
pub(crate) fn noise_json(noise: &Noise) -> Value {
    let number = |Estimate { value, error, robust, .. }: &Estimate, place: usize| {
        let known = |error: f64| (!noise.at_bound[place]).then_some(error);
        json!({ "value": value, "error": known(*error), "robust_error": known(*robust) })
    };
    json!({
        "measurement_factor": number(&noise.s, FACTOR),
        "eta_v": number(&noise.eta_v, VELOCITY),
        "eta_shape": number(&noise.eta_shape, SHAPE),
        "centre": number(&noise.centre, CENTRE),
    })
}

#[cfg(test)]
mod tests {
    use super::in_words;
    use motiform_inference::Estimate;

    #[test]
    fn a_bound_has_no_error() {
        let estimate = Estimate { value: 4.9e-6, error: 0.0, robust: 0.0, interval: [4.9e-6; 2] };
        assert_eq!(in_words(&estimate, true, "um"), "4.9e-6 um (at the bound of the search: no error)");
        let estimate = Estimate { value: 0.5, error: 0.1, ..estimate };
        assert_eq!(in_words(&estimate, false, "um"), "0.50 \u{b1} 0.10 um");
    }
}
