//! The place of a fitted model on the paper's diagrams.
//!
//! Time, speed and both modes can be measured in any units (T, V, L2, L3; the radius never enters):
//! `c' = c T prod A_m^degree/A_n`. The units are chosen so that a point of the plane is left; what is left
//! besides it says how far off the diagram's slice the cell is.
//!
//! ```text
//! full plane (Fig. 4)      T = 1/gamma                V^2 = gamma/|d11|       L2 = 2/(|e11| T)   L3 = L2 sqrt(3 e32/(4 e22))
//! reduced plane (Fig. 1)   T = |d11|/(4 |e21 e11|)    V^2 = 1/(|d11| T)       L2 = 2/(|e11| T)   z3 is left out
//! ```
//!
//! Modes that a plane does not have (z3 of the reduced one, z4) are left out with their equations; where they
//! act on the others the cell has no place there.

mod among;
mod scaled;

pub use among::place_among;
use motiform_dynamics::digits::with_error;
use motiform_dynamics::distributions::NORMAL_95;

use crate::{Estimate, Fit, MOST_MODES, Term, identifiability};
use nalgebra::{DMatrix, DVector};
use scaled::{Scaled, scaled};
use serde::{Deserialize, Serialize};

/// A coefficient that sets a unit must be this many standard errors from 0.
const CERTAIN: f64 = 3.0;

/// A plane of the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Plane {
    /// Fig. 4: kappa2 and kappa3; gamma = 1, a1 = -1, b1 = -0.5, b2 = 0.3, d1 = 0.1, d2 = 0.8.
    Full,
    /// Fig. 1: kappa2 and gamma; a1 = 1, b1 = 0.5, b3 = 1, no z3.
    Reduced,
}

impl Plane {
    /// The amplitudes that it has.
    fn modes(self) -> usize {
        match self {
            Self::Full => 3,
            Self::Reduced => 2,
        }
    }

    /// The terms whose coefficients are its coordinates, with their symbols.
    fn coordinates(self) -> [(&'static str, &'static str); 2] {
        match self {
            Self::Full => [("z2: z2", "kappa2"), ("z3: z3", "kappa3")],
            Self::Reduced => [("z2: z2", "kappa2"), ("z1: z1", "gamma")],
        }
    }

    /// Returns `true` if it has no place for a term: the equation, or a factor, is of a mode that it does not
    /// have.
    fn leaves_out(self, term: &Term) -> bool {
        term.equation >= self.modes() || (self.modes()..MOST_MODES).any(|m| term.degree(m) > 0)
    }
}

/// A number in the units of the plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Coordinate {
    /// The paper's name.
    pub name: String,
    /// The value, with errors propagated from all coefficients.
    #[serde(flatten)]
    pub estimate: Estimate,
    /// Its value on the plane's slice; `None` for coordinates of the plane itself.
    pub slice: Option<f64>,
}

/// A place on a plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// The plane.
    pub plane: Plane,
    /// T, V, L2, L3 in the units of the data; `L2` and `L3` have the signs that give e11 and e22 those of the plane.
    pub units: [f64; 4],
    /// Kappa2 and kappa3 (full), or kappa2 and gamma (reduced).
    pub coordinates: [Coordinate; 2],
    /// Covariance of the two.
    pub covariance: [[f64; 2]; 2],
    /// The numbers that are no coordinates, with their values on the slice.
    pub others: Vec<Coordinate>,
    /// Distance off the slice: root of the sum of squares of the others' differences from it.
    pub distance: f64,
    /// The same in standard errors: the largest of them.
    pub deviation: f64,
}

/// A place, or why there is none.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", tag = "answer")]
pub enum Placement {
    /// A place.
    Placed(Box<Place>),
    /// None.
    Refused {
        /// The reasons.
        reasons: Vec<String>,
    },
}

/// The place of a fit on a plane, taking its terms for granted; [`place_among`] asks whether the data settle
/// them.
///
/// # Checked by  `tests/all/place.rs`: known models in other units; refusals
pub fn place(fit: &Fit, plane: Plane) -> Placement {
    let mut reasons = identifiability(fit).reasons;
    reasons.extend(obstacles(fit, plane));
    if !reasons.is_empty() {
        return Placement::Refused { reasons };
    }
    let values: Vec<f64> = fit.coefficients.iter().map(|c| c.estimate.value).collect();
    match scaled(fit, plane, &values) {
        Some(found) => Placement::Placed(Box::new(with_errors(fit, plane, &values, &found))),
        None => Placement::Refused { reasons: vec!["the units of the plane are not defined".to_owned()] },
    }
}

/// The reasons why the units of a plane cannot be used.
fn obstacles(fit: &Fit, plane: Plane) -> Vec<String> {
    let mut reasons = Vec::new();
    if fit.handed {
        reasons.push("the cell is handed: the plane is one of mirror-symmetric bodies".to_owned());
    }
    for &(name, symbol, sign) in scaled::setters(plane) {
        let Some(c) = fit.coefficient(name) else {
            reasons.push(format!("{symbol} ({name}), which sets a unit, is not in the model"));
            continue;
        };
        let (value, error) = (c.estimate.value, c.estimate.error.max(c.estimate.robust));
        if value.abs() < CERTAIN * error {
            reasons.push(format!("{symbol} = {}, which sets a unit, may be 0", with_error(value, error)));
        } else if sign != 0.0 && value * sign < 0.0 {
            let side = if sign < 0.0 { "below" } else { "above" };
            reasons.push(format!("{symbol} = {value:.3}: it must be {side} 0 for this plane"));
        }
    }
    for (name, symbol) in plane.coordinates() {
        if fit.coefficient(name).is_none() {
            reasons.push(format!("{symbol} ({name}), a coordinate of the plane, is not in the model"));
        }
    }
    let of = |name: &str| fit.coefficient(name).map_or(1.0, |c| c.estimate.value);
    if plane == Plane::Full && of("z3: z1 z2") * of("z2: z1* z3") < 0.0 {
        reasons.push("e22 and e32 have opposite signs: no unit of z3 puts them on this plane".to_owned());
    }
    if plane == Plane::Reduced && of("z1: z1* z2") * of("z2: z1^2") > 0.0 {
        reasons.push("a1 b1 is below 0: the plane is that of a1 b1 = 0.5".to_owned());
    }
    reasons.extend(other_modes(fit, plane));
    reasons
}

/// Terms with modes that the plane does not have, in the equations of those that it has.
fn other_modes(fit: &Fit, plane: Plane) -> Option<String> {
    let couples = |c: &&crate::Coefficient| {
        let certain = c.estimate.value.abs() > CERTAIN * c.estimate.error;
        c.term.equation < plane.modes() && plane.leaves_out(&c.term) && certain
    };
    let names: Vec<String> = fit.coefficients.iter().filter(couples).map(|c| c.name.clone()).collect();
    let name = if plane == Plane::Full { "full" } else { "reduced" };
    let reason =
        || format!("the {name} plane has no z{}, the cell has {}", plane.modes() + 1, names.join(", "));
    (!names.is_empty()).then(reason)
}

/// Everything with errors: derivatives by differences of a hundredth of a standard error.
fn with_errors(fit: &Fit, plane: Plane, values: &[f64], found: &Scaled) -> Place {
    let n = values.len();
    let units: Vec<f64> = fit.coefficients.iter().map(|c| fit.scales.coefficient(&c.term)).collect();
    let of = |matrix: &[Vec<f64>]| DMatrix::from_fn(n, n, |i, j| matrix[i][j] * units[i] * units[j]);
    let (covariance, robust) = (of(&fit.natural.covariance), of(&fit.natural.robust));
    let numbers = found.numbers();
    let mut gradients = vec![DVector::zeros(n); numbers.len()];
    for i in 0..n {
        let h = 1e-2 * fit.coefficients[i].estimate.error;
        let at = |by: f64| {
            let mut values = values.to_vec();
            values[i] += by;
            scaled(fit, plane, &values).map(|found| found.numbers())
        };
        if let (true, Some(above), Some(below)) = (h > 0.0, at(h), at(-h)) {
            for (k, gradient) in gradients.iter_mut().enumerate() {
                gradient[i] = (above[k] - below[k]) / (2.0 * h);
            }
        }
    }
    let estimate = |k: usize| {
        let size = |c: &DMatrix<f64>| (gradients[k].dot(&(c * &gradients[k]))).max(0.0).sqrt();
        let (value, error) = (numbers[k], size(&covariance));
        let interval = [value - NORMAL_95 * error, value + NORMAL_95 * error];
        Estimate { value, error, robust: size(&robust), interval }
    };
    let coordinate =
        |k: usize| Coordinate { name: found.names[k].clone(), estimate: estimate(k), slice: found.slices[k] };
    let others: Vec<Coordinate> = (2..numbers.len()).map(coordinate).collect();
    let off = |c: &Coordinate| c.estimate.value - c.slice.unwrap_or(0.0);
    let deviation =
        |c: &Coordinate| if c.estimate.error > 1e-9 { off(c).abs() / c.estimate.error } else { 0.0 };
    let between = |i: usize, j: usize| gradients[i].dot(&(&covariance * &gradients[j]));
    Place {
        plane,
        units: found.units,
        coordinates: [coordinate(0), coordinate(1)],
        covariance: [[between(0, 0), between(0, 1)], [between(1, 0), between(1, 1)]],
        distance: others.iter().map(|c| off(c) * off(c)).sum::<f64>().sqrt(),
        deviation: others.iter().map(deviation).fold(0.0, f64::max),
        others,
    }
}

/// The coordinates on a plane of the fitted model with other values of its coefficients, such as those of
/// [`crate::draws()`]; `None` where a unit of the plane is not defined.
pub fn coordinates(fit: &Fit, plane: Plane, values: &[f64]) -> Option<[f64; 2]> {
    let found = scaled(fit, plane, values)?.numbers();
    Some([found[0], found[1]]).filter(|at| at.iter().all(|x| x.is_finite()))
}
