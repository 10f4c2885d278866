//! A run computed again.

use super::Repeated;
use super::rows::{Compared, difference, groups};
use crate::dataset::{read_dataset_by, trajectory_path};
use crate::simulate::{columns, simulate_into};
use motiform_dynamics::{Outcome, Watch};
use motiform_store::read_groups;
use motiform_store::table::Table;
use motiform_study::{Dataset, Error};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

/// Rows of a trajectory that are computed again, if not all are.
const ROWS: usize = 1000;

/// Integrates the plan of a dataset again, from its beginning, and compares every number of the rows; all of
/// them with `all`, otherwise the first thousand. The memory it takes does not grow with the trajectory.
/// `None` if the watch stopped it.
///
/// # Errors
/// A folder that cannot be read; a plan whose hash is another; input that only the numerics can reject.
pub fn verify_dataset(folder: &Path, all: bool, watch: &dyn Watch) -> Result<Option<Repeated>, Error> {
    let there = read_dataset_by(folder, &|_, path| first_group(path))?;
    let plan = &there.manifest.plan;
    plan.is_hashed_as(&there.manifest.plan_hash, folder)?;
    let path = trajectory_path(folder)?;
    let enough = AtomicBool::new(false);
    let c = &plan.computation;
    let part = if all { c.t_end } else { (ROWS as f64 * c.dt_out).min(c.t_end) };
    let share = (c.transient + part) / (c.transient + c.t_end);
    let until = Until { watch, share, enough: &enough };
    std::thread::scope(|scope| {
        let open = || groups(scope, &path);
        let most = if all { usize::MAX } else { ROWS };
        let mut rows = Compared::new(&open, columns(plan)?, most, &enough);
        let again = simulate_into(plan, &mut rows, &until)?;
        if watch.stopped() {
            return Ok(None);
        }
        let mut found = judged(rows, is_whole(&there), most, &enough)?;
        if !matches!(again.manifest.outcome.outcome, Outcome::Interrupted { .. }) {
            crossings(&there, again.crossings.as_ref(), &mut found.different);
        }
        Ok(Some(found))
    })
}

/// Returns `true` if nobody interrupted it: the rows of an interrupted run are compared, and those that it
/// lacks are no difference.
fn is_whole(dataset: &Dataset) -> bool {
    !matches!(dataset.manifest.outcome.outcome, Outcome::Interrupted { .. })
}

/// The result of the comparison, with the number of rows of a run that was not interrupted.
fn judged(mut rows: Compared<'_>, whole: bool, most: usize, enough: &AtomicBool) -> Result<Repeated, Error> {
    let is_longer = rows.finish()?;
    let count = rows.rows;
    let mut different: Vec<String> =
        rows.different().into_iter().map(|found| format!("trajectory, {found}")).collect();
    if whole && count < most && is_longer {
        different.push(format!("trajectory, more than the {count} rows that are computed again"));
    }
    if whole && count < most && !is_longer && enough.load(Ordering::Relaxed) {
        different.push(format!("trajectory, only {count} rows, and more are computed again"));
    }
    Ok(Repeated { rows: count, different })
}

/// The rows that a trajectory begins with.
fn first_group(path: &Path) -> Result<Table, Error> {
    let mut first = None;
    let mut take = |group: Table| {
        if first.is_none() {
            first = Some(group);
            Ok(())
        } else {
            Err(Error::Interrupted)
        }
    };
    let read = read_groups(path, &mut take);
    match first {
        Some(first) => Ok(first),
        None => read.map(|()| Table::default()),
    }
}

/// Compares the crossings of a return map, of a run that was computed to its end.
fn crossings(there: &Dataset, again: Option<&Table>, different: &mut Vec<String>) {
    let (Some(there), Some(again)) = (&there.crossings, again) else { return };
    if there.rows() != again.rows() {
        different.push(format!("{} crossings there, {} computed again", there.rows(), again.rows()));
        return;
    }
    for column in &again.columns {
        let values = there.get(&column.name).unwrap_or(&[]);
        let found = difference(&column.name, 0, values, &column.values);
        different.extend(found.map(|found| format!("crossings, {found}")));
    }
}

/// A watch that also stops where enough rows are compared.
struct Until<'w> {
    watch: &'w dyn Watch,
    /// Of the run, that is computed.
    share: f64,
    enough: &'w AtomicBool,
}

impl Watch for Until<'_> {
    fn progress(&self, done: f64) {
        self.watch.progress((done / self.share).min(1.0));
    }

    fn stopped(&self) -> bool {
        self.watch.stopped() || self.enough.load(Ordering::Relaxed)
    }
}
