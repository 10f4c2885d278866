//! The likelihood at given values, in the units of the data.

use super::{Settings, memory, setup};
use crate::filter::{NOISES, Problem, Theta, Want, evaluate};
use crate::{Error, MOST_MODES, Result, Scales, Track};
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
    /// Rate k at which the noise w of the velocity forgets, `w' = -k w + eta_v W'`, above 0 (1/time; `eta_v` in units of the velocity /
    /// time^(3/2)), of at most three modes. `None`: white noise, the limit of a large rate with `eta_v/k` kept.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rate: Option<f64>,
    /// Process noise of the shape, above 0 (unit of the modes / sqrt(time)).
    pub eta_shape: f64,
    /// Standard deviation of each coordinate of the centre beside the error of its contour, 0 or more (length): a jitter of the images.
    pub centre: f64,
}

/// The log-likelihood with its derivatives by the coefficients, by `-k` where the noise of the velocity has a rate, `ln s`, `ln eta_v`,
/// `ln eta_shape`, and `l = ln sqrt(centre^2/c + 0.01)`, c the mean of the stated variances of a coordinate.
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
    if at.coefficients.len() + usize::from(at.rate.is_some()) != units.len() {
        let value = at.coefficients.len() as f64;
        return Err(Error::Setting {
            key: "coefficients",
            value,
            remedy: "give one for every term and part",
        });
    }
    let [mut unit_v, unit_shape] = scales.noise();
    if at.rate.is_some() {
        unit_v /= scales.time;
    }
    let mut positive = [("s", at.s), ("eta_v", at.eta_v), ("eta_shape", at.eta_shape)].to_vec();
    positive.extend(at.rate.map(|rate| ("rate", rate)));
    if let Some(&(key, value)) = positive.iter().find(|(_, value)| !(*value > 0.0 && value.is_finite())) {
        return Err(Error::Setting { key, value, remedy: "give a number above 0" });
    }
    if !(at.centre >= 0.0 && at.centre.is_finite()) {
        return Err(Error::Setting { key: "centre", value: at.centre, remedy: "give 0 or more" });
    }
    let [s, eta_v, eta_shape] = [at.s, at.eta_v / unit_v, at.eta_shape / unit_shape].map(libm::log);
    let coefficients = at.coefficients.iter().copied().chain(at.rate.map(|rate| -rate));
    Ok(Theta {
        coefficients: coefficients.zip(units).map(|(c, unit)| c / unit).collect(),
        logs: [s, eta_v, eta_shape, problem.log_of_own_noise(at.centre / scales.length())],
    })
}

/// The unit of each coefficient; that of a rate is one per time.
pub(super) fn units(problem: &Problem, settings: &Settings, scales: &Scales) -> Vec<f64> {
    let terms = &settings.library.terms;
    let unit = |term: usize| terms.get(term).map_or(1.0 / scales.time, |term| scales.coefficient(term));
    problem.parts.iter().map(|part| unit(part.term)).collect()
}

/// The log-likelihood at these values, with gradient and information.
///
/// # Errors    of the input; a filter that diverges is a value of `None`
/// # Checked by  `tests/all/filter.rs`: exact Gaussian likelihoods, finite differences
pub fn likelihood(tracks: &[Track], settings: &Settings, at: &Parameters) -> Result<Likelihood> {
    let scales = setup::check(tracks, settings)?;
    let problem = match at.rate {
        None => setup::problem(tracks, settings, &scales),
        Some(value) if settings.library.modes == MOST_MODES => {
            let remedy = "take at most three modes, or leave out the rate";
            return Err(Error::Setting { key: "rate", value, remedy });
        }
        Some(_) => memory::problem_with_memory(tracks, settings, &scales),
    };
    let problem = setup::followed(problem, tracks, &scales)?;
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
