//! Parts of a scan computed again.

use super::Repeated;
use crate::scan::{Classify, Row, ScanFolder, read_part, rows_of};
use motiform_dynamics::Watch;
use motiform_study::Error;
use std::path::Path;

/// Parts of a scan that are computed again, if not all are.
const PARTS: usize = 3;

/// Computes parts of a scan again and compares every row; all of them with `all`, otherwise the first, a
/// middle and the last one. `None` if the watch stopped it.
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
