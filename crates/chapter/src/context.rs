//! Common tools of all chapters: running studies, classifying motions, computing and storing scans.

use motiform_analysis::Verdict;
use motiform_dynamics::Watch;
use motiform_dynamics::{Outcome, StopOnly};
use motiform_lab::analyse;
use motiform_lab::pool;
use motiform_lab::scan::{CellSummary, Classify, Opening, Scan, Shard, cells};
use motiform_lab::simulate::simulate;
use motiform_study::{Dataset, Error, Plan, Random, ScanPlan, Study, presets};
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

/// The settings of a chapter.
pub struct Context<'c> {
    /// Scans are kept in folders here.
    pub out: &'c Path,
    /// Less evidence in less time.
    pub quick: bool,
    /// Threads of scans; changes no number.
    pub threads: usize,
    /// Progress, and whether to stop.
    pub watch: &'c dyn Watch,
}

impl Context<'_> {
    /// `full`, or `quick` in a quick run.
    pub fn choose<T>(&self, full: T, quick: T) -> T {
        if self.quick { quick } else { full }
    }

    /// `answer` to each item, on all threads, in the order of the items.
    pub fn each<I: Sync, A: Send>(
        &self,
        items: &[I],
        answer: impl Fn(&I) -> Result<A, Error> + Sync,
    ) -> Result<Vec<A>, Error> {
        pool::each(items, self.threads, self.watch, answer)
    }

    /// A watch for stopping only.
    pub fn quiet(&self) -> impl Watch + '_ {
        StopOnly(self.watch)
    }

    /// The study of a preset with changes.
    pub fn preset(
        &self,
        name: &str,
        change: impl FnOnce(&mut Study) -> Result<(), Error>,
    ) -> Result<Study, Error> {
        let mut study = presets::find_any(name, "tensor")?;
        change(&mut study)?;
        Ok(study)
    }

    /// Runs a study.
    pub fn simulate(&self, study: &Study) -> Result<Dataset, Error> {
        let dataset = simulate(&Plan::new(study)?, &StopOnly(self.watch))?;
        match *dataset.manifest.outcome {
            Outcome::Interrupted { .. } => Err(Error::Interrupted),
            _ => Ok(dataset),
        }
    }

    /// Classifies the motion of a study.
    pub fn classify(&self, study: &Study) -> Result<Verdict, Error> {
        analyse::classify(&Plan::new(study)?, 0.0, &StopOnly(self.watch))?.ok_or(Error::Interrupted)
    }

    /// Computes a scan (or continues it) in the folder `name`, and reads it: its plan, and one summary per cell.
    pub fn scan(&self, name: &str, study: &Study) -> Result<(ScanPlan, Vec<CellSummary>), Error> {
        // as in the paper, motions grow from small perturbations of a circle
        let study = Study { random: study.random.or(Some(Random::SMALL)), ..study.clone() };
        let plan = ScanPlan::new(&study)?;
        let folder = self.out.join(format!("{name}{}-scan", if self.quick { "-quick" } else { "" }));
        let scan = Scan::open(&folder, &plan, Shard::WHOLE, Opening::Resume)?;
        if !scan.run(&Classify, self.threads, self.watch)?.complete {
            return Err(Error::Interrupted);
        }
        let cells = cells(scan.folder())?.into_iter().flatten().collect();
        Ok((plan, cells))
    }
}

/// Progress of chapters that are computed in parallel.
pub struct Progress<'m> {
    watch: &'m dyn Watch,
    /// Of each chapter: its share of the work, and the part of it that is done (bits of a number that only grows).
    parts: Vec<(f64, AtomicU64)>,
}

impl<'m> Progress<'m> {
    /// Progress of chapters with these shares of the work.
    pub fn new(watch: &'m dyn Watch, work: &[f64]) -> Self {
        let total: f64 = work.iter().sum();
        Self { watch, parts: work.iter().map(|work| (work / total, AtomicU64::new(0))).collect() }
    }
}

/// The share of a chapter in the whole.
pub struct Share<'p> {
    /// That of all chapters.
    pub progress: &'p Progress<'p>,
    /// The chapter.
    pub index: usize,
}

impl Watch for Share<'_> {
    fn progress(&self, done: f64) {
        // The bits of numbers from 0 on are ordered like the numbers.
        self.progress.parts[self.index].1.fetch_max(done.max(0.0).to_bits(), Ordering::Relaxed);
        let part = |(share, done): &(f64, AtomicU64)| share * f64::from_bits(done.load(Ordering::Relaxed));
        self.progress.watch.progress(self.progress.parts.iter().map(part).sum());
    }

    fn note(&self, text: &str) {
        self.progress.watch.note(text);
    }

    fn stopped(&self) -> bool {
        self.progress.watch.stopped()
    }
}
