//! The leading coefficient of the normal form at a special point, as exact as its place.

use super::between::{Step, between};
use super::normal_form::{NormalForm, asked};
use super::place::Place;
use super::problem::Problem;
use super::special::Special;

/// Part of the step by which the coefficient is computed beside the point: there the direction is still critical.
const BESIDE: f64 = 1e-5;

/// The leading coefficient of the normal form at a special point whose parameter has this error. Where branches cross the coefficient may
/// vanish at the place itself: its error has what it changes over that of the place.
pub(super) fn leading_coefficient<P: Problem>(
    step: &Step<'_, P>,
    at: &Place<P::Local>,
    special: Special,
    error: f64,
) -> Option<NormalForm> {
    let (order, doubled) = asked(special)?;
    let found = step.problem.normal_form(&at.x, order, doubled);
    let change = || {
        let beside =
            if at.arclength < 0.5 * (step.old.arclength + step.new.arclength) { BESIDE } else { -BESIDE };
        let near = between(step, at.arclength - step.old.arclength + beside * step.length).ok()?;
        let other = step.problem.normal_form(&near.x, order, doubled);
        let same = std::mem::discriminant(&found) == std::mem::discriminant(&other);
        // the sign of a coefficient of second order is free
        let by = other.coefficient()?.value.abs() - found.coefficient()?.value.abs();
        let change = (by / (near.parameter() - at.parameter()) * error).abs();
        (same && change.is_finite()).then_some(change)
    };
    let change = if special == Special::BranchPoint { change() } else { None };
    Some(change.map_or(found, |change| found.widened(change)))
}
