//! Places at which a level comes to 0 and back within its error.

use super::between::{Step, between};
use super::brackets::{Signs, Test};
use super::correct::TIGHT;
use super::levels::unclear;
use super::locate::kind;
use super::place::Place;
use super::problem::Problem;
use super::special::Special;

/// The first such place on a step. Either branches cross there, or two special points lie closer to each other than can be told.
pub(super) fn touching<P: Problem>(step: &Step<'_, P>, signs: &Signs) -> Vec<(Place<P::Local>, Special)> {
    let first = signs.touches.iter().min_by(|a, b| a.0.total_cmp(&b.0));
    let found = first.and_then(|&(s, test)| {
        let at = between(step, s).ok()?;
        let seen = kind(step, &at, test).name();
        let slopes = [step.old.slope(), at.slope(), step.new.slope()].map(f64::abs);
        let parameter = step.problem.weights(&at.x).last().map_or(f64::NAN, |weight| 1.0 / weight.sqrt());
        let within = width(step, (&at, s), test) * slopes.into_iter().fold(0.0, f64::max)
            + step.problem.accuracy().max(TIGHT) * parameter;
        Some((at, Special::Touch { seen, within }))
    });
    found.into_iter().collect()
}

/// The length on both sides over which a level that vanishes as the square of the distance is within its error.
fn width<P: Problem>(step: &Step<'_, P>, (at, s): (&Place<P::Local>, f64), test: Test) -> f64 {
    let far = if s < 0.5 * step.length { (step.new, step.length - s) } else { (step.old, s) };
    let part = unclear(step.problem, &at.levels).max(test.of(at).abs()) / test.of(far.0).abs();
    far.1 * part.sqrt()
}
