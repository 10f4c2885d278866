//! The samples of a motion since its last change.

use crate::accuracy::Accuracy;
use crate::readings::{pace, turns};
use motiform_dynamics::Model;
use motiform_study::plan::Computation;

/// The last samples of a motion, in memory that does not grow beyond twice `most` of them.
#[derive(Clone, Debug)]
pub struct Record {
    most: usize,
    /// Entries of a state (shape, x, y), and of the quantities computed from it (speed, turning rate, observables).
    state: usize,
    read: usize,
    /// Absolute tolerance of the method: speeds that it does not resolve have no heading.
    atol: f64,
    /// The heading has a derivative.
    turns: bool,
    /// The errors of its numbers.
    accuracy: Accuracy,
    /// Complete rows: time, state, quantities computed from it.
    numbers: Vec<f64>,
}

/// One sample of a body that is moved interactively.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<'r> {
    /// Model time.
    pub t: f64,
    /// The shape as the model computes with it, then x and y.
    pub state: &'r [f64],
    /// Speed, turning rate (NaN at rest, and where noise leaves the velocity no derivative), then the model's observables.
    pub read: &'r [f64],
}

impl Row<'_> {
    /// The position of the centre of mass.
    pub fn position(&self) -> [f64; 2] {
        let place = self.state.len() - 2;
        [self.state[place], self.state[place + 1]]
    }
}

impl Record {
    /// An empty record of a model's motion, computed like this, that keeps the last `most` samples.
    pub fn new(model: &dyn Model, computation: &Computation, most: usize) -> Self {
        let (state, read) = (model.dim() + 2, 2 + model.observables().len());
        let (atol, turns) = (computation.control.absolute_tolerance(), turns(model, computation));
        let accuracy = Accuracy::with(computation.control, None);
        Self { most: most.max(1), state, read, atol, turns, accuracy, numbers: Vec::new() }
    }

    /// The errors of its numbers.
    pub(super) fn accuracy(&self) -> Accuracy {
        self.accuracy
    }

    fn width(&self) -> usize {
        1 + self.state + self.read
    }

    /// Number of samples that are kept.
    pub fn len(&self) -> usize {
        (self.numbers.len() / self.width()).min(self.most)
    }

    /// Returns `true` if it is empty.
    pub fn is_empty(&self) -> bool {
        self.numbers.is_empty()
    }

    /// Adds a sample: its time, then its state.
    pub(super) fn push(&mut self, model: &dyn Model, sample: &[f64]) {
        let width = self.width();
        if self.numbers.len() == 2 * self.most * width {
            self.numbers.drain(..self.most * width);
        }
        self.numbers.extend_from_slice(sample);
        let shape = &sample[1..self.state - 1];
        let [speed, turning, ..] = pace(model, shape, self.atol);
        self.numbers.extend([speed, if self.turns { turning } else { f64::NAN }]);
        let observed = self.numbers.len();
        self.numbers.resize(observed + self.read - 2, f64::NAN);
        model.observe(shape, &mut self.numbers[observed..]);
    }

    /// The samples that are kept, from the oldest.
    pub fn rows(&self) -> impl DoubleEndedIterator<Item = Row<'_>> + ExactSizeIterator + Clone {
        let (width, state) = (self.width(), self.state);
        let first = self.numbers.len() - self.len() * width;
        self.numbers[first..].chunks_exact(width).map(move |row| Row {
            t: row[0],
            state: &row[1..=state],
            read: &row[1 + state..],
        })
    }
}
