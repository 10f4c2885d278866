//! A place that does not depend on which of the equally good sets of terms is taken.

use super::{Place, Placement, Plane, place, scaled::scaled, scaled::setters};
use crate::subsets::{Conditional, Mixture, Scatter, over_sets};
use crate::{EquationKnowledge, Estimate, Fit, Knowledge, Selection, identifiability};
use nalgebra::DVector;

/// Share of the weight of all sets in whose units the plane must be defined.
const DEFINED: f64 = 0.9;

/// The place of a cell on a plane, over all sets of terms that the data do not tell apart.
///
/// As of [`crate::averaged`]: the mean, the standard deviation, and the 2.5 % and 97.5 % quantiles of the
/// mixture over all tied sets, each with the weight `exp(-excess/2)` and the estimates and errors that it has
/// from the fit with all terms. A set without a term that a coordinate needs counts with the term added.
/// Where sets disagree the interval holds their places. Units, and what is off the slice, are those of the best set.
///
/// Refused like [`place`] of the best set; where a unit of the plane is not defined in more than a tenth of
/// the weight; where an equation has more terms than the motion fixes combinations of all coefficients; and
/// where the fit with all terms did not converge.
///
/// # Checked by  `tests/all/place.rs`: draws from fits of tied sets; zigzags whose best set lacks a term
pub fn place_among(whole: &Fit, selection: &Selection, plane: Plane) -> Placement {
    let mut placed = match place(&selection.fit, plane) {
        Placement::Placed(placed) => placed,
        refused @ Placement::Refused { .. } => return refused,
    };
    let reasons = unsettled(whole, selection);
    if !reasons.is_empty() {
        return Placement::Refused { reasons };
    }
    let parts = of_sets(whole, selection, plane);
    let weight = |parts: &[(f64, Option<Located>)]| parts.iter().map(|part| part.0).sum::<f64>();
    let all = weight(&parts);
    let parts: Vec<(f64, Located)> =
        parts.into_iter().filter_map(|(weight, at)| Some((weight, at?))).collect();
    let defined: f64 = parts.iter().map(|part| part.0).sum();
    if defined < DEFINED * all || parts.is_empty() {
        let reason = format!(
            "{} sets of terms are as good as the best; only in {:.1} % of their weight the units of the plane are defined",
            selection.subsets.ties.len(),
            100.0 * defined / all
        );
        return Placement::Refused { reasons: vec![reason] };
    }
    mix(&mut placed, &parts);
    Placement::Placed(placed)
}

/// Equations of which the motion fixes fewer combinations than the best set has terms, and a fit with all terms that is no maximum.
fn unsettled(whole: &Fit, selection: &Selection) -> Vec<String> {
    let known = identifiability(whole).equations;
    let of = |of: &EquationKnowledge| {
        let terms = selection.fit.library.of_equation(of.equation).len();
        let fixed = of.combinations.len() - of.count(Knowledge::Free);
        let name = of.equation + 1;
        (fixed < terms).then(|| {
            format!("the motion fixes {fixed} combinations of the equation of z{name}, fewer than its {terms} terms")
        })
    };
    let ended = (!whole.converged())
        .then(|| "the fit with all terms did not converge: which sets are as good is not known".to_owned());
    known.iter().filter_map(of).chain(ended).collect()
}

/// The coordinates of one set, normally distributed.
struct Located {
    at: [f64; 2],
    covariance: [[f64; 2]; 2],
    robust: [f64; 2],
}

/// The coordinates of every tied set, with its weight; `None` where the units of the plane are not defined.
fn of_sets(whole: &Fit, selection: &Selection, plane: Plane) -> Vec<(f64, Option<Located>)> {
    let names = setters(plane).iter().map(|one| one.0).chain(plane.coordinates().map(|one| one.0));
    let place = |name| whole.coefficients.iter().position(|c| c.name == name && !c.imaginary);
    let needed: Vec<usize> = names.filter_map(place).collect();
    let scatter = Scatter::of(whole);
    over_sets(whole, &selection.subsets, &needed, |set| located(whole, plane, set, &scatter))
}

/// The coordinates with errors to first order: derivatives by differences of a hundredth of a standard error.
fn located(whole: &Fit, plane: Plane, set: &Conditional, scatter: &Scatter) -> Option<Located> {
    let n = whole.coefficients.len();
    let units: Vec<f64> = whole.coefficients.iter().map(|c| whole.scales.coefficient(&c.term)).collect();
    let at = |moved: Option<(usize, f64)>| {
        let natural =
            |i: usize| set.estimates[i] + moved.map_or(0.0, |(k, by)| if k == i { by } else { 0.0 });
        let values: Vec<f64> = (0..n).map(|i| natural(i) * units[i]).collect();
        let found = scaled(whole, plane, &values)?.values;
        Some([found[0], found[1]])
    };
    let middle = at(None)?;
    let mut gradients = [DVector::zeros(n), DVector::zeros(n)];
    for i in 0..n {
        let h = 1e-2 * set.covariance[(i, i)].max(0.0).sqrt();
        if let (true, Some(above), Some(below)) = (h > 0.0, at(Some((i, h))), at(Some((i, -h)))) {
            (0..2).for_each(|k| gradients[k][i] = (above[k] - below[k]) / (2.0 * h));
        }
    }
    let carried = [0, 1].map(|k| &set.covariance * &gradients[k]);
    let mut covariance = [0, 1].map(|i| [0, 1].map(|j| gradients[i].dot(&carried[j])));
    let robust = [0, 1].map(|k| scatter.error(&carried[k], covariance[k][k]));
    // the larger one of both errors, as for coefficients; the correlation stays
    let larger = [0, 1].map(|k| (robust[k] / covariance[k][k].max(f64::MIN_POSITIVE).sqrt()).max(1.0));
    (0..2).for_each(|i| (0..2).for_each(|j| covariance[i][j] *= larger[i] * larger[j]));
    let finite = middle.iter().chain(covariance.iter().flatten()).all(|x| x.is_finite());
    finite.then_some(Located { at: middle, covariance, robust })
}

/// Gives a place the coordinates of the mixture.
fn mix(placed: &mut Place, parts: &[(f64, Located)]) {
    let mixture = |i: usize, error: &dyn Fn(&Located) -> f64| {
        Mixture::new(parts.iter().map(|(weight, one)| [*weight, one.at[i], error(one)]).collect())
    };
    let own = [0, 1].map(|i| mixture(i, &|one| one.covariance[i][i].max(0.0).sqrt()));
    for (i, own) in own.iter().enumerate() {
        let robust = mixture(i, &|one| one.robust[i]).deviation();
        let (value, error, interval) = (own.mean(), own.deviation(), own.interval());
        placed.coordinates[i].estimate = Estimate { value, error, robust, interval };
    }
    let all: f64 = parts.iter().map(|part| part.0).sum();
    let between = |one: &Located| (one.at[0] - own[0].mean()) * (one.at[1] - own[1].mean());
    let mixed =
        parts.iter().map(|(weight, one)| weight / all * (one.covariance[0][1] + between(one))).sum::<f64>();
    let [first, second] = [0, 1].map(|i| own[i].deviation() * own[i].deviation());
    placed.covariance = [[first, mixed], [mixed, second]];
}
