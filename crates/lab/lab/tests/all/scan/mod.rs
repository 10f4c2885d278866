//! Scans: the same bytes for any threads, shards and interruptions; damage is found; memory is bounded.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test may fail")]

mod bits;
mod damage;
mod rows;

use crate::common;

use common::preset;
use motiform_analysis::regime::{Attractor, Regime, Spread, Verdict};
use motiform_dynamics::Watch;
use motiform_lab::scan::{Axis, Ended, Evaluate, Opening, Scan, Shard};
use motiform_study::{Error, ScanPlan, Study};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;
use tempfile::TempDir;

/// The evaluation of these tests: numbers that depend on the model and the start, undefined ones among them, at once.
struct Toy;

impl Evaluate for Toy {
    fn evaluate(
        &self,
        plan: &ScanPlan,
        cell: usize,
        sample: usize,
        stop: &dyn Watch,
    ) -> Result<Option<Verdict>, Error> {
        if stop.stopped() {
            return Ok(None);
        }
        if cell.is_multiple_of(7) && sample == 0 {
            std::thread::sleep(Duration::from_millis(1)); // rows of one part end in any order
        }
        let model = plan.model_of(cell)?;
        let start = plan.start(cell, sample, model.as_ref())?;
        let mut rate = start.clone();
        model.eval(0.0, &start, &mut rate);
        let regime = if rate[0] > 0.0 { Regime::Zigzag } else { Regime::Straight };
        let verdict = Verdict::new(regime, Attractor::Periodic, format!("{:?}", rate[0]), start[0]);
        let speed = Spread { mean: rate[1], min: -0.0, max: f64::MAX, error: None };
        Ok(Some(Verdict { speed: Some(speed), period: (sample > 0).then_some(rate[2]), ..verdict }))
    }
}

fn study(change: impl FnOnce(&mut Study)) -> Study {
    preset("fig1", |study| {
        study.scan.axes =
            ["kappa2=0.1:1.6:40", "gamma=0.1:1.5:30"].map(|text| Axis::parse(text).unwrap()).into();
        study.scan.samples = 3;
        change(study);
    })
}

fn plan() -> ScanPlan {
    ScanPlan::new(&study(|_| ())).unwrap()
}

fn open(path: &Path, plan: &ScanPlan, shard: &str, opening: Opening) -> Result<Scan, Error> {
    Scan::open(path, plan, Shard::parse(shard).unwrap(), opening)
}

/// A whole scan, or a shard of it, in a folder.
fn compute(path: &Path, plan: &ScanPlan, shard: &str, threads: usize) -> Ended {
    open(path, plan, shard, Opening::New).unwrap().run(&Toy, threads, &()).unwrap()
}

/// Every file that is no lock, with its bytes.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    let named = entries.map(|entry| (entry.file_name().into_string().unwrap(), entry.path()));
    named
        .filter(|(name, _)| name != ".lock")
        .map(|(name, path)| (name, std::fs::read(path).unwrap()))
        .collect()
}

fn folder() -> (TempDir, impl Fn(&str) -> PathBuf) {
    let folder = TempDir::new().unwrap();
    let root = folder.path().to_owned();
    (folder, move |name: &str| root.join(name))
}
