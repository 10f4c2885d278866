//! A place that does not depend on which of the equally good sets of terms is taken.

use super::{NORMAL_95, Placement, Plane, place, scaled::scaled};
use crate::subsets::Conditional;
use crate::{EquationKnowledge, Fit, Knowledge, Selection, identifiability};

/// Share of the weight of all sets that must agree.
const AGREE: f64 = 0.9;

/// The place of a cell on a plane: that of the best set of terms, if other sets that the data do not tell
/// apart agree.
///
/// Sets are weighted with `exp(-excess/2)` (Schwarz's criterion as a likelihood); each is placed with the
/// estimates that remain of `whole` when its missing terms are set to 0. A set agrees if both its coordinates
/// are within the 95 % intervals of the best one, each extended by that of the set's own scatter (a tenth of
/// the unit). Less than 90 % of the weight is a refusal, and so is an equation with more terms than the
/// motion fixes combinations of all coefficients.
#[must_use]
pub fn place_among(whole: &Fit, selection: &Selection, plane: Plane) -> Placement {
    let placed = match place(&selection.fit, plane) {
        Placement::Placed(placed) => placed,
        refused @ Placement::Refused { .. } => return refused,
    };
    let reasons = unsettled(whole, selection);
    if !reasons.is_empty() {
        return Placement::Refused { reasons };
    }
    let centre = [0, 1].map(|i| placed.coordinates[i].estimate);
    let (mut agreeing, mut all) = (0.0, 0.0);
    for set in &selection.subsets.ties {
        let weight = libm::exp(-0.5 * set.excess);
        all += weight;
        let agrees = coordinates(whole, &set.kept, plane).is_some_and(|at| {
            (0..2).all(|i| (at[i] - centre[i].value).abs() <= NORMAL_95 * centre[i].error + 0.1)
        });
        agreeing += if agrees { weight } else { 0.0 };
    }
    if all > 0.0 && agreeing < AGREE * all {
        let reason = format!(
            "{} sets of terms are as good as the best; only {:.1} % of their weight lies at its place",
            selection.subsets.ties.len(),
            100.0 * agreeing / all
        );
        return Placement::Refused { reasons: vec![reason] };
    }
    Placement::Placed(placed)
}

/// Equations of which the motion fixes fewer combinations than the best set has terms.
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
    known.iter().filter_map(of).collect()
}

/// The coordinates of a set of the whole fit's coefficients.
fn coordinates(whole: &Fit, kept: &[usize], plane: Plane) -> Option<[f64; 2]> {
    let mut rest = Conditional::new(&whole.natural.coefficients, whole.covariance());
    (0..whole.coefficients.len()).filter(|i| !kept.contains(i)).for_each(|i| rest.drop(i));
    let unit = |i: usize| whole.scales.coefficient(&whole.coefficients[i].term);
    let values: Vec<f64> = (0..whole.coefficients.len()).map(|i| rest.estimates[i] * unit(i)).collect();
    let found = scaled(whole, plane, &values)?;
    Some([found.values[0], found.values[1]])
}
