//! Faults that are put into what a chapter computes, on its way to the claims: each claim must fail under one of them.

use motiform_analysis::{Estimate, Verdict};
use motiform_lab::scan::CellSummary;
use motiform_study::{Dataset, Study};

/// A change of what is computed. Without any change claims are judged as they are, those that lack evidence too.
#[derive(Clone, Copy)]
pub struct Fault {
    /// Its name.
    pub name: &'static str,
    /// The model: of every study that a chapter takes from a preset.
    pub study: fn(&mut Study),
    /// Recordings.
    pub run: fn(&mut Dataset),
    /// Motions and their numbers, as the classifier finds them.
    pub verdict: fn(&mut Verdict),
    /// The same in scans.
    pub cells: fn(&mut CellSummary),
    /// Estimates with their errors.
    pub estimate: fn(&mut Estimate),
    /// Single numbers: residuals, edges, rates.
    pub number: fn(f64) -> f64,
}

impl Fault {
    /// No change.
    pub const NONE: Self = Self {
        name: "none",
        study: |_| {},
        run: |_| {},
        verdict: |_| {},
        cells: |_| {},
        estimate: |_| {},
        number: |x| x,
    };
}
