//! A search for quasi-periodic motion in the first window.

use super::super::context::Context;
use super::lengths::study;
use motiform_analysis::Regime;
use motiform_study::Error;

/// Lengths through the edge between circular and rectangular motion.
const FULL: [f64; 8] = [12.94, 12.955, 12.965, 12.97, 12.975, 12.98, 13.0, 13.03];
const QUICK: [f64; 4] = [12.96, 12.968, 12.975, 12.98];

/// The runs and their results.
pub(super) struct Search {
    lengths: Vec<f64>,
    /// Runs.
    pub(super) runs: usize,
    /// Those that were quasi-periodic.
    pub(super) found: usize,
    regimes: Vec<Regime>,
}

impl Search {
    pub(super) fn make(context: &Context<'_>) -> Result<Self, Error> {
        let lengths = context.choose(FULL.to_vec(), QUICK.to_vec());
        let seeds = context.choose(4, 1);
        let runs: Vec<(f64, u64)> =
            lengths.iter().flat_map(|l| (1..=seeds).map(move |seed| (*l, seed))).collect();
        let one = |&(length, seed): &(f64, u64)| {
            let mut study = study(length, 10)?;
            study.run.seed = seed;
            Ok(context.classify(&study)?.regime)
        };
        let regimes: Vec<Regime> = context.each(&runs, one)?;
        let found = regimes.iter().filter(|regime| **regime == Regime::QuasiPeriodic).count();
        Ok(Self { lengths, runs: runs.len(), found, regimes })
    }

    pub(super) fn words(&self) -> String {
        let counts: Vec<String> = Regime::ALL
            .into_iter()
            .map(|regime| (regime, self.regimes.iter().filter(|found| **found == regime).count()))
            .filter(|entry| entry.1 > 0)
            .map(|(regime, count)| format!("{count} {regime}"))
            .collect();
        let [first, last] =
            [self.lengths.first(), self.lengths.last()].map(|l| l.copied().unwrap_or(f64::NAN));
        format!(
            "of {} runs at {} lengths from {first} to {last}, {} quasi-periodic ({})",
            self.runs,
            self.lengths.len(),
            self.found,
            counts.join(", ")
        )
    }
}
