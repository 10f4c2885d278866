//! The test that left and right are different motions: real coefficients against complex ones.

use crate::filter::{NO_CENTRE_NOISE, Theta};
use crate::fit::{reached, refit, refit_within};
use crate::{Coefficient, Error, Fit, Result, Settings, Track, identifiability, observation, whiteness};
use motiform_dynamics::Watch;
use motiform_dynamics::distributions::{NORMAL_95, chi_square_tail};
use motiform_dynamics::sample::sort_by_number;
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

/// Rate at which mirror-symmetric cells may be called handed: rare enough for a thousand cells.
pub const HANDED_RATE: f64 = 1e-4;
/// Rate at which the test may be left undecided by chance: from here to [`HANDED_RATE`] neither is said.
pub const DOUBTED_RATE: f64 = 0.01;

/// Significance of innovations that are not white from which on a fit describes the cell too badly to tell left from right.
pub const COLOURED: f64 = 1e-6;

/// Size of an imaginary part, relative to the largest coefficient of its equation (natural units), that the
/// intervals of a mirror-symmetric cell exclude.
pub const SEEN: f64 = 0.1;

motiform_dynamics::named! {
    /// The answer to whether the law of a cell has a mirror symmetry.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "snake_case")]
    pub enum Symmetry by name {
        /// Real coefficients are enough, and the 95 % interval of every imaginary part excludes the size [`SEEN`]: it would have been seen.
        Mirror = "mirror symmetric",
        /// Real coefficients are rejected.
        Handed = "handed",
        /// Real coefficients are enough, but imaginary parts of the size [`SEEN`] are within their intervals: not
        /// decidable; or the likelihood ratio is between [`HANDED_RATE`] and [`DOUBTED_RATE`].
        Undecided = "not decidable",
    }
}

impl Handedness {
    /// Returns `true` if the likelihood ratio speaks against mirror symmetry: exceeded in less than
    /// [`DOUBTED_RATE`] of mirror-symmetric cells.
    pub fn is_doubted(&self) -> bool {
        self.p_value < DOUBTED_RATE
    }

    /// The imaginary parts that the intervals exclude, as a clause.
    pub fn excluded_parts(&self) -> String {
        if !(self.excluded > 0.0 && self.excluded < 1.0) {
            return "imaginary parts as large as the coefficients themselves are not excluded".to_owned();
        }
        format!(
            "imaginary parts above {:.0} % of the largest coefficient of their equation are excluded",
            100.0 * self.excluded
        )
    }
}

/// The comparison of a real model with a complex one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Handedness {
    /// The answer.
    pub symmetry: Symmetry,
    /// Twice the gain of log-likelihood by imaginary parts.
    pub ratio: f64,
    /// Their number.
    pub degrees: usize,
    /// Probability of such a ratio in a mirror-symmetric cell (chi-square).
    pub p_value: f64,
    /// The same of the squares of the imaginary parts over their robust covariance (Wald): errors with heavy
    /// tails, or with memory, raise the ratio and not this.
    #[serde(default)]
    pub robust_p_value: f64,
    /// Imaginary parts above this are excluded: the largest end of a 95 % interval of one, relative to the
    /// largest coefficient of its equation, natural units.
    #[serde(default)]
    pub excluded: f64,
    /// Difference of Schwarz's criterion, `degrees ln(n N) - ratio` with n = 6 numbers a frame (8 with z4):
    /// below 0 it prefers the handed model.
    pub bic: f64,
    /// Imaginary parts more than three standard errors from 0, the most certain first.
    pub parts: Vec<Coefficient>,
    /// The handed model.
    pub fit: Fit,
}

/// Compares a mirror-symmetric fit with the handed model of the same terms, by likelihood ratio.
///
/// Give the fit of selected terms ([`crate::select`]): with fewer imaginary parts the test sees smaller ones.
/// A cell is called handed where the ratio is exceeded in less than [`HANDED_RATE`] of mirror-symmetric
/// cells, and so is the Wald statistic with robust errors; mirror symmetric where it is exceeded in [`DOUBTED_RATE`] of them and more,
/// and the intervals of all imaginary parts exclude the size [`SEEN`]: a large p-value alone is no evidence of symmetry. Beside a fit that
/// did not converge nothing is decided, and no handed model is searched for: ratio and p-values say nothing.
///
/// # Errors    of the input; [`Error::Setting`] if `fit` is handed itself
/// # Checked by  `tests/all/handed.rs`: rate of false alarms, a handed cell
pub fn handedness(tracks: &[Track], fit: &Fit, watch: &dyn Watch) -> Result<Handedness> {
    observation::check(tracks, fit.library.modes)?;
    if fit.handed {
        return Err(Error::Setting {
            key: "handed",
            value: 1.0,
            remedy: "give a fit with real coefficients",
        });
    }
    let settings = Settings { library: fit.library.clone(), handed: true, starts: Vec::new() };
    let mut coefficients = fit.natural.coefficients.clone();
    let degrees = coefficients.len();
    coefficients.resize(2 * degrees, 0.0);
    let start = Theta { coefficients, logs: fit.natural.logs };
    let near = match fit.converged() {
        true => refit(tracks, &settings, &fit.scales, &start, watch)?,
        // decides nothing, whatever is promised
        false => refit_within(tracks, &settings, &fit.scales, &start, f64::INFINITY, 1, watch)?,
    };
    let coloured = whiteness(fit).iter().any(|channel| channel.p_value < COLOURED);
    if coloured || !fit.converged() {
        return Ok(compare(fit, near, degrees)); // decides nothing, and a second search would not either
    }
    let logs = [0.0, libm::log(0.4), libm::log(0.4), NO_CENTRE_NOISE];
    let zero = Theta { coefficients: vec![0.0; 2 * degrees], logs };
    // from far away, to the end only where first steps lead higher: their model then promises less than 1
    let (far, height) = reached(tracks, &settings, &fit.scales, &zero, 1.0, watch)?;
    if height.is_some_and(|height| height <= near.log_likelihood) {
        return Ok(compare(fit, near, degrees));
    }
    let far = refit(tracks, &settings, &fit.scales, &far, watch)?;
    let handed = if far.log_likelihood > near.log_likelihood { far } else { near };
    Ok(compare(fit, handed, degrees))
}

fn compare(fit: &Fit, handed: Fit, degrees: usize) -> Handedness {
    let ratio = (2.0 * (handed.log_likelihood - fit.log_likelihood)).max(0.0);
    let p_value = chi_square_tail(ratio, degrees as f64);
    let numbers = (fit.observed() * fit.frames.max(1)) as f64;
    let certainty = |c: &Coefficient| c.estimate.value.abs() / c.estimate.error.max(f64::MIN_POSITIVE);
    let mut parts: Vec<Coefficient> =
        handed.coefficients.iter().filter(|c| c.imaginary && certainty(c) > 3.0).cloned().collect();
    sort_by_number(&mut parts, |a| -certainty(a));
    let excluded = excluded(&handed);
    let robust_p_value = chi_square_tail(wald(&handed), degrees as f64);
    let symmetry = match identifiability(&handed).identifiable && fit.converged() {
        _ if p_value.max(robust_p_value) < HANDED_RATE && handed.converged() && fit.converged() => {
            Symmetry::Handed
        }
        true if p_value >= DOUBTED_RATE && excluded < SEEN => Symmetry::Mirror,
        _ => Symmetry::Undecided,
    };
    let bic = degrees as f64 * libm::log(numbers) - ratio;
    Handedness { symmetry, ratio, degrees, p_value, robust_p_value, excluded, bic, parts, fit: handed }
}

/// `c^T R^-1 c` of all imaginary parts c with robust covariance R; 0 where R has no inverse.
fn wald(handed: &Fit) -> f64 {
    let all = 0..handed.coefficients.len();
    let places: Vec<usize> = all.filter(|&i| handed.coefficients[i].imaginary).collect();
    let n = places.len();
    let robust = DMatrix::from_fn(n, n, |i, j| handed.natural.robust[places[i]][places[j]]);
    let parts = DVector::from_fn(n, |i, _| handed.natural.coefficients[places[i]]);
    robust.cholesky().map_or(0.0, |factor| parts.dot(&factor.solve(&parts)))
}

/// The largest end of an interval of an imaginary part, relative to the largest coefficient of its equation,
/// in natural units; infinite where an equation has none.
fn excluded(handed: &Fit) -> f64 {
    let natural = |c: &Coefficient| handed.scales.coefficient(&c.term).abs();
    let largest = |equation: usize| {
        let own = handed.coefficients.iter().filter(|c| c.term.equation == equation);
        own.map(|c| c.estimate.value.abs() / natural(c)).fold(0.0, f64::max)
    };
    let end = |c: &Coefficient| {
        let error = c.estimate.error.max(c.estimate.robust);
        (c.estimate.value.abs() + NORMAL_95 * error) / natural(c) / largest(c.term.equation)
    };
    handed.coefficients.iter().filter(|c| c.imaginary).map(end).fold(0.0, f64::max)
}
