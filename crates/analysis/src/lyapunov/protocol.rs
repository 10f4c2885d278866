//! When tangent vectors are made orthonormal, and what they have grown by: the same for one orbit and for a lane of many.

use super::{Lyapunov, LyapunovSettings, means, neutral_directions};
use crate::Result;
use crate::linear::orthonormalise;
use crate::symmetry::reduced_speed;
use motiform_dynamics::{Equivariant, Outcome, StepControl, VectorField};

/// Vectors are made orthonormal when they have parted by this factor (natural logarithm).
const PARTED: f64 = 8.0;

/// A tangent flow under way, stretch by stretch: whoever runs the flow asks how far the next stretch goes.
#[derive(Clone, Debug)]
pub(crate) struct Protocol {
    settings: LyapunovSettings,
    dim: usize,
    /// Length of a stretch: chosen while the flow settles, then kept.
    interval: f64,
    averaging: bool,
    /// Start of the stretch under way, and end of the phase.
    start: f64,
    end: f64,
    /// Steps before the averages began.
    steps_before: u64,
    history: Vec<(f64, Vec<f64>)>,
    durations: Vec<f64>,
    reduced_speeds: Vec<f64>,
}

impl Protocol {
    /// Nothing done so far, for a shape of length `dim`.
    pub(crate) fn new(settings: &LyapunovSettings, dim: usize) -> Self {
        Self {
            settings: *settings,
            dim,
            interval: 1.0,
            averaging: false,
            start: 0.0,
            end: 0.0,
            steps_before: 0,
            history: Vec::new(),
            durations: Vec::new(),
            reduced_speeds: Vec::new(),
        }
    }

    /// The end of the first stretch of a run from time `t`; `None` if there is none.
    pub(crate) fn begin(&mut self, t: f64) -> Option<f64> {
        self.end = t + self.settings.transient;
        self.goal(t, 0)
    }

    /// Takes in the end of a stretch, whose vectors are made orthonormal in place, after so many steps in all; the end of the
    /// next stretch.
    pub(crate) fn stretched<B: Equivariant + ?Sized>(
        &mut self,
        body: &B,
        t: f64,
        state: &mut [f64],
        steps: u64,
    ) -> Option<f64> {
        let (shape, vectors) = state.split_at_mut(self.dim);
        let lengths = orthonormalise(&mut vectors.chunks_exact_mut(self.dim.max(1)).collect::<Vec<_>>());
        let growth: Vec<f64> = lengths.into_iter().map(f64::ln).collect();
        if self.averaging {
            let lasted = t - self.start;
            self.durations.push(lasted);
            self.reduced_speeds.push(speed(body, shape));
            self.history.push((t, growth.into_iter().map(|g| g / lasted).collect()));
        } else {
            self.adjust(&growth);
        }
        self.goal(t, steps)
    }

    /// Stretches half or twice as long, by how far the vectors have parted.
    fn adjust(&mut self, growth: &[f64]) {
        let most = growth.iter().copied().fold(0.0, f64::max);
        let least = growth.iter().copied().fold(0.0, f64::min);
        if most - least > PARTED {
            self.interval *= 0.5;
        } else if most - least < 0.25 * PARTED {
            self.interval = (2.0 * self.interval).min((self.settings.transient / 8.0).max(1.0));
        }
    }

    /// The end of the stretch that begins at `t`.
    fn goal(&mut self, t: f64, steps: u64) -> Option<f64> {
        if !self.averaging && t >= self.end {
            self.averaging = true;
            self.steps_before = steps;
            self.end = t + self.settings.span;
            // At least as many intervals as the errors need, all of the same length.
            self.interval = self.settings.span / (self.settings.span / self.interval).ceil().max(128.0);
        }
        let left = if self.averaging { 0.5 * self.interval } else { 0.0 };
        if t >= self.end - left {
            return None;
        }
        self.start = t;
        let next = t + self.interval;
        Some(if next > self.end - 1e-9 * self.interval { self.end } else { next })
    }

    /// The exponents of a run that ended like this, at this shape, after so many steps in all.
    pub(crate) fn result<B: Equivariant + ?Sized>(
        self,
        body: &B,
        shape: &[f64],
        outcome: Outcome,
        steps: u64,
    ) -> Result<Lyapunov> {
        let time = self.durations.iter().sum();
        let exponents = if outcome.is_complete() && !self.history.is_empty() {
            let rtol = match self.settings.control {
                StepControl::Adaptive { rtol, .. } => rtol,
                StepControl::Fixed { .. } => 0.0,
            };
            let steps = (steps - self.steps_before) as f64;
            means(&self.history, rtol * (self.dim as f64).sqrt() * steps / time)?
        } else {
            Vec::new()
        };
        Ok(Lyapunov {
            exponents,
            neutral: neutral_directions(body, shape),
            time,
            transient: self.settings.transient,
            reduced_speeds: self.reduced_speeds,
            history: self.history,
            outcome,
            shape: shape.to_vec(),
        })
    }
}

/// The reduced speed of a body at a shape.
fn speed<B: Equivariant + ?Sized>(body: &B, shape: &[f64]) -> f64 {
    let mut rate = shape.to_vec();
    VectorField::<f64>::eval(body, 0.0, shape, &mut rate);
    reduced_speed(body, shape, &rate)
}
