//! Many initial states of a plan, and an analysis of each.

use super::Samples;
use crate::analyse;
use crate::pool::{Jobs, spread};
use motiform_dynamics::Model;
use motiform_dynamics::Watch;
use motiform_study::{Error, Plan};

/// The samples of a plan, or some of them.
pub(super) struct Population<'c> {
    plan: &'c Plan,
    samples: Samples,
    /// The numbers of the selected samples.
    chosen: Vec<usize>,
    pub(super) watch: &'c dyn Watch,
    pub(super) model: Box<dyn Model>,
}

impl<'c> Population<'c> {
    pub(super) fn new(plan: &'c Plan, samples: Samples, watch: &'c dyn Watch) -> Result<Self, Error> {
        let chosen = (0..samples.count).collect();
        Ok(Self { plan, samples, chosen, watch, model: analyse::model(plan)? })
    }

    /// The same, with only some of the samples.
    pub(super) fn among(self, chosen: Vec<usize>) -> Self {
        Self { chosen, ..self }
    }

    /// The initial shape of a sample, in the model's representation.
    pub(super) fn start(&self, sample: usize) -> Result<Vec<f64>, Error> {
        let (model, c) = (self.model.as_ref(), &self.plan.computation);
        if sample > 0 {
            return Ok(self.samples.random.shape(self.plan.info()?, model, c.seed, sample as u64 + 1));
        }
        let shape = model.encoded(&c.initial.values()[..model.dim()]);
        Ok(shape)
    }

    /// Results of all selected samples, in order, by `ask` on each thread; `None` if the watch stopped it.
    pub(super) fn run<A: Send>(
        &self,
        ask: impl Fn(&Asked<'_, '_, '_, A>) + Sync,
    ) -> Result<Option<Vec<A>>, Error> {
        spread(self.chosen.len(), self.samples.threads, self.watch, |jobs| {
            ask(&Asked { population: self, jobs });
        })
    }
}

/// The work of one thread, and where it puts the results.
pub(super) struct Asked<'a, 'c, 'j, A> {
    pub(super) population: &'a Population<'c>,
    pub(super) jobs: &'a Jobs<'j, A>,
}

impl<A> Asked<'_, '_, '_, A> {
    /// The next initial state, with the number of its job.
    pub(super) fn next(&self) -> Option<(usize, Vec<f64>)> {
        let job = self.jobs.next()?;
        match self.population.start(self.population.chosen[job]) {
            Ok(start) => Some((job, start)),
            Err(error) => {
                self.jobs.done(job, Err(error));
                None
            }
        }
    }

    pub(super) fn one_by_one(&self, answer: impl Fn(&[f64]) -> Result<Option<A>, Error>) {
        while let Some((job, start)) = self.next() {
            self.jobs.done(job, answer(&start));
        }
    }
}
