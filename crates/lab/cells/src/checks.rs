//! Checks beside a fit for the reader to judge it by: another estimate, and what the fit leaves unexplained.

use motiform_inference::{Channel, Error, Fit, Track, Weak, weak, whiteness};
use serde::{Deserialize, Serialize};

/// Checks of a fit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Checks {
    /// The same coefficients by the weak form; `None` for handed models, whose coefficients are complex.
    pub weak: Option<Weak>,
    /// Variance and autocorrelation of the standardised innovations of each observed number.
    pub innovations: Vec<Channel>,
}

impl Checks {
    /// The checks of a model that was fitted to these tracks.
    ///
    /// # Errors
    /// Tracks that the weak form cannot use.
    pub(crate) fn of(tracks: &[Track], model: &Fit) -> Result<Self, Error> {
        let noise = [model.noise.eta_v.value, model.noise.eta_shape.value];
        let weak = if model.handed { None } else { Some(weak(tracks, &model.library, noise)?) };
        Ok(Self { weak, innovations: whiteness(model) })
    }

    /// A coefficient by the weak form, by its number in the model; `None` where [`Checks::no_weak`] says why.
    pub fn weak(&self, place: usize) -> Option<f64> {
        *self.weak.as_ref()?.coefficients.get(place)?
    }

    /// The reasons of the coefficients that have no estimate by the weak form.
    pub fn no_weak(&self) -> Vec<String> {
        let handed = || vec!["the model is handed, and the weak form is one of real coefficients".to_owned()];
        self.weak.as_ref().map_or_else(handed, |weak| weak.reasons.clone())
    }
}
