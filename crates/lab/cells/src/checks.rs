//! Checks beside a fit for the reader to judge it by: another estimate, and what the fit leaves unexplained.

use motiform_inference::{Channel, Fit, Track, Weak, weak, whiteness};
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
    pub(crate) fn of(tracks: &[Track], model: &Fit) -> Self {
        let weak = if model.handed { None } else { weak(tracks, &model.library).ok() };
        Self { weak, innovations: whiteness(model) }
    }

    /// A coefficient by the weak form, by its number in the model; `None` where the windows do not determine it.
    #[must_use]
    pub fn weak(&self, place: usize) -> Option<f64> {
        self.weak.as_ref()?.coefficients.as_ref()?.get(place).copied()
    }
}
