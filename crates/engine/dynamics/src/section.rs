//! Sections `g(t, u) = 0`: where an orbit crosses a surface, located to round-off in time.
//!
//! A sign change of `g` is looked for at several points inside each step (on the interpolant), its time is bracketed
//! and found on the interpolant, and then refined with true steps of the method from the start of the step: the
//! crossing has the accuracy of the orbit itself, not that of the interpolant.

use crate::Integration;
use crate::orbit::DenseStep;

/// The direction in which crossings count.
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
    /// The direction in which they count.
    pub direction: Direction,
    /// `true` if the run ends at the first crossing.
    pub terminal: bool,
}

/// One crossing, as passed to a sink.
#[derive(Clone, Copy, Debug)]
pub struct Crossing<'u> {
    /// Index of the section in the request.
    pub section: usize,
    /// Time of the crossing.
    pub t: f64,
    /// State there.
    pub state: &'u [f64],
    /// `true` if `g` was growing.
    pub rising: bool,
}

/// Number of pieces of a step that are searched for sign changes, unless a request says otherwise. Two
/// crossings within one piece are missed.
pub const PIECES: usize = 8;

/// Follows the signs of one section along an orbit.
#[derive(Clone, Debug)]
pub(crate) struct Watcher {
    /// Time and value at the last point where `g` was not zero.
    last: Option<(f64, f64)>,
}

impl Watcher {
    /// Starts at `(t, u)`. A start on the section itself is not a crossing.
    pub(crate) fn new(section: &Section<'_>, t: f64, u: &[f64]) -> Self {
        let value = (section.g)(t, u);
        Self { last: (value != 0.0).then_some((t, value)) }
    }

    /// Examines a step; calls `found(t, rising)` for each crossing, in order. `state` is scratch.
    pub(crate) fn scan(
        &mut self,
        section: &Section<'_>,
        step: &DenseStep<'_>,
        pieces: usize,
        state: &mut [f64],
        mut found: impl FnMut(f64, bool),
    ) {
        let (start, end) = step.span();
        for piece in 1..=pieces.max(1) {
            let t = if piece >= pieces { end } else { start + (end - start) * piece as f64 / pieces as f64 };
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
                    found(zero_between((t_last.max(start), value_last), (t, value), g), rising);
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

/// Refines a crossing time with true steps of the method; leaves the state of the crossing in `state`.
pub(crate) fn polish<O: Integration + ?Sized>(
    section: &Section<'_>,
    orbit: &mut O,
    guess: f64,
    state: &mut [f64],
) -> f64 {
    let step = orbit.dense();
    let span = step.span();
    let slope = slope_at(span, guess, |t| value_in(section, &step, t, state));
    let to = |t: f64, state: &mut [f64]| {
        orbit.step_to(t, state);
        (section.g)(t, state)
    };
    polished(span, guess, slope, to, state)
}

/// The slope of `g` near `guess`, from the interpolant of a step.
pub fn slope_at((start, end): (f64, f64), guess: f64, mut g: impl FnMut(f64) -> f64) -> f64 {
    let delta = 1e-4 * (end - start);
    let (before, after) = ((guess - delta).max(start), (guess + delta).min(end));
    (g(after) - g(before)) / (after - before)
}

/// The zero of `g` near `guess` by Newton's method with a fixed slope; `to` makes a true step to a time, writes the state
/// there and returns `g`.
pub fn polished(
    (start, end): (f64, f64),
    guess: f64,
    slope: f64,
    mut to: impl FnMut(f64, &mut [f64]) -> f64,
    state: &mut [f64],
) -> f64 {
    let (mut t, mut reached) = (guess, f64::NAN);
    for _ in 0..4 {
        let next = t - to(t, state) / slope;
        reached = t;
        if !next.is_finite() || next < start || next > end {
            break; // a grazing crossing: the interpolant's time is the best there is
        }
        let done = (next - t).abs() <= 2.0 * f64::EPSILON * t.abs();
        t = next;
        if done {
            break;
        }
    }
    if t != reached {
        to(t, state);
    }
    t
}

/// The zero of `g` between `left` and `right`, where `g` changes from the sign of `value_left` to that of `value_right`, to
/// the last bits: regula falsi in the Illinois form, bisection where that is slow.
///
/// Source: Dowell and Jarratt (1971), BIT 11, 168.
pub fn zero_between(
    (mut left, mut value_left): (f64, f64),
    (mut right, mut value_right): (f64, f64),
    mut g: impl FnMut(f64) -> f64,
) -> f64 {
    let (negative, resolution) = (value_left < 0.0, 2.0 * f64::EPSILON * right.abs().max(left.abs()));
    let mut kept_left = 0;
    for round in 0..80 {
        let middle = 0.5 * (left + right);
        if right - left <= resolution || !(middle > left && middle < right) {
            break;
        }
        let secant = right - value_right * (right - left) / (value_right - value_left);
        let t = if round % 4 == 3 || !(secant > left && secant < right) { middle } else { secant };
        let value = g(t);
        if value == 0.0 {
            return t;
        }
        if (value < 0.0) == negative {
            (left, value_left) = (t, value);
            kept_left = kept_left.min(0) - 1;
        } else {
            (right, value_right) = (t, value);
            kept_left = kept_left.max(0) + 1;
        }
        // The end that stays twice is given half its weight.
        match kept_left {
            2.. => value_left *= 0.5,
            ..=-2 => value_right *= 0.5,
            _ => {}
        }
    }
    right
}
