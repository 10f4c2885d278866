//! Many initial states, asked on several threads: each thread takes the next one, many at a time where it has lanes.

use super::Samples;
use crate::analyse;
use crate::simulate::Monitor;
use motiform_dynamics::Model;
use motiform_models::tensor::Tensor;
use motiform_study::{Error, Plan};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// The samples of a plan, and where the answers go.
pub(super) struct Crowd<'c> {
    plan: &'c Plan,
    samples: Samples,
    /// The numbers of those who are asked.
    asked: Vec<usize>,
    pub(super) monitor: &'c dyn Monitor,
    pub(super) model: Box<dyn Model>,
}

impl<'c> Crowd<'c> {
    pub(super) fn new(plan: &'c Plan, samples: Samples, monitor: &'c dyn Monitor) -> Result<Self, Error> {
        let asked = (0..samples.count).collect();
        Ok(Self { plan, samples, asked, monitor, model: analyse::model(plan)? })
    }

    /// The same, but only some of them are asked.
    pub(super) fn among(self, asked: Vec<usize>) -> Self {
        Self { asked, ..self }
    }

    pub(super) fn tensor(&self) -> Option<&Tensor> {
        self.model.as_any()?.downcast_ref()
    }

    pub(super) fn start(&self, sample: usize) -> Result<Vec<f64>, Error> {
        let (model, c) = (self.model.as_ref(), &self.plan.computation);
        if sample > 0 {
            return Ok(self.samples.random.shape(self.plan.info()?, model, c.seed, sample as u64 + 1));
        }
        let mut shape = vec![0.0; model.dim()];
        model.encode(&c.initial.values()[..model.dim()], &mut shape);
        Ok(shape)
    }

    /// Answers of all who are asked, in order, by `ask` on each thread.
    pub(super) fn run<A: Send>(
        &self,
        ask: impl Fn(&Asked<'_, '_, A>) + Sync,
    ) -> Result<Option<Vec<A>>, Error> {
        let next = AtomicUsize::new(0);
        let answers: Mutex<Vec<Option<A>>> = Mutex::new(self.asked.iter().map(|_| None).collect());
        let failure = Mutex::new(None);
        let work = || {
            ask(&Asked { crowd: self, next: &next, answers: &answers, failure: &failure });
        };
        std::thread::scope(|scope| {
            for _ in 1..self.samples.threads.min(self.asked.len()) {
                scope.spawn(work);
            }
            work();
        });
        if let Some(error) = failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
            return Err(error);
        }
        Ok(answers.into_inner().unwrap_or_else(PoisonError::into_inner).into_iter().collect())
    }
}

/// What one thread is asked, and where it answers.
pub(super) struct Asked<'a, 'c, A> {
    pub(super) crowd: &'a Crowd<'c>,
    next: &'a AtomicUsize,
    answers: &'a Mutex<Vec<Option<A>>>,
    failure: &'a Mutex<Option<Error>>,
}

impl<A> Asked<'_, '_, A> {
    /// The next initial state, with its place among those asked.
    pub(super) fn next(&self) -> Option<(usize, Vec<f64>)> {
        let place = self.next.fetch_add(1, Ordering::Relaxed);
        let sample = *self.crowd.asked.get(place)?;
        if self.crowd.monitor.stopped() {
            return None;
        }
        match self.crowd.start(sample) {
            Ok(start) => Some((place, start)),
            Err(error) => {
                self.fail(error);
                None
            }
        }
    }

    /// The answer for the initial state that [`Asked::next`] gave with this place; none, if it was stopped.
    pub(super) fn done(&self, place: usize, answer: Result<Option<A>, Error>) {
        match answer {
            Ok(answer) => {
                let mut answers = self.answers.lock().unwrap_or_else(PoisonError::into_inner);
                answers[place] = answer;
                let done = answers.iter().flatten().count();
                self.crowd.monitor.progress(done as f64 / self.crowd.asked.len() as f64);
            }
            Err(error) => self.fail(error),
        }
    }

    fn fail(&self, error: Error) {
        self.failure.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
    }

    pub(super) fn one_by_one(&self, answer: impl Fn(&[f64]) -> Result<Option<A>, Error>) {
        while let Some((place, start)) = self.next() {
            self.done(place, answer(&start));
        }
    }
}
