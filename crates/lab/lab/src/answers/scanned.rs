//! The contents of a scan.

use crate::scan::{ScanFolder, Totals};
use motiform_analysis::Regime;
use motiform_study::{Error, Random, counted};
use serde::Serialize;
use std::fmt::{Display, Formatter, Result};
use std::path::Path;

/// The totals of a scan.
#[derive(Clone, Debug, Serialize)]
pub struct Scanned<'a> {
    plan_hash: &'a str,
    cells: usize,
    random: Random,
    rows: usize,
    regimes: serde_json::Map<String, serde_json::Value>,
    /// By regime and course, where the model tells directions apart.
    #[serde(skip_serializing_if = "serde_json::Map::is_empty")]
    courses: serde_json::Map<String, serde_json::Value>,
    multistable: usize,
    undetermined: usize,
    escaped: usize,
    missing: usize,
    folder: &'a Path,
    #[serde(skip)]
    read: &'a ScanFolder,
    #[serde(skip)]
    totals: &'a Totals,
    /// `true` if initial states were drawn.
    #[serde(skip)]
    drawn: bool,
}

impl<'a> Scanned<'a> {
    /// The totals of a folder.
    ///
    /// # Errors
    /// An unknown model.
    pub fn new(read: &'a ScanFolder, totals: &'a Totals) -> std::result::Result<Self, Error> {
        let plan = read.plan();
        let regimes = totals.regimes().map(|(regime, rows)| (regime.name().to_owned(), rows.into()));
        Ok(Self {
            plan_hash: &read.manifest().plan_hash,
            cells: plan.cells(),
            random: plan.computation.random,
            rows: totals.rows,
            regimes: regimes.collect(),
            courses: totals.regimes().filter_map(|(regime, _)| courses(totals, regime)).collect(),
            multistable: totals.multistable,
            undetermined: totals.undetermined,
            escaped: totals.escaped,
            missing: totals.missing,
            folder: read.path(),
            read,
            totals,
            drawn: plan.computation.samples > 1 || plan.draws_first()?,
        })
    }
}

/// The name of a regime, and its rows by course; `None` where the model has no directions.
fn courses(totals: &Totals, regime: Regime) -> Option<(String, serde_json::Value)> {
    let all: serde_json::Map<_, _> =
        totals.courses(regime).map(|(course, rows)| (course.name().to_owned(), rows.into())).collect();
    (!all.is_empty()).then(|| (regime.name().to_owned(), all.into()))
}

impl Display for Scanned<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let (plan, totals) = (self.read.plan(), self.totals);
        writeln!(f, "{} ({}, {})", plan.title, plan.computation.model, plan.name)?;
        for axis in &plan.computation.axes {
            writeln!(f, "axis      {axis}")?;
        }
        let (cells, samples) = (totals.cells, plan.computation.samples);
        writeln!(f, "cells     {cells} of {}, {} each", plan.cells(), counted(samples, "initial state"))?;
        if self.drawn {
            let (random, seed) = (plan.computation.random.words(), plan.computation.seed);
            writeln!(f, "          random ones {random}, seed {seed}")?;
        }
        for (regime, rows) in totals.regimes() {
            let share = 100.0 * rows as f64 / totals.rows as f64;
            writeln!(f, "          {:18} {} ({share:.1} %)", regime.words(), counted(rows, "row"))?;
            for (course, rows) in totals.courses(regime) {
                writeln!(f, "            {:20} {}", course.words(), counted(rows, "row"))?;
            }
        }
        let special = [
            (totals.multistable, "with more than one motion"),
            (totals.undetermined, "undetermined"),
            (totals.escaped, "with an escape"),
        ];
        for (count, what) in special.into_iter().filter(|entry| entry.0 > 0) {
            writeln!(f, "          {} {what}", counted(count, "cell"))?;
        }
        for (why, rows) in totals.reasons.told() {
            writeln!(f, "            {} undetermined: {why}", counted(rows, "row"))?;
        }
        write!(f, "folder    {}", self.folder.display())
    }
}
