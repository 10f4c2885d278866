//! The zero of a test on a step.

use super::between::{APART, Step, between};
use super::brackets::{Bracket, Test};
use super::place::Place;
use super::point::Obstruction;
use super::problem::{Failure, Problem};

/// Most solutions on the way to a special point.
const TRIES: usize = 60;

/// After so many solutions the bracket is halved, unless they have done so.
const PATIENCE: usize = 4;

/// Least part of the values at both ends of a bracket that is not 0.
const VANISHING: f64 = 0.1;

/// Returns `true` if a test is small on both sides of `s`. Over a gap between two branches it changes its sign without passing 0. (Next to
/// a crossing the slope is that of round-off: then the sides tell.)
fn vanishes_beside<P: Problem>(step: &Step<'_, P>, (test, s, scale): (Test, f64, f64)) -> bool {
    let small = |side: f64| {
        let at = between(step, s + side * APART * step.length);
        at.is_ok_and(|at| test.of(&at).abs() <= VANISHING * scale)
    };
    small(-1.0) && small(1.0)
}

/// False position that stands still has not converged while its bracket is wider than this part of the step and the test above this part of
/// its values at the ends: the zero may be a multiple one.
const WIDE: f64 = 1e-6;
const MULTIPLE: f64 = 1e-9;

/// The part of the values at the ends of a bracket below which a test vanishes where its zero is a multiple one.
const FLAT: f64 = 1e-6;

/// The solution at which the test vanishes, by false position (the Illinois variant): every iterate is a solution of the equations.
pub(super) fn solve<P: Problem>(
    step: &Step<'_, P>,
    &Bracket { test, mut low, mut high }: &Bracket,
) -> Result<Place<P::Local>, Failure> {
    let scale = low.1.abs().max(high.1.abs());
    let (mut kept_high, mut last) = (None, f64::INFINITY);
    let (mut width, mut stalled, mut nearest) = (high.0 - low.0, false, None);
    for count in 1..=TRIES {
        let false_position = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
        // towards a multiple zero false position slows down
        let slow =
            count % PATIENCE == 0 && high.0 - low.0 > 0.5 * std::mem::replace(&mut width, high.0 - low.0);
        let slow = slow || std::mem::take(&mut stalled);
        let s = if slow { 0.5 * (low.0 + high.0) } else { false_position };
        let at = between(step, s)?;
        let value = test.of(&at);
        if value.abs() <= 1e-12 * scale {
            return Ok(at);
        }
        let is_wide = high.0 - low.0 > WIDE * step.length && value.abs() > MULTIPLE * scale;
        stalled = (s - last).abs() <= 1e-10 * step.length;
        if stalled && !is_wide {
            let vanishes = value.abs() <= VANISHING * scale || vanishes_beside(step, (test, s, scale));
            return if vanishes { Ok(at) } else { Err(Failure::Obstructed(Obstruction::Newton)) };
        }
        last = s;
        if value * low.1 > 0.0 {
            low = (s, value);
            high.1 *= if kept_high == Some(true) { 0.5 } else { 1.0 };
            kept_high = Some(true);
        } else {
            high = (s, value);
            low.1 *= if kept_high == Some(false) { 0.5 } else { 1.0 };
            kept_high = Some(false);
        }
        nearest = (value.abs() <= FLAT * scale).then_some(at);
    }
    nearest.ok_or(Failure::Obstructed(Obstruction::Newton))
}
