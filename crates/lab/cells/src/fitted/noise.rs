//! The noise of a fit, with an error where that holds.

use super::Fitted;
use super::doubts::bias;
use motiform_inference::Estimate;
use motiform_statistics::{four_digits, to_error, with_error};
use serde_json::{Value, json};

/// Places in [`motiform_inference::Noise::at_bound`].
const FACTOR: usize = 0;
const VELOCITY: usize = 1;
const SHAPE: usize = 2;
const CENTRE: usize = 3;

impl Fitted {
    /// The noise of the velocity, with its unit, and its error where there is one.
    pub fn noise_of_velocity(&self, unit: &str) -> String {
        self.in_words(&self.model().noise.eta_v, VELOCITY, &format!(" {unit}"))
    }

    /// The noise of the shape, in the same way.
    pub fn noise_of_shape(&self, unit: &str) -> String {
        self.in_words(&self.model().noise.eta_shape, SHAPE, &format!(" {unit}"))
    }

    /// The noise of the centre beside that of the contour, in the same way.
    pub fn noise_of_centre(&self, unit: &str) -> String {
        self.in_words(&self.model().noise.centre, CENTRE, &format!(" {unit}"))
    }

    /// The factor of the stated errors, in the same way.
    pub fn factor_of_errors(&self) -> String {
        self.in_words(&self.model().noise.s, FACTOR, "")
    }

    fn in_words(&self, estimate: &Estimate, place: usize, unit: &str) -> String {
        in_words(estimate, self.has_errors_of_noise(), self.model().noise.at_bound[place], unit)
    }

    /// `true` if the errors of the noise hold: those of steady motions do, of which the coefficients have none, and not those of a model
    /// that is in doubt or biased.
    pub fn has_errors_of_noise(&self) -> bool {
        let biased = bias(&self.warnings).is_some() || self.regime.as_ref().is_some_and(|found| found.coarse);
        self.model().converged() && self.doubts.is_empty() && !biased
    }

    /// An error of the noise of this place, as far as it holds: not at a bound of the search.
    fn held(&self, error: f64, place: usize) -> Option<f64> {
        (self.has_errors_of_noise() && !self.model().noise.at_bound[place]).then_some(error)
    }

    /// The errors of the noise of velocity and shape, as far as they hold.
    pub(crate) fn errors_of_noise(&self) -> [Option<f64>; 2] {
        let noise = &self.model().noise;
        [self.held(noise.eta_v.error, VELOCITY), self.held(noise.eta_shape.error, SHAPE)]
    }

    /// All of it as JSON; errors that do not hold are null.
    pub(crate) fn noise_json(&self) -> Value {
        let noise = &self.model().noise;
        let number = |one: &Estimate, place: usize| {
            let [error, robust] = [one.error, one.robust].map(|error| self.held(error, place));
            json!({ "value": one.value, "error": error, "robust_error": robust })
        };
        json!({
            "measurement_factor": number(&noise.s, FACTOR),
            "eta_v": number(&noise.eta_v, VELOCITY),
            "eta_shape": number(&noise.eta_shape, SHAPE),
            "centre": number(&noise.centre, CENTRE),
        })
    }
}

/// `unit`: with the blank before it.
fn in_words(Estimate { value, error, .. }: &Estimate, hold: bool, at_bound: bool, unit: &str) -> String {
    match (at_bound, hold) {
        (true, _) => format!("{}{unit} (at the bound of the search: no error)", four_digits(*value)),
        (false, true) => format!("{}{unit}", with_error(*value, *error)),
        (false, false) => format!("{}{unit}", to_error(*value, *error)),
    }
}

#[cfg(test)]
mod tests {
    use super::in_words;
    use motiform_inference::Estimate;

    #[test]
    fn a_bound_has_no_error_nor_has_a_doubtful_fit() {
        let estimate = Estimate { value: 4.9e-6, error: 0.0, robust: 0.0, interval: [4.9e-6; 2] };
        assert_eq!(
            in_words(&estimate, true, true, " um"),
            "4.9e-6 um (at the bound of the search: no error)"
        );
        let estimate = Estimate { value: 0.5, error: 0.1, ..estimate };
        assert_eq!(in_words(&estimate, true, false, " um"), "0.50 \u{b1} 0.10 um");
        assert_eq!(in_words(&estimate, false, false, " um"), "0.50 um");
    }
}
