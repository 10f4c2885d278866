//! The result of a fit, in the units of the data.

use super::optimise::{Ending, Point, at_bounds, prior};
use super::{Settings, covariance, likelihood};
use crate::filter::{NOISES, Problem, Theta};
use crate::{Library, Scales, Term};
use motiform_dynamics::distributions::NORMAL_95;
use nalgebra::DMatrix;
use serde::{Deserialize, Deserializer, Serialize};

/// An estimate with its errors.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// The value.
    pub value: f64,
    /// Standard error from the expected information.
    pub error: f64,
    /// Standard error from the scatter of the scores (sandwich): larger where the noise is not white.
    pub robust: f64,
    /// 95 % interval from `error`; an end at infinity is `null` in JSON.
    #[serde(deserialize_with = "ends")]
    pub interval: [f64; 2],
}

/// The ends of an interval, of which the lower one may be negative infinity and the upper one infinity.
fn ends<'d, D: Deserializer<'d>>(from: D) -> Result<[f64; 2], D::Error> {
    let [low, high] = <[Option<f64>; 2]>::deserialize(from)?;
    Ok([low.unwrap_or(f64::NEG_INFINITY), high.unwrap_or(f64::INFINITY)])
}

/// A fitted coefficient of one term: its real or its imaginary part, with its error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Coefficient {
    /// The term's name, `z1: z1* z2`.
    pub name: String,
    /// The term.
    pub term: Term,
    /// `true` if this is the imaginary part of its factor.
    pub imaginary: bool,
    /// The estimate, in the units of the data.
    #[serde(flatten)]
    pub estimate: Estimate,
}

/// Standard errors of a variance that a normal number exceeds with a probability of 1e-4.
const OF_CENTRE: f64 = 3.72;

/// The noise. Intervals are on the logarithm, that of the centre on its variance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Noise {
    /// Factor of the stated errors of the observations.
    pub s: Estimate,
    /// Process noise of the velocity.
    pub eta_v: Estimate,
    /// Process noise of the shape.
    pub eta_shape: Estimate,
    /// Standard deviation of each coordinate of the centre beside the error of its contour, such as a jitter
    /// of the images (length); 0 where none is seen.
    pub centre: Estimate,
    /// `true` for each that is at a bound of the search: then only the bound is known.
    pub at_bound: [bool; NOISES],
}

/// The estimates in natural units: what further computations start from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Natural {
    /// Coefficients.
    pub coefficients: Vec<f64>,
    /// Logarithms of `s`, `eta_v`, `eta_shape`, and of the centre's own noise in tenths of the stated error and above.
    pub logs: [f64; NOISES],
    /// Expected information of all parameters.
    pub information: Vec<Vec<f64>>,
    /// Its inverse.
    pub covariance: Vec<Vec<f64>>,
    /// The sandwich covariance.
    pub robust: Vec<Vec<f64>>,
    /// Of several cells, how they differ: see [`Fit::with_cells`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cells: Option<CellScatter>,
}

/// The covariance of coefficients that whole cells give as units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CellScatter {
    /// Number of cells.
    pub cells: usize,
    /// The covariance, in natural units.
    pub covariance: Vec<Vec<f64>>,
    /// Factor of standard errors in an interval, as they come from few cells: the quotient of Student's and the normal quantile.
    pub factor: f64,
}

/// A fitted model: its terms with their coefficients and the noise, and how well these are known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fit {
    /// The terms.
    pub library: Library,
    /// `true` if coefficients are complex.
    pub handed: bool,
    /// Coefficients in the units of the data; for handed models all real parts, then all imaginary parts.
    pub coefficients: Vec<Coefficient>,
    /// The noise.
    pub noise: Noise,
    /// Maximum of the log-likelihood, of the observations in the units of the data.
    pub log_likelihood: f64,
    /// Frames that have a likelihood.
    pub frames: usize,
    /// The ending of the search.
    pub ending: Ending,
    /// The natural units.
    pub scales: Scales,
    /// The estimates in natural units, with covariances.
    pub natural: Natural,
    /// Standardised innovations of each stretch of frames: standard normal deviates, if the model is right.
    pub innovations: Vec<Vec<Vec<f64>>>,
}

impl Fit {
    /// Numbers observed in each frame that were fitted: twice the number of amplitudes.
    pub(crate) fn observed(&self) -> usize {
        2 * self.library.modes
    }

    /// Returns `true` if the search converged.
    pub fn converged(&self) -> bool {
        matches!(self.ending, Ending::Converged { .. })
    }

    /// Returns `true` if the data bound all coefficients: none is above 10 in natural units, where they are
    /// of order 1.
    pub fn is_bounded(&self) -> bool {
        crate::identifiability::unbounded(self).is_empty()
    }

    /// The estimate of a term's real coefficient, if the term is in the model.
    pub fn coefficient(&self, name: &str) -> Option<&Coefficient> {
        self.coefficients.iter().find(|c| c.name == name && !c.imaginary)
    }

    /// The covariance of the coefficients in natural units.
    pub(crate) fn covariance(&self) -> DMatrix<f64> {
        let n = self.coefficients.len();
        DMatrix::from_fn(n, n, |i, j| self.natural.covariance[i][j])
    }

    /// The covariance of the coefficients in the units of the data, from the expected information, in the order of [`Fit::coefficients`].
    pub fn covariance_of_coefficients(&self) -> Vec<Vec<f64>> {
        let units: Vec<f64> = self.coefficients.iter().map(|c| self.scales.coefficient(&c.term)).collect();
        let row = |(row, a): (&Vec<f64>, &f64)| row.iter().zip(&units).map(|(x, b)| x * a * b).collect();
        self.natural.covariance.iter().zip(&units).map(row).collect()
    }

    /// Its parameters in natural units.
    pub(crate) fn theta(&self) -> Theta {
        Theta { coefficients: self.natural.coefficients.clone(), logs: self.natural.logs }
    }

    /// Its values in the units of the data.
    pub fn parameters(&self) -> super::Parameters {
        let noise = &self.noise;
        super::Parameters {
            coefficients: self.coefficients.iter().map(|c| c.estimate.value).collect(),
            s: noise.s.value,
            eta_v: noise.eta_v.value,
            rate: None,
            eta_shape: noise.eta_shape.value,
            centre: noise.centre.value,
        }
    }
}

impl Noise {
    /// Returns `true` if the centre has a noise of its own: its variance is above 0 by so many of its errors that none of a thousand cells
    /// without one has that by chance. The error of the variance c^2 is 2 c times that of c. Where the factor of the stated errors is at a
    /// bound or not known within a half, the errors of the contour are not told from it.
    pub fn is_of_centre(&self) -> bool {
        let contour = !self.at_bound[0] && self.s.error < 0.5 * self.s.value;
        contour && self.centre.value > 2.0 * OF_CENTRE * self.centre.error
    }
}

fn rows(matrix: &DMatrix<f64>) -> Vec<Vec<f64>> {
    (0..matrix.nrows()).map(|i| matrix.row(i).iter().copied().collect()).collect()
}

pub(super) fn make(problem: &Problem, settings: &Settings, scales: &Scales, point: &Point) -> Fit {
    let (theta, kept) = (&point.theta, &point.evaluation);
    let mut held = vec![false; problem.len()];
    held[problem.parts.len()..].copy_from_slice(&at_bounds(theta));
    let covariance = covariance::inverse(&kept.information, &held);
    let robust = covariance::sandwich(&covariance, &kept.scores);
    let natural = Natural {
        coefficients: theta.coefficients.clone(),
        logs: theta.logs,
        information: rows(&kept.information),
        covariance: rows(&covariance),
        robust: rows(&robust),
        cells: None,
    };
    let units = likelihood::units(problem, settings, scales);
    Fit {
        library: settings.library.clone(),
        handed: settings.handed,
        coefficients: coefficients(problem, settings, &natural, &units),
        noise: noise(problem, point, &natural, scales),
        log_likelihood: kept.value + prior(theta) + problem.frames() as f64 * scales.log_density(),
        frames: problem.frames(),
        ending: point.ending.clone(),
        scales: scales.clone(),
        natural,
        innovations: kept.innovations.clone(),
    }
}

fn coefficients(
    problem: &Problem,
    settings: &Settings,
    natural: &Natural,
    units: &[f64],
) -> Vec<Coefficient> {
    let one = |i: usize| {
        let part = problem.parts[i];
        let term = settings.library.terms[part.term].clone();
        let value = natural.coefficients[i] * units[i];
        let size = |covariance: &[Vec<f64>]| covariance[i][i].max(0.0).sqrt() * units[i];
        let error = size(&natural.covariance);
        let interval = [value - NORMAL_95 * error, value + NORMAL_95 * error];
        let estimate = Estimate { value, error, robust: size(&natural.robust), interval };
        Coefficient { name: term.name(), term, imaginary: part.imaginary, estimate }
    };
    (0..units.len()).map(one).collect()
}

fn noise(problem: &Problem, point: &Point, natural: &Natural, scales: &Scales) -> Noise {
    let first = natural.coefficients.len();
    let units = [1.0, scales.noise()[0], scales.noise()[1]];
    let [s, eta_v, eta_shape] = std::array::from_fn(|i| {
        let value = libm::exp(natural.logs[i]) * units[i];
        let size = |covariance: &[Vec<f64>]| covariance[first + i][first + i].max(0.0).sqrt();
        let error = size(&natural.covariance);
        let interval = [-NORMAL_95, NORMAL_95].map(|x| value * libm::exp(x * error));
        Estimate { value, error: value * error, robust: value * size(&natural.robust), interval }
    });
    let [variance, by_log] = problem.own_noise(&point.theta);
    let size = |covariance: &[Vec<f64>]| covariance[first + 3][first + 3].max(0.0).sqrt();
    // sigma = sqrt(c): its error is that of the logarithm times dc/dl / (2 sigma)
    let value = variance.sqrt() * scales.length();
    let slope = if variance > 0.0 { 0.5 * by_log / variance } else { 0.0 };
    let [error, robust] = [&natural.covariance, &natural.robust].map(|of| value * slope * size(of));
    let interval = [-NORMAL_95, NORMAL_95].map(|x| (value * (value + 2.0 * x * error)).max(0.0).sqrt());
    let centre = Estimate { value, error, robust, interval };
    Noise { s, eta_v, eta_shape, centre, at_bound: at_bounds(&point.theta) }
}
