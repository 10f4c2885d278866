//! The likelihood at given values, in the units of the data.

use super::{Settings, setup};
use crate::filter::{NOISES, Problem, Theta, Want, evaluate};
use crate::{Error, Result, Scales, Track};
use serde::{Deserialize, Serialize};

/// Values of everything that is fitted, in the units of the data.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameters {
    /// Coefficients in the order of the library's terms; for handed models all real parts, then all imaginary parts.
    pub coefficients: Vec<f64>,
    /// Factor of the standard errors of the observations, above 0.
    pub s: f64,
    /// Process noise of the velocity, above 0 (unit of the velocity / sqrt(time)).
    pub eta_v: f64,
    /// Process noise of the shape, above 0 (unit of the modes / sqrt(time)).
    pub eta_shape: f64,
    /// Standard deviation of each coordinate of the centre beside the error of its contour, 0 or more (length): a jitter of the images.
    pub centre: f64,
}

/// The log-likelihood with its derivatives by the coefficients, `ln s`, `ln eta_v`, `ln eta_shape`, and
/// `l = ln sqrt(centre^2/c + 0.01)`, c the mean of the stated variances of a coordinate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Likelihood {
    /// Log-likelihood of all frames but the first of each stretch; `None` where the filter diverges.
    pub value: Option<f64>,
    /// Gradient.
    pub gradient: Vec<f64>,
    /// Expected (Fisher) information.
    pub information: Vec<Vec<f64>>,
}

/// The parameters in natural units.
pub(super) fn natural(
    problem: &Problem,
    settings: &Settings,
    scales: &Scales,
    at: &Parameters,
) -> Result<Theta> {
    let units = units(problem, settings, scales);
    if at.coefficients.len() != units.len() {
        let value = at.coefficients.len() as f64;
        return Err(Error::Setting {
            key: "coefficients",
            value,
            remedy: "give one for every term and part",
        });
    }
    let noise = scales.noise();
    let positive = [("s", at.s), ("eta_v", at.eta_v), ("eta_shape", at.eta_shape)];
    if let Some(&(key, value)) = positive.iter().find(|(_, value)| !(*value > 0.0 && value.is_finite())) {
        return Err(Error::Setting { key, value, remedy: "give a number above 0" });
    }
    if !(at.centre >= 0.0 && at.centre.is_finite()) {
        return Err(Error::Setting { key: "centre", value: at.centre, remedy: "give 0 or more" });
    }
    let [s, eta_v, eta_shape] = [at.s, at.eta_v / noise[0], at.eta_shape / noise[1]].map(libm::log);
    Ok(Theta {
        coefficients: at.coefficients.iter().zip(units).map(|(c, unit)| c / unit).collect(),
        logs: [s, eta_v, eta_shape, problem.log_of_own_noise(at.centre / scales.length())],
    })
}

/// The unit of each coefficient.
pub(super) fn units(problem: &Problem, settings: &Settings, scales: &Scales) -> Vec<f64> {
    let terms = &settings.library.terms;
    problem.parts.iter().map(|part| scales.coefficient(&terms[part.term])).collect()
}

/// The log-likelihood at these values, with gradient and information.
///
/// # Errors    of the input; a filter that diverges is a value of `None`
/// # Checked by  `tests/all/filter.rs`: an exact Gaussian likelihood, finite differences
pub fn likelihood(tracks: &[Track], settings: &Settings, at: &Parameters) -> Result<Likelihood> {
    let scales = setup::check(tracks, settings)?;
    let problem = setup::checked(tracks, settings, &scales)?;
    let theta = natural(&problem, settings, &scales, at)?;
    let found = evaluate(&problem, &theta, Want::Exact, false);
    let mut units = units(&problem, settings, &scales);
    units.extend([1.0; NOISES]);
    let n = units.len();
    let frames = problem.frames() as f64;
    Ok(Likelihood {
        value: found.value.is_finite().then(|| found.value + frames * scales.log_density()),
        gradient: (0..n).map(|i| found.gradient[i] / units[i]).collect(),
        information: (0..n)
            .map(|i| (0..n).map(|j| found.information[(i, j)] / (units[i] * units[j])).collect())
            .collect(),
    })
}
