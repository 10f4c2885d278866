//! The record of a run while it is computed: rows are written as they come, and nothing else is kept of them.

use crate::readings::{Crossings, Readings};
use crate::simulate::Simulation;
use motiform_dynamics::section::Crossing;
use motiform_dynamics::{Sink, Trajectory, Watch};
use motiform_store::TableWriter;
use motiform_store::table::Table;
use motiform_study::Error;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The destination of the rows of a trajectory.
pub trait Rows {
    /// The table that takes the next row.
    fn table(&mut self) -> &mut Table;

    /// A row was added.
    ///
    /// # Errors
    /// It cannot be written.
    fn advance(&mut self) -> Result<(), Error>;

    /// All rows so far were in vain: others follow.
    ///
    /// # Errors
    /// They cannot be removed.
    fn restart(&mut self) -> Result<(), Error>;
}

/// All rows stay in memory.
impl Rows for Table {
    fn table(&mut self) -> &mut Table {
        self
    }

    fn advance(&mut self) -> Result<(), Error> {
        Ok(())
    }

    fn restart(&mut self) -> Result<(), Error> {
        self.columns.iter_mut().for_each(|column| column.values.clear());
        Ok(())
    }
}

impl Rows for TableWriter {
    fn table(&mut self) -> &mut Table {
        self.table()
    }

    fn advance(&mut self) -> Result<(), Error> {
        Ok(self.advance()?)
    }

    fn restart(&mut self) -> Result<(), Error> {
        self.restart();
        Ok(())
    }
}

/// Rows that are not kept.
#[derive(Default)]
pub struct Unwanted(Table);

impl Rows for Unwanted {
    fn table(&mut self) -> &mut Table {
        &mut self.0
    }

    fn advance(&mut self) -> Result<(), Error> {
        Ok(())
    }

    fn restart(&mut self) -> Result<(), Error> {
        Ok(())
    }
}

/// The recorder of a run.
pub(crate) trait Record {
    fn sink(&mut self) -> &mut dyn Sink;

    /// Becomes true where nothing more can be taken: the run is in vain.
    fn full(&self) -> Arc<AtomicBool> {
        Arc::default()
    }
}

impl Record for Trajectory {
    fn sink(&mut self) -> &mut dyn Sink {
        self
    }
}

/// A watch that also stops a run whose rows cannot be written.
pub(crate) struct Unless<'w> {
    pub(crate) watch: &'w dyn Watch,
    pub(crate) stop: &'w AtomicBool,
}

impl Watch for Unless<'_> {
    fn progress(&self, done: f64) {
        self.watch.progress(done);
    }

    fn note(&self, text: &str) {
        self.watch.note(text);
    }

    fn stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed) || self.watch.stopped()
    }
}

/// The recorder of a plan: rows, crossings, and the centre of the path where the return map is centred.
pub(crate) struct Recorder<'r> {
    readings: Readings<'r>,
    rows: &'r mut dyn Rows,
    crossings: Option<Crossings>,
    /// The centre of the return map; the other quantities do without its exponentials.
    centre: Option<Centre>,
    failed: Option<Error>,
    full: Arc<AtomicBool>,
}

impl<'r> Recorder<'r> {
    pub(crate) fn new(run: &Simulation<'r>, rows: &'r mut dyn Rows) -> Self {
        let c = run.computation;
        Self {
            readings: Readings::new(run.model, c),
            rows,
            crossings: c.return_map.as_ref().map(Crossings::new),
            centre: c
                .return_map
                .as_ref()
                .filter(|map| map.centre)
                .map(|_| Centre::new(0.0, last_sample(c.t_end, c.dt_out))),
            failed: None,
            full: Arc::default(),
        }
    }

    /// The centre of the path, if the return map is centred; the time of its last sample where that was not foreseen.
    pub(crate) fn centre(&self) -> Option<Result<[f64; 2], f64>> {
        let centre = self.centre.as_ref()?;
        Some(if centre.last == centre.end { Ok(centre.found()) } else { Err(centre.last) })
    }

    /// Another recording follows instead of the one so far.
    pub(crate) fn restart(&mut self) -> Result<(), Error> {
        self.failed.take().map_or(Ok(()), Err)?;
        self.crossings = self.crossings.take().map(Crossings::emptied);
        self.rows.restart()
    }

    /// The crossings.
    ///
    /// # Errors
    /// Rows could not be written.
    pub(crate) fn finish(self) -> Result<Option<Table>, Error> {
        match self.failed {
            Some(error) => Err(error),
            None => Ok(self.crossings.map(Crossings::table)),
        }
    }
}

impl Record for Recorder<'_> {
    fn sink(&mut self) -> &mut dyn Sink {
        self
    }

    fn full(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.full)
    }
}

impl Sink for Recorder<'_> {
    fn sample(&mut self, t: f64, u: &[f64]) {
        if self.failed.is_some() {
            return; // the run ends with the step
        }
        if let Some(centre) = &mut self.centre {
            centre.sample(t, u);
        }
        self.readings.push(t, u, self.rows.table());
        if let Err(error) = self.rows.advance() {
            self.failed = Some(error);
            self.full.store(true, Ordering::Relaxed);
        }
    }

    fn crossing(&mut self, crossing: &Crossing<'_>) {
        if let Some(crossings) = &mut self.crossings {
            crossings.push(crossing.t, position(crossing.state), crossing.rising);
        }
    }
}

fn position(u: &[f64]) -> [f64; 2] {
    [u[u.len() - 2], u[u.len() - 1]]
}

/// The last time of the grid that a run from 0 to `end` samples, as [`motiform_dynamics::drive::Run`] finds it.
pub fn last_sample(end: f64, every: f64) -> f64 {
    let near = (end / every).round() * every;
    if (near - end).abs() <= 1e-9 * every { end } else { (end / every).floor() * every }
}

/// The time average of the position with a smooth window that vanishes with all its derivatives at both ends: for a
/// periodic or quasi-periodic path it converges to the centre faster than any power of the time.
pub(crate) struct Centre {
    start: f64,
    end: f64,
    last: f64,
    weights: f64,
    sum: [f64; 2],
}

impl Centre {
    /// Of a path from `start` to `end`.
    pub(crate) fn new(start: f64, end: f64) -> Self {
        Self { start, end, last: start, weights: 0.0, sum: [0.0; 2] }
    }

    pub(crate) fn add(&mut self, t: f64, [x, y]: [f64; 2]) {
        let s = (t - self.start) / (self.end - self.start);
        let weight = if s > 0.0 && s < 1.0 { libm::exp(-1.0 / (s * (1.0 - s))) } else { 0.0 };
        self.weights += weight;
        self.sum[0] += weight * x;
        self.sum[1] += weight * y;
        self.last = t;
    }

    pub(crate) fn found(&self) -> [f64; 2] {
        if self.weights > 0.0 { self.sum.map(|sum| sum / self.weights) } else { [0.0; 2] }
    }
}

impl Sink for Centre {
    fn sample(&mut self, t: f64, u: &[f64]) {
        self.add(t, position(u));
    }
}

impl Record for Centre {
    fn sink(&mut self) -> &mut dyn Sink {
        self
    }
}
