//! A stay at an unstable equilibrium. Only an orbit of exact symmetry never leaves it.

use super::settings::Settings;

/// The logarithm of the ratio of the largest to the smallest positive double, rounded up: a deviation of any size along a growing
/// direction has grown to the size of the shape after this time over the growth rate.
const EVERY_DEVIATION: f64 = 1500.0;

/// The logarithm of the shape's size over its round-off.
const ROUND_OFF: f64 = 37.0;

/// The time that an orbit has spent at one unstable equilibrium.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Stay {
    time: f64,
}

impl Stay {
    /// Takes in a look that ended there: it lasted for `span`, and the shape was still all the time or not. Whether the orbit
    /// will never leave: every deviation that a number can hold would have grown (at the rate `growth`) and been seen.
    pub(super) fn goes_on(&mut self, span: f64, still: bool, growth: f64) -> bool {
        self.time = if still { self.time + span } else { 0.0 };
        growth * self.time > EVERY_DEVIATION
    }

    /// The model time to spend on a motion that rests here at time `now`: three rests limited by round-off, if they take longer than the
    /// budget, but at most four budgets.
    pub(super) fn budget(self, settings: &Settings, now: f64, growth: f64) -> f64 {
        (now + 3.0 * ROUND_OFF / growth).min(4.0 * settings.budget)
    }

    /// Model time of the stay so far.
    pub(super) fn time(self) -> f64 {
        self.time
    }
}
