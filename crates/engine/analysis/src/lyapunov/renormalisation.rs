//! The times at which tangent vectors are made orthonormal, and their growth in between: the same for one
//! orbit and for a lane of many.

use super::silent::silent_rates;
use super::{Lyapunov, LyapunovSettings, SoFar, means, neutral_directions, pace};
use crate::linear::norm;
use crate::{Estimate, Result, sort_by_number};
use motiform_dynamics::{Equivariant, Outcome, StepControl};

/// Vectors are made orthonormal when they have separated by this factor (natural logarithm).
const PARTED: f64 = 8.0;

/// By this factor (natural logarithm) at most: what is left of the shortest vector is then of the size of the errors of steps.
const LOST: f64 = 20.0;

/// Least number of intervals to average over; steps may be twice as long as one of them, so there are half as many stretches
/// or more: enough for an error.
const INTERVALS: f64 = 160.0;

/// The first stretches of a run that is shorter than so many units of time are this part of it.
const SHORT: f64 = 40.0;

/// Most stretches of a run. Vectors that separate so fast that it would take more are those of rates that are immense against the time.
/// (Close to a blow-up stretches become short as well, and then the run ends.)
const MOST: f64 = 1e13;

/// A stretch to come.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stretch {
    /// It ends with the first step that reaches this time,
    pub(crate) stop: f64,
    /// and here at the latest: no step may go on beyond.
    pub(crate) limit: f64,
}

/// A tangent flow under way, stretch by stretch: the caller asks how far the next stretch goes.
#[derive(Clone, Debug)]
pub(crate) struct Renormalisation {
    settings: LyapunovSettings,
    dim: usize,
    /// Size of the shape at the start.
    size: f64,
    /// Usual length of a stretch: chosen while the flow settles, then kept.
    interval: f64,
    /// The first one.
    unit: f64,
    averaging: bool,
    /// `true` if there would be more than [`MOST`] stretches: there are no exponents then.
    given_up: bool,
    /// Start of the stretch under way, start of the averages, end of the phase.
    start: f64,
    begun: f64,
    end: f64,
    /// Steps before the averages began.
    steps_before: u64,
    history: Vec<(f64, Vec<f64>)>,
    /// Time averaged over so far.
    time: f64,
    reduced_speeds: Vec<f64>,
}

impl Renormalisation {
    /// Nothing done so far, for a run from this shape.
    pub(crate) fn new(settings: &LyapunovSettings, start: &[f64]) -> Self {
        // the model's own unit, but not in runs that are short against it: vectors may grow beyond all numbers in one
        let interval = ((settings.transient + settings.span) / SHORT).min(1.0);
        Self {
            settings: *settings,
            dim: start.len(),
            size: norm(start),
            interval,
            unit: interval,
            averaging: false,
            given_up: false,
            start: 0.0,
            begun: 0.0,
            end: 0.0,
            steps_before: 0,
            history: Vec::new(),
            time: 0.0,
            reduced_speeds: Vec::new(),
        }
    }

    /// The first stretch of a run from time `t`; `None` if there is none.
    pub(crate) fn begin(&mut self, t: f64) -> Option<Stretch> {
        self.end = t + self.settings.transient;
        self.next(t, 0)
    }

    /// Takes in the end of a stretch at time `t`, after so many steps in all: the lengths that the vectors had grown to, and how
    /// fast the reduced shape changes there. The next stretch.
    pub(crate) fn stretched(&mut self, t: f64, lengths: &[f64], speed: f64, steps: u64) -> Option<Stretch> {
        if self.averaging && separated(lengths) > LOST {
            self.begin_averages_again(t, steps);
        } else if self.averaging {
            let lasted = t - self.start;
            self.history.push((t, lengths.iter().map(|&length| libm::log(length) / lasted).collect()));
            self.time += lasted;
            self.reduced_speeds.push(speed);
        } else {
            self.adjust(lengths);
        }
        self.next(t, steps)
    }

    /// Directions were lost within a stretch: stretches are halved, and averages begin here.
    fn begin_averages_again(&mut self, t: f64, steps: u64) {
        self.interval *= 0.5;
        self.history.clear();
        self.reduced_speeds.clear();
        self.time = 0.0;
        (self.begun, self.end, self.steps_before) = (t, t + self.settings.span, steps);
    }

    /// The averages so far of a shape that changes at this pace; `None` before they begin.
    pub(crate) fn so_far(&self, pace: f64) -> Option<SoFar<'_>> {
        (!self.history.is_empty()).then_some(SoFar { history: &self.history, begun: self.begun, pace })
    }

    /// Stretches half or twice as long, by how far the vectors have separated.
    fn adjust(&mut self, lengths: &[f64]) {
        let separated = separated(lengths);
        if separated > PARTED {
            self.interval *= 0.5;
        } else if separated < 0.25 * PARTED {
            self.interval = (2.0 * self.interval).min((self.settings.transient / 8.0).max(self.unit));
        }
    }

    /// The stretch that begins at `t`. That of an average goes to the next of the times `begun + k interval`, and on to the end of
    /// the step that reaches it: none is cut short, as long as steps are shorter than half an interval. A phase ends on time.
    fn next(&mut self, t: f64, steps: u64) -> Option<Stretch> {
        if !self.averaging && t >= self.end {
            self.averaging = true;
            self.steps_before = steps;
            self.begun = t;
            self.end = t + self.settings.span;
            self.interval = self.settings.span / (self.settings.span / self.interval).ceil().max(INTERVALS);
        }
        self.given_up = self.interval * MOST < self.settings.transient + self.settings.span;
        if t >= self.end || self.given_up {
            return None;
        }
        self.start = t;
        if !self.averaging {
            // The interval may be too long already: no step goes on beyond it, or a vector might vanish.
            let stop = self.end.min(t + self.interval);
            return Some(Stretch { stop, limit: stop });
        }
        let mut stop = self.begun + self.interval * (((t - self.begun) / self.interval).floor() + 1.0);
        if stop <= t {
            stop += self.interval; // t is a multiple but for its rounding
        }
        if stop > self.end - 0.5 * self.interval {
            return Some(Stretch { stop: self.end, limit: self.end });
        }
        Some(Stretch { stop, limit: self.end.min(stop + self.interval) })
    }

    /// The exponents of a run that ended like this, at this shape, after so many steps in all.
    pub(crate) fn result(
        self,
        body: &dyn Equivariant,
        shape: &[f64],
        outcome: Outcome,
        steps: u64,
    ) -> Result<Lyapunov> {
        let time = self.time;
        let outcome = match outcome {
            Outcome::Completed { t } if self.given_up => Outcome::StepBudget { t, steps },
            outcome => outcome,
        };
        let exponents = if outcome.is_complete() && !self.history.is_empty() {
            let rtol = match self.settings.control {
                StepControl::Adaptive { rtol, .. } => rtol,
                StepControl::Fixed { .. } => 0.0,
            };
            let steps = (steps - self.steps_before) as f64;
            let numerical = rtol * (self.dim as f64).sqrt() * steps / time;
            let rate = body.rates(shape);
            means(&self.history, self.begun, numerical, pace(shape, &rate))?
        } else {
            Vec::new()
        };
        let neutral = neutral_directions(body, shape, self.size);
        let (exponents, widened) = with_known_zeros(exponents, neutral);
        Ok(Lyapunov {
            exponents,
            widened,
            neutral,
            silent: if outcome.is_complete() { silent_rates(body, shape) } else { Vec::new() },
            time,
            transient: if self.averaging { self.begun } else { self.settings.transient },
            reduced_speeds: self.reduced_speeds,
            history: self.history,
            outcome,
            shape: shape.to_vec(),
        })
    }
}

/// Exponents of a motion of which so many must be 0: where those are further from 0 than their errors, the averages have an error that
/// does not show in their scatter (vectors that separate like the time in a shear), which is at least that: then with wider errors, and
/// `true`.
fn with_known_zeros(mut exponents: Vec<Estimate>, neutral: usize) -> (Vec<Estimate>, bool) {
    if neutral >= exponents.len() {
        return (exponents, false); // which of them are the zeros is not known
    }
    let mut nearest = exponents.clone();
    sort_by_number(&mut nearest, |a| a.value.abs());
    nearest.truncate(neutral);
    // one that is clearly not 0 is that of a motion which settles
    let off = |zero: &Estimate| zero.error < zero.value.abs() && zero.value.abs() <= CLEAR * zero.error;
    let widened = nearest.iter().any(off);
    if widened {
        let worst = nearest.iter().map(|zero| zero.value.abs()).fold(0.0, f64::max);
        exponents.iter_mut().for_each(|exponent| exponent.error = exponent.error.max(KNOWN * worst));
    }
    (exponents, widened)
}

/// An average of so many errors is not 0.
const CLEAR: f64 = 10.0;

/// Error of averages in units of that which is seen in those that must be 0.
const KNOWN: f64 = 2.0;

/// By what factor (natural logarithm) vectors of these lengths have separated, from each other or from the length 1.
fn separated(lengths: &[f64]) -> f64 {
    let most = libm::log(lengths.iter().copied().fold(1.0, f64::max));
    let least = libm::log(lengths.iter().copied().fold(1.0, f64::min));
    most - least
}
