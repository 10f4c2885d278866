//! An atlas on disk compared with its plan and its numbers.

use crate::atlas::folder::AtlasFolder;
use crate::atlas::survey::place;
use motiform_dynamics::Watch;
use motiform_lab::pool::all_cores;
use motiform_lab::scan::{Classify, rows_at};
use motiform_lab::verify::Repeated;
use motiform_study::Error;
use std::path::Path;

/// Cells that are computed again, if not all are.
const CELLS: usize = 24;

/// Cells that are computed again together.
const TOGETHER: usize = 192;

/// Classifies cells of an atlas again and compares their motions and numbers: all computed ones with `all`, otherwise some, evenly spaced.
/// `None` if the watch stopped it.
pub(crate) fn verify_atlas(folder: &Path, all: bool, watch: &dyn Watch) -> Result<Option<Repeated>, Error> {
    let AtlasFolder { plan, grid, .. } = AtlasFolder::read(folder)?;
    let computed: Vec<usize> =
        (0..grid.places.len()).filter(|cell| grid.places[*cell].like.is_none()).collect();
    let every = if all { 1 } else { computed.len().div_ceil(CELLS).max(1) };
    let chosen: Vec<usize> = computed.into_iter().step_by(every).collect();
    let scan = plan.scan();
    let mut found = Repeated::default();
    for (number, group) in chosen.chunks(TOGETHER).enumerate() {
        let Some(rows) = rows_at(&scan, group, all_cores(), &Classify, watch)? else { return Ok(None) };
        for (cell, again) in rows.chunk_by(|a, b| a.cell == b.cell).map(place) {
            found.rows += again.motions.iter().map(|motion| motion.rows).sum::<usize>();
            if again != grid.places[cell] {
                found.different.push(format!("cell {cell}: other motions or numbers computed again"));
            }
        }
        watch.progress(((number + 1) * TOGETHER).min(chosen.len()) as f64 / chosen.len() as f64);
    }
    Ok(Some(found))
}
