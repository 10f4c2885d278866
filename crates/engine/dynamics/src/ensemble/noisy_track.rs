//! A member under noise in its lane: its path and its rows.

use super::noisy::{NoisyMember, NoisySpan};
use crate::escape::norm;
use crate::noise_steps::NoiseSteps;

/// A member in its lane.
pub(super) struct Track<const D: usize> {
    pub(super) key: usize,
    pub(super) noise: NoiseSteps,
    pub(super) rows: Vec<[f64; D]>,
    /// Number of the next row.
    pub(super) next: u64,
    /// The state of the path at the end of the last step.
    pub(super) path: [f64; D],
}

impl<const D: usize> Track<D> {
    pub(super) fn new(member: NoisyMember<impl Sized, D>, span: &NoisySpan) -> Self {
        let NoisyMember { key, start, noise, .. } = member;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number of rows")]
        let count = span.every.map_or(0, |every| ((span.times.1 - span.times.0) / every) as usize + 2);
        let mut rows = Vec::with_capacity(count);
        if span.every.is_some() {
            rows.push(start);
        }
        Self { key, noise, rows, next: 1, path: start }
    }

    /// The time of the next row, if it is in a step that ends at `end`; that time itself where they meet up to rounding.
    pub(super) fn next_row(&self, span: &NoisySpan, end: f64) -> Option<f64> {
        let every = span.every?;
        let t = span.times.0 + every * self.next as f64;
        let t = if (t - end).abs() <= 1e-9 * every { end } else { t };
        (t <= end).then_some(t)
    }

    pub(super) fn record(&mut self, state: [f64; D]) {
        self.rows.push(state);
        self.next += 1;
    }

    /// The path follows the flow to the end of a step; `false` if the first `watched` entries have escaped.
    pub(super) fn land(&mut self, span: &NoisySpan, end: f64, flow: [f64; D], watched: usize) -> bool {
        self.path = flow;
        self.noise.add(end, &mut self.path);
        if self.next_row(span, end).is_some() {
            self.record(self.path);
        }
        norm(&self.path[..watched]) <= span.escape_norm
    }
}
