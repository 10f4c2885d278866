//! The time of one lane with fixed steps.

use crate::orbit::fixed_step;

/// Multiples of the step from an origin, as in [`crate::Orbit`]: times carry no accumulated rounding.
#[derive(Clone, Copy, Default)]
pub(super) struct Clock {
    pub(super) t: f64,
    pub(super) t_end: f64,
    origin: (f64, u64),
    pub(super) steps: u64,
}

impl Clock {
    pub(super) fn new(t: f64, t_end: f64) -> Self {
        Self { t, t_end, origin: (t, 0), steps: 0 }
    }

    /// How many whole steps there are before the end, at most `most`.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a count, and not above `most`"
    )]
    pub(super) fn whole_steps(&self, step: f64, most: u64) -> u64 {
        let (start, count) = self.origin;
        let left = ((self.t_end - start) / step - count as f64).floor() - 1.0;
        if self.t != start + step * count as f64 { 0 } else { left.clamp(0.0, most as f64) as u64 }
    }

    /// End and size of the next step, which ends at the end of the span at the latest.
    #[inline(always)]
    pub(super) fn next(&self, step: f64) -> (f64, f64) {
        fixed_step(step, self.t, self.origin, self.t_end)
    }

    /// Goes on by one step; its size.
    #[inline(always)]
    pub(super) fn step(&mut self, step: f64) -> f64 {
        let (t, h) = self.next(step);
        let (start, count) = self.origin;
        self.origin = if t == self.t_end { (t, 0) } else { (start, count + 1) };
        self.t = t;
        self.steps += 1;
        h
    }

    /// Goes on by `count` whole steps, no more than there are ([`Clock::whole_steps`]).
    #[inline(always)]
    pub(super) fn jump(&mut self, step: f64, count: u64) {
        self.origin.1 += count;
        self.t = self.origin.0 + step * self.origin.1 as f64;
        self.steps += count;
    }
}
