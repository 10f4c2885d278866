//! Sections `g(t, u) = 0`: where an orbit crosses a surface, located to round-off in time.
//!
//! A sign change of `g` is looked for at several points inside each step (on the interpolant), its time is bracketed
//! and found on the interpolant, and then polished with true steps of the method from the start of the step: the
//! crossing has the accuracy of the orbit itself, not that of the interpolant.

use crate::Integration;
use crate::orbit::DenseStep;

/// The sense in which a section counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// `g` grows through zero.
    Rising,
    /// `g` falls through zero.
    Falling,
    /// Both.
    Either,
}

/// A surface `g(t, u) = 0` in state space.
pub struct Section<'g> {
    /// The function whose zeros count.
    pub g: &'g (dyn Fn(f64, &[f64]) -> f64 + Sync),
    /// The sense in which they count.
    pub direction: Direction,
    /// Whether the run ends at the first crossing.
    pub terminal: bool,
}

/// One crossing, as handed to a sink.
#[derive(Clone, Copy, Debug)]
pub struct Crossing<'u> {
    /// Index of the section in the request.
    pub section: usize,
    /// Time of the crossing.
    pub t: f64,
    /// State there.
    pub state: &'u [f64],
    /// Whether `g` was growing.
    pub rising: bool,
}

/// How many pieces of a step are looked at for sign changes. Two crossings within one piece are missed.
const PIECES: usize = 8;

/// Follows the signs of one section along an orbit.
#[derive(Clone, Debug)]
pub(crate) struct Watcher {
    /// Time and value at the last point where `g` was not zero.
    last: Option<(f64, f64)>,
}

impl Watcher {
    /// Starts at `(t, u)`. A start on the section itself is no crossing.
    pub(crate) fn new(section: &Section<'_>, t: f64, u: &[f64]) -> Self {
        let value = (section.g)(t, u);
        Self { last: (value != 0.0).then_some((t, value)) }
    }

    /// Looks through a step; calls `found(t, rising)` for each crossing, in order. `state` is scratch.
    pub(crate) fn scan(
        &mut self,
        section: &Section<'_>,
        step: &DenseStep<'_>,
        state: &mut [f64],
        mut found: impl FnMut(f64, bool),
    ) {
        let (start, end) = step.span();
        for piece in 1..=PIECES {
            let t = if piece == PIECES { end } else { start + (end - start) * piece as f64 / PIECES as f64 };
            let value = value_in(section, step, t, state);
            if value == 0.0 || value.is_nan() {
                continue;
            }
            if let Some((t_last, value_last)) = self.last
                && (value_last < 0.0) != (value < 0.0)
            {
                let rising = value > 0.0;
                let wanted = match section.direction {
                    Direction::Either => true,
                    Direction::Rising => rising,
                    Direction::Falling => !rising,
                };
                if wanted {
                    let g = |t| value_in(section, step, t, state);
                    found(bisect(t_last.max(start), t, value_last, g), rising);
                }
            }
            self.last = Some((t, value));
        }
    }
}

/// `g` on the interpolant.
fn value_in(section: &Section<'_>, step: &DenseStep<'_>, t: f64, state: &mut [f64]) -> f64 {
    step.at(t, state);
    (section.g)(t, state)
}

/// Polishes a crossing time with true steps of the method; leaves the state of the crossing in `state`.
pub(crate) fn polish<O: Integration + ?Sized>(
    section: &Section<'_>,
    orbit: &mut O,
    guess: f64,
    state: &mut [f64],
) -> f64 {
    let step = orbit.dense();
    let (start, end) = step.span();
    let delta = 1e-4 * (end - start);
    let (before, after) = ((guess - delta).max(start), (guess + delta).min(end));
    let rise = value_in(section, &step, after, state) - value_in(section, &step, before, state);
    let slope = rise / (after - before);
    let mut t = guess;
    for _ in 0..4 {
        orbit.step_to(t, state);
        let next = t - (section.g)(t, state) / slope;
        if !next.is_finite() || next < start || next > end {
            break; // a grazing crossing: the interpolant's time is the best there is
        }
        let done = (next - t).abs() <= 2.0 * f64::EPSILON * t.abs();
        t = next;
        if done {
            break;
        }
    }
    orbit.step_to(t, state);
    t
}

/// The zero of `g` between `left` and `right`, where `g` changes from the sign of `value_left` to the other: bisection
/// to the last bit (an interpolant costs next to nothing, and a crossing is polished afterwards).
fn bisect(mut left: f64, mut right: f64, value_left: f64, mut g: impl FnMut(f64) -> f64) -> f64 {
    loop {
        let middle = 0.5 * (left + right);
        if !(middle > left && middle < right) {
            return right;
        }
        let value = g(middle);
        if value == 0.0 {
            return middle;
        }
        if (value < 0.0) == (value_left < 0.0) {
            left = middle;
        } else {
            right = middle;
        }
    }
}
