//! Results computed again and compared with what is on disk, bit by bit.

use crate::scan::{Classify, Row, ScanFolder, read_part, rows_of};
use crate::simulate::simulate;
use motiform_dynamics::{Outcome, Watch};
use motiform_files::read_dataset;
use motiform_study::table::Table;
use motiform_study::{Dataset, Error};
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

/// Parts of a scan that are computed again, if not all are.
const PARTS: usize = 3;

/// Rows of a trajectory that are computed again, if not all are.
const ROWS: f64 = 1000.0;

/// What was computed again.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Repeated {
    /// Rows that were compared.
    pub rows: usize,
    /// What is not the same, in sentences.
    pub different: Vec<String>,
}

/// Integrates the plan of a dataset again, from its beginning, and compares every number of the rows; all of them with `all`, otherwise about the first
/// thousand. `None` if the watch stopped it.
///
/// # Errors
/// A folder that cannot be read; a plan whose hash is another; input that only the numerics can reject.
pub fn verify_dataset(folder: &Path, all: bool, watch: &dyn Watch) -> Result<Option<Repeated>, Error> {
    let there = read_dataset(folder)?;
    let (plan, rows) = (&there.manifest.plan, there.trajectory.rows());
    if plan.hash() != there.manifest.plan_hash {
        let reason = "it was changed: its plan does not give its hash";
        return Err(Error::unreadable(&folder.join("manifest.json"), reason));
    }
    let c = &plan.computation;
    let share = (c.transient + c.t_end * (ROWS / rows.max(1) as f64).min(1.0)) / (c.transient + c.t_end);
    let until = Until { watch, share: if all { 1.0 } else { share }, done: AtomicU64::new(0) };
    let again = simulate(plan, &until)?;
    if watch.stopped() {
        return Ok(None);
    }
    Ok(Some(compared(&there, &again)))
}

fn compared(there: &Dataset, again: &Dataset) -> Repeated {
    let mut found = Repeated::default();
    let stopped = |dataset: &Dataset| matches!(*dataset.manifest.outcome, Outcome::Interrupted { .. });
    let rows = there.trajectory.rows().min(again.trajectory.rows());
    found.rows = rows;
    if !(stopped(there) || stopped(again)) && there.trajectory.rows() != again.trajectory.rows() {
        let [there, again] = [there, again].map(|dataset| dataset.trajectory.rows());
        found.different.push(format!("{there} rows there, {again} computed again"));
    }
    differences("trajectory", &there.trajectory, &again.trajectory, rows, &mut found.different);
    if let (Some(there), Some(again)) = (&there.crossings, &again.crossings) {
        let rows = there.rows().min(again.rows());
        differences("crossings", there, again, rows, &mut found.different);
    }
    found
}

/// The first difference of each column.
fn differences(name: &str, there: &Table, again: &Table, rows: usize, found: &mut Vec<String>) {
    for column in &again.columns {
        let Some(values) = there.get(&column.name) else {
            found.push(format!("{name} has no column {}", column.name));
            continue;
        };
        let same = |row: &usize| {
            let (a, b) = (values[*row], column.values[*row]);
            a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
        };
        if let Some(row) = (0..rows).find(|row| !same(row)) {
            let (a, b) = (values[row], column.values[row]);
            found.push(format!("{name}, row {row}, {}: {a:?} there, {b:?} computed again", column.name));
        }
    }
}

/// Computes parts of a scan again and compares every row; all of them with `all`, otherwise the first, a middle and the last one. `None` if the watch
/// stopped it.
///
/// # Errors
/// A folder that cannot be read.
pub fn verify_scan(folder: &Path, all: bool, watch: &dyn Watch) -> Result<Option<Repeated>, Error> {
    let folder = ScanFolder::read(folder)?;
    let (plan, parts) = (folder.plan(), folder.parts());
    let there: Vec<usize> = (0..plan.parts()).filter(|&part| parts.path(part).is_file()).collect();
    let chosen: Vec<usize> = if all || there.len() <= PARTS {
        there
    } else {
        [0, there.len() / 2, there.len() - 1].map(|place| there[place]).to_vec()
    };
    let mut found = Repeated::default();
    for (number, part) in chosen.iter().copied().enumerate() {
        let name = parts.path(part).file_name().unwrap_or_default().to_string_lossy().into_owned();
        let Ok(rows) =
            parts.check(part).map_err(|_| ()).and_then(|_| read_part(plan, &parts, part).map_err(|_| ()))
        else {
            found.different.push(format!("{name} is damaged"));
            continue;
        };
        let again = rows_of(plan, plan.cells_of(part), &|| true, &Classify, watch);
        let Some(again) = again.filter(|_| !watch.stopped()) else { return Ok(None) };
        found.rows += rows.len();
        if let Some(row) = first_difference(&rows, &again) {
            found
                .different
                .push(format!("{name}, cell {}, start {}: other numbers computed again", row.0, row.1));
        }
        watch.progress((number + 1) as f64 / chosen.len() as f64);
    }
    Ok(Some(found))
}

fn first_difference(there: &[Row], again: &[Row]) -> Option<(usize, usize)> {
    let other = there.iter().zip(again).find(|(a, b)| !a.is_same(b)).map(|(row, _)| (row.cell, row.sample));
    other.or_else(|| (there.len() != again.len()).then_some((there.len(), 0)))
}

/// A watch that also stops when a share of the work is done.
struct Until<'w> {
    watch: &'w dyn Watch,
    share: f64,
    /// The bits of the share that is done: they grow with it.
    done: AtomicU64,
}

impl Watch for Until<'_> {
    fn progress(&self, done: f64) {
        self.done.fetch_max(done.max(0.0).to_bits(), Ordering::Relaxed);
        self.watch.progress((done / self.share).min(1.0));
    }

    fn stopped(&self) -> bool {
        self.watch.stopped() || f64::from_bits(self.done.load(Ordering::Relaxed)) > self.share
    }
}
