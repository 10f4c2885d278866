//! States at times, in one block of memory.

use crate::drive::Sink;
use crate::section::Crossing;

/// A sampled orbit: times and states (row-major), and the crossings met on the way.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trajectory {
    dim: usize,
    times: Vec<f64>,
    states: Vec<f64>,
    crossings: Vec<CrossingPoint>,
}

/// A recorded crossing of a section.
#[derive(Clone, Debug, PartialEq)]
pub struct CrossingPoint {
    /// Index of the section in the request.
    pub section: usize,
    /// Time.
    pub t: f64,
    /// `true` if `g` was growing.
    pub rising: bool,
    /// State.
    pub state: Vec<f64>,
}

impl Trajectory {
    /// An empty trajectory of states with `dim` entries.
    pub fn new(dim: usize) -> Self {
        Self { dim, ..Self::default() }
    }

    /// Number of samples.
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// Returns `true` if there is no sample.
    pub fn is_empty(&self) -> bool {
        self.times.is_empty()
    }

    /// The sample times, growing.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The state of sample `index`.
    pub fn state(&self, index: usize) -> &[f64] {
        &self.states[index * self.dim..(index + 1) * self.dim]
    }

    /// Samples as `(t, state)`.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (f64, &[f64])> {
        self.times.iter().copied().zip(self.states.chunks_exact(self.dim))
    }

    /// The crossings in the order they happened.
    pub fn crossings(&self) -> &[CrossingPoint] {
        &self.crossings
    }
}

impl Sink for Trajectory {
    fn sample(&mut self, t: f64, u: &[f64]) {
        self.times.push(t);
        self.states.extend_from_slice(u);
    }

    fn crossing(&mut self, crossing: &Crossing<'_>) {
        let Crossing { section, t, state, rising } = *crossing;
        self.crossings.push(CrossingPoint { section, t, rising, state: state.to_vec() });
    }
}
