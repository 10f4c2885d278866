//! The driver: one run from start to end, with samples, sections, a step budget and an escape bound.

use crate::escape::{GrowthLaw, norm};
use crate::orbit::StepFailure;
use crate::sample::sort_by_number;
use crate::section::{Crossing, PIECES, Section, Watcher, polish};
use crate::{Error, Integration, Obstacle, Outcome, Watch};
use std::ops::ControlFlow;

/// The settings of a run.
pub struct Request<'g> {
    /// End of the time span.
    pub t_end: f64,
    /// The run also ends with the first step that reaches this time: for callers that do not want truncated steps. Infinite for no such
    /// time.
    pub stop_after: f64,
    /// Time between samples, the first at the start; `None` for no samples.
    pub sample_every: Option<f64>,
    /// Maximum number of steps (accepted and rejected).
    pub max_steps: u64,
    /// The run has escaped when the norm of the watched part of the state exceeds this.
    pub escape_norm: f64,
    /// Number of leading entries of the state that are watched for escape (a position may become large).
    pub watched: usize,
    /// Sections to locate.
    pub sections: &'g [Section<'g>],
    /// Number of pieces of a step that are searched for crossings, at least 1 ([`PIECES`] by default; fewer
    /// are enough where steps are far shorter than the time between crossings).
    pub pieces: usize,
    /// Receives the progress of the run and may stop it; called after every 64th step.
    pub watch: &'g dyn Watch,
}

/// A shape that grows to this many times its size, or to this size, has escaped.
const UNBOUND: f64 = 1e6;

impl Request<'_> {
    /// A plain run to `t_end` on a state with `dim` entries: no samples, no sections, no watch, generous bounds.
    pub fn until(t_end: f64, dim: usize) -> Self {
        Self {
            t_end,
            stop_after: f64::INFINITY,
            sample_every: None,
            max_steps: 1_000_000_000,
            escape_norm: UNBOUND,
            watched: dim,
            sections: &[],
            pieces: PIECES,
            watch: &(),
        }
    }

    /// The same from a shape of any size: it has escaped when it is many times as large.
    pub fn around(t_end: f64, shape: &[f64]) -> Self {
        Self { escape_norm: UNBOUND * norm(shape).max(1.0), ..Self::until(t_end, shape.len()) }
    }

    fn validate(&self, t: f64) -> Result<(), Error> {
        let check = |name, value: f64, ok: bool, range| {
            if ok && value.is_finite() { Ok(()) } else { Err(Error::OutOfRange { name, value, range }) }
        };
        check("t_end", self.t_end, self.t_end >= t, "not before the start")?;
        check("escape norm", self.escape_norm, self.escape_norm > 0.0, "above 0")?;
        let every = self.sample_every.unwrap_or(1.0);
        check("sampling interval", every, every > 0.0, "above 0")
    }
}

/// Receives the results of a run as they are computed. Every method has a default that does nothing.
pub trait Sink {
    /// A state of the sampling grid.
    fn sample(&mut self, _t: f64, _u: &[f64]) {}

    /// A crossing of a section.
    fn crossing(&mut self, _crossing: &Crossing<'_>) {}

    /// The end of every accepted step: state and rates.
    fn step(&mut self, _t: f64, _u: &[f64], _slope: &[f64]) {}
}

/// Only the final state is kept.
impl Sink for () {}

/// Runs `orbit` as specified by `request`, passing results to `sink`. The final state remains in `orbit`.
///
/// # Errors
/// [`Error::OutOfRange`] for an invalid request; everything that happens during the run is an [`Outcome`].
pub fn drive<O: Integration + ?Sized>(
    orbit: &mut O,
    request: &Request<'_>,
    sink: &mut dyn Sink,
) -> Result<Outcome, Error> {
    let mut run = Run::new(orbit, request, sink)?;
    loop {
        if let ControlFlow::Break(outcome) = run.step(orbit, request, sink) {
            return Ok(outcome);
        }
    }
}

/// A run in progress, one step at a time, for callers that decide after each step whether to continue. [`drive`] is just
/// this loop.
pub struct Run {
    start: f64,
    next_sample: u64,
    watchers: Vec<Watcher>,
    growth: GrowthLaw,
    state: Vec<f64>,
    found: Vec<(f64, usize, bool)>,
}

impl Run {
    /// A run from the present state of `orbit`, which is its first sample if samples are requested.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for an invalid request.
    pub fn new<O: Integration + ?Sized>(
        orbit: &O,
        request: &Request<'_>,
        sink: &mut dyn Sink,
    ) -> Result<Self, Error> {
        request.validate(orbit.t())?;
        if request.sample_every.is_some() {
            sink.sample(orbit.t(), orbit.state());
        }
        let watcher = |section| Watcher::new(section, orbit.t(), orbit.state());
        Ok(Self {
            start: orbit.t(),
            next_sample: 1,
            watchers: request.sections.iter().map(watcher).collect(),
            growth: GrowthLaw::default(),
            state: orbit.state().to_vec(),
            found: Vec::with_capacity(16),
        })
    }

    /// One step of `orbit`, for the same orbit and request as before; `Break` if the run ended before or with this step.
    pub fn step<O: Integration + ?Sized>(
        &mut self,
        orbit: &mut O,
        request: &Request<'_>,
        sink: &mut dyn Sink,
    ) -> ControlFlow<Outcome> {
        if orbit.t() >= request.t_end.min(request.stop_after) {
            return ControlFlow::Break(Outcome::Completed { t: orbit.t() });
        }
        let work = orbit.counters();
        if work.steps + work.rejected >= request.max_steps {
            return ControlFlow::Break(Outcome::StepBudget { t: orbit.t(), steps: work.steps });
        }
        if let Err(failure) = orbit.advance(request.t_end) {
            return ControlFlow::Break(self.failed(orbit, request, failure));
        }
        if let Some(t) = self.cross(orbit, request, sink) {
            return ControlFlow::Break(Outcome::Stopped { t });
        }
        sink.step(orbit.t(), orbit.state(), orbit.slope());
        self.sample(orbit, request, sink, orbit.t());
        let watched = ..request.watched;
        self.growth.observe(orbit.t(), &orbit.state()[watched], &orbit.slope()[watched]);
        if norm(&orbit.state()[watched]) > request.escape_norm {
            return ControlFlow::Break(self.left(orbit, request));
        }
        if work.steps.is_multiple_of(64) {
            request.watch.progress((orbit.t() - self.start) / (request.t_end - self.start));
            if request.watch.stopped() {
                return ControlFlow::Break(Outcome::Interrupted { t: orbit.t() });
            }
        }
        ControlFlow::Continue(())
    }

    /// The outcome of a run whose next step is impossible.
    fn failed<O: Integration + ?Sized>(
        &self,
        orbit: &O,
        request: &Request<'_>,
        failure: StepFailure,
    ) -> Outcome {
        match failure {
            StepFailure::Underflow { step } => {
                self.escaped(orbit, request).unwrap_or(Outcome::StepUnderflow { t: orbit.t(), step })
            }
            StepFailure::NotFinite => self.left(orbit, request),
            StepFailure::Obstacle(Obstacle::Closure { residual }) => {
                Outcome::ClosureFailed { t: orbit.t(), residual }
            }
        }
    }

    /// Passes on the samples of the last step up to time `until`.
    fn sample<O: Integration + ?Sized>(
        &mut self,
        orbit: &mut O,
        request: &Request<'_>,
        sink: &mut dyn Sink,
        until: f64,
    ) {
        let Some(every) = request.sample_every else { return };
        let end = orbit.t();
        loop {
            let mut t = self.start + every * self.next_sample as f64;
            if (t - end).abs() <= 1e-9 * every {
                t = end; // the grid meets the end of the step up to rounding
            }
            if t > until {
                return;
            }
            orbit.at(t, &mut self.state);
            sink.sample(t, &self.state);
            self.next_sample += 1;
        }
    }

    /// Finds, refines and passes on the crossings of the last step; a terminal crossing ends the run.
    fn cross<O: Integration + ?Sized>(
        &mut self,
        orbit: &mut O,
        request: &Request<'_>,
        sink: &mut dyn Sink,
    ) -> Option<f64> {
        if request.sections.is_empty() {
            return None;
        }
        self.found.clear();
        let step = orbit.dense();
        for (index, (section, watcher)) in request.sections.iter().zip(&mut self.watchers).enumerate() {
            watcher.scan(section, &step, request.pieces, &mut self.state, |t, rising| {
                self.found.push((t, index, rising));
            });
        }
        sort_by_number(&mut self.found, |a| a.0);
        for event in 0..self.found.len() {
            let (guess, index, rising) = self.found[event];
            let section = &request.sections[index];
            let t = polish(section, orbit, guess, &mut self.state);
            sink.crossing(&Crossing { section: index, t, state: &self.state, rising });
            if section.terminal {
                self.sample(orbit, request, sink, t);
                orbit.end_step_at(t);
                return Some(t);
            }
        }
        None
    }

    /// The outcome of a run that exceeded its bounds.
    fn left<O: Integration + ?Sized>(&self, orbit: &O, request: &Request<'_>) -> Outcome {
        let t_last = orbit.t();
        let norm = norm(&orbit.state()[..request.watched]);
        self.escaped(orbit, request).unwrap_or(Outcome::Escaped { t: t_last, norm, singular: false, t_last })
    }

    /// The blow-up implied by the growth of the last states, if they grow like a near singularity.
    fn escaped<O: Integration + ?Sized>(&self, orbit: &O, request: &Request<'_>) -> Option<Outcome> {
        let t_last = orbit.t();
        let norm = norm(&orbit.state()[..request.watched]);
        let singularity = self.growth.singularity().filter(|found| found.t >= t_last)?;
        (norm > 1e3).then_some(Outcome::Escaped { t: singularity.t, norm, singular: true, t_last })
    }
}
