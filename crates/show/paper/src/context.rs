//! Common tools of all chapters: running studies, classifying motions, computing and storing scans.

use super::fault::Fault;
use super::kept::Kept;
use motiform_analysis::{Estimate, Lyapunov, Verdict};
use motiform_diagrams::Branches;
use motiform_dynamics::{Outcome, StopOnly, Watch};
use motiform_figures::report::{Claim, ReportFigure, Verdict as Judged};
use motiform_figures::{Drawn, Figure, Style};
use motiform_lab::analyse::{self, Spans};
use motiform_lab::draw::sheet_in;
use motiform_lab::pool;
use motiform_lab::saddle::{Saddle, saddle};
use motiform_lab::scan::{CellSummary, Classify, Opening, Scan, Shard, cells};
use motiform_lab::simulate::simulate;
use motiform_study::{BranchPlan, Dataset, Error, Random, RunPlan, ScanPlan, Study, presets};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// The settings of a chapter.
pub(crate) struct Context<'c> {
    /// Scans are kept in folders here.
    pub out: &'c Path,
    /// Less evidence in less time.
    pub quick: bool,
    /// Threads of scans; changes no number.
    pub threads: usize,
    /// The style of figures.
    pub style: &'c Style,
    /// Progress, and whether to stop.
    pub watch: &'c dyn Watch,
    /// The results that are computed once for all chapters.
    pub kept: &'c Kept,
    /// The change that a test of the claims makes; none in a reproduction.
    pub fault: Option<&'c Fault>,
}

/// Places or runs that a statement about a range needs at least.
const ENOUGH: usize = 3;

impl Context<'_> {
    /// `full`, or `quick` in a quick run.
    pub(crate) fn choose<T>(&self, full: T, quick: T) -> T {
        if self.quick { quick } else { full }
    }

    /// `answer` to each item, on all threads, in the order of the items.
    pub(crate) fn each<I: Sync, A: Send>(
        &self,
        items: &[I],
        answer: impl Fn(&I) -> Result<A, Error> + Sync,
    ) -> Result<Vec<A>, Error> {
        pool::each(items, self.threads, self.watch, answer)
    }

    /// A watch for stopping only.
    pub(crate) fn quiet(&self) -> impl Watch + '_ {
        StopOnly(self.watch)
    }

    /// The study of a preset with changes.
    pub(crate) fn preset(
        &self,
        name: &str,
        change: impl FnOnce(&mut Study) -> Result<(), Error>,
    ) -> Result<Study, Error> {
        let mut study = presets::find_any(name, "tensor")?;
        change(&mut study)?;
        self.changed(&mut study, |fault| fault.study);
        Ok(study)
    }

    /// Runs a study.
    pub(crate) fn simulate(&self, study: &Study) -> Result<Dataset, Error> {
        let plan = RunPlan::new(study)?;
        let run = || {
            let dataset = simulate(&plan, &StopOnly(self.watch))?;
            match dataset.manifest.outcome.outcome {
                Outcome::Interrupted { .. } => Err(Error::Interrupted),
                _ => Ok(dataset),
            }
        };
        let mut dataset = self.kept.once(&format!("run {}", plan.hash()), run)?;
        dataset.manifest.plan = plan; // its name and drawing are no part of the hash
        self.changed(&mut dataset, |fault| fault.run);
        Ok(dataset)
    }

    /// Classifies the motion of a study.
    pub(crate) fn classify(&self, study: &Study) -> Result<Verdict, Error> {
        let plan = RunPlan::new(study)?;
        let classify = || analyse::classify(&plan, 0.0, &StopOnly(self.watch))?.ok_or(Error::Interrupted);
        let mut verdict = self.kept.once(&format!("motion {}", plan.hash()), classify)?;
        self.changed(&mut verdict, |fault| fault.verdict);
        Ok(verdict)
    }

    /// The largest exponents of a study's motion: `times` are those before and of the average.
    pub(crate) fn lyapunov(&self, study: &Study, count: usize, times: (f64, f64)) -> Result<Lyapunov, Error> {
        let plan = RunPlan::new(study)?;
        let compute = || {
            let times = Spans { transient: Some(times.0), t_end: Some(times.1) };
            let found = analyse::lyapunov(&plan, count, times, &StopOnly(self.watch))?;
            match found.outcome {
                Outcome::Interrupted { .. } => Err(Error::Interrupted),
                _ => Ok(found),
            }
        };
        let name = format!("exponents {count} {times:?} {}", plan.hash());
        let mut found = self.kept.once(&name, compute)?;
        found.exponents.iter_mut().for_each(|exponent| self.changed(exponent, |fault| fault.estimate));
        Ok(found)
    }

    /// The chaotic saddle of a study's parameters.
    pub(crate) fn saddle(&self, study: &Study, runs: usize, times: Spans) -> Result<Saddle, Error> {
        let plan = RunPlan::new(study)?;
        let watch = StopOnly(self.watch);
        let compute =
            || saddle(&plan, runs, Random::SMALL, times, self.threads, &watch)?.ok_or(Error::Interrupted);
        let mut found = self.kept.once(&format!("saddle {runs} {times:?} {}", plan.hash()), compute)?;
        let estimates = found.exponent.iter_mut().chain(&mut found.rate);
        estimates.for_each(|estimate| self.changed(estimate, |fault| fault.estimate));
        Ok(found)
    }

    /// The branches of a plan, to their ends.
    pub(crate) fn follow(&self, plan: &BranchPlan) -> Result<Arc<Branches>, Error> {
        let follow = || {
            let found = motiform_diagrams::follow(plan, None, &self.quiet())?;
            if found.complete { Ok(Arc::new(found)) } else { Err(Error::Interrupted) }
        };
        self.kept.once(&format!("branches {}", plan.hash()), follow)
    }

    /// A number on its way to a claim.
    pub(crate) fn number(&self, x: f64) -> f64 {
        self.fault.map_or(x, |fault| (fault.number)(x))
    }

    /// An estimate on its way to a claim.
    pub(crate) fn estimate(&self, mut estimate: Estimate) -> Estimate {
        self.changed(&mut estimate, |fault| fault.estimate);
        estimate
    }

    fn changed<T>(&self, result: &mut T, change: impl FnOnce(&Fault) -> fn(&mut T)) {
        if let Some(fault) = self.fault {
            change(fault)(result);
        }
    }

    /// Drawings: none where claims are tested.
    pub(crate) fn drawn(
        &self,
        draw: &dyn Fn() -> Result<Vec<ReportFigure>, Error>,
    ) -> Result<Vec<ReportFigure>, Error> {
        if self.fault.is_some() { Ok(Vec::new()) } else { draw() }
    }

    /// A figure in the style that is asked for, with its data.
    pub(crate) fn sheet(&self, figure: impl Figure) -> Result<Drawn, Error> {
        sheet_in(figure, self.style)
    }

    /// The claim, which rests on so many places or runs: with too few it is not judged, unless it fails.
    pub(crate) fn resting_on(&self, count: usize, what: &str, claim: Claim) -> Claim {
        if count >= ENOUGH || self.fault.is_some() || matches!(claim.verdict, Judged::Fails { .. }) {
            return claim;
        }
        let version = self.choose("not judged", "not judged in the quick version");
        let explanation = format!(
            "{version}: it rests on {count} {}, and needs at least {ENOUGH}",
            if count == 1 { what.trim_end_matches('s') } else { what }
        );
        Claim { verdict: Judged::Unjudged { explanation }, ..claim }
    }

    /// Computes a scan (or continues it) in the folder `name`, and reads it: its plan, and one summary per cell.
    pub(crate) fn scan(&self, name: &str, study: &Study) -> Result<(ScanPlan, Vec<CellSummary>), Error> {
        // as in the paper, motions grow from small perturbations of a circle
        let study = Study { random: study.random.or(Some(Random::SMALL)), ..study.clone() };
        let plan = ScanPlan::new(&study)?;
        let scan = || self.scanned(name, &plan);
        let mut cells = self.kept.once(&format!("scan {name} {}", plan.hash()), scan)?;
        cells.iter_mut().for_each(|cell| self.changed(cell, |fault| fault.cells));
        Ok((plan, cells))
    }

    fn scanned(&self, name: &str, plan: &ScanPlan) -> Result<Vec<CellSummary>, Error> {
        let folder = self.out.join(format!("{name}{}-scan", if self.quick { "-quick" } else { "" }));
        let scan = Scan::open(&folder, plan, Shard::WHOLE, Opening::Resume)?;
        if !scan.run(&Classify, self.threads, self.watch)?.complete {
            return Err(Error::Interrupted);
        }
        Ok(cells(scan.folder())?.into_iter().flatten().collect())
    }
}

/// Progress of chapters that are computed in parallel.
pub(crate) struct Progress<'m> {
    watch: &'m dyn Watch,
    /// Of each chapter: its share of the work, and the part of it that is done (bits of a number that only grows).
    parts: Vec<(f64, AtomicU64)>,
}

impl<'m> Progress<'m> {
    /// Progress of chapters with these shares of the work.
    pub(crate) fn new(watch: &'m dyn Watch, work: &[f64]) -> Self {
        let total: f64 = work.iter().sum();
        Self { watch, parts: work.iter().map(|work| (work / total, AtomicU64::new(0))).collect() }
    }
}

/// The share of a chapter in the whole.
pub(crate) struct Share<'p> {
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

#[cfg(test)]
mod tests {
    use super::super::claims::claim;
    use super::*;

    #[test]
    fn too_few_places_allow_no_judgement_but_a_failure_stays_one() {
        let kept = Kept::default();
        let mut context = Context {
            out: Path::new("."),
            quick: true,
            threads: 1,
            style: &Style::default(),
            watch: &(),
            kept: &kept,
            fault: None,
        };
        let one = |holds| claim(&[1], "it moves", "it does", "by looking", holds);
        let verdict =
            |context: &Context<'_>, count, holds| context.resting_on(count, "lengths", one(holds)).verdict;
        let thin = verdict(&context, 1, true);
        assert!(
            thin.explanation().is_some_and(|why| why.contains("quick version") && why.contains("1 length,"))
        );
        assert_eq!(verdict(&context, ENOUGH - 1, true).words(), "○ not judged");
        assert_eq!(verdict(&context, ENOUGH, true), Judged::Holds);
        assert!(matches!(verdict(&context, 1, false), Judged::Fails { .. }));
        context.fault = Some(&Fault::NONE);
        assert_eq!(verdict(&context, 1, true), Judged::Holds);
    }
}
