//! A change of the magnification: the sizes of all cells change at one frame, and stay.

use super::grid::Grid;
use motiform_dynamics::sample::{mean, median};
use motiform_tracks::modes::CellModes;
use serde::Serialize;

/// Multiple of the usual common change of a frame, and of its error, that a change of the magnification exceeds.
const CLEAR: f64 = 8.0;
/// Least change of lengths.
const LEAST: f64 = 0.02;
/// Square of the part of a change by which cells may differ.
const OF_A_PART: f64 = 1.0 / 9.0;
/// Fewest cells in common.
const LEAST_CELLS: usize = 3;
/// Frames on both sides over which sizes stay as they are.
const SIDE: usize = 5;

/// A factor that the lengths of all cells change by at one frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Magnification {
    /// The first frame after it.
    pub frame: i64,
    /// Lengths after it over those before.
    pub factor: f64,
    /// Cells that show it.
    pub cells: usize,
}

/// The largest change of the mean of ln(area)/2 over three cells and more that are seen in a frame and in one of five before, if it is
/// above 2 %, 8 times the usual one (1.4826 times the median size) and 8 times its error over cells; medians over five frames after and
/// before differ by as much, within a half; and its variance over cells exceeds the usual one (median) by less than the square of a
/// third of it: of a part of the cells that shrinks or swells, and less than nine tenths of them, it exceeds it by more.
pub(super) fn find(grid: &Grid, cells: &[CellModes]) -> Option<Magnification> {
    let sizes: Vec<Vec<Option<f64>>> = cells.iter().map(|cell| sizes(grid, cell)).collect();
    let side = |k: usize| k.saturating_sub(SIDE)..k;
    let changes = |k: usize| -> Vec<f64> {
        let change =
            |own: &Vec<Option<f64>>| Some(own[k]? - own[side(k)].iter().rev().find_map(|size| *size)?);
        sizes.iter().filter_map(change).collect()
    };
    let all = (1..grid.times.len()).map(|k| (k, changes(k))).filter(|(_, own)| own.len() >= LEAST_CELLS);
    let all: Vec<(usize, f64, Vec<f64>)> =
        all.filter_map(|(k, own)| Some((k, mean(own.iter().copied())?, own))).collect();
    let usual = 1.4826 * median(all.iter().map(|one| one.1.abs()))?;
    let (k, change, own) = all.iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
    let variance = |change: f64, own: &[f64]| {
        own.iter().map(|one| (one - change) * (one - change)).sum::<f64>() / (own.len() - 1) as f64
    };
    let scatter = variance(*change, own);
    let is_of_all =
        scatter < median(all.iter().map(|one| variance(one.1, &one.2)))? + change * change * OF_A_PART;
    let error = (scatter / own.len() as f64).sqrt();
    let middle = |sizes: &[Option<f64>]| median(sizes.iter().flatten().copied());
    let stays = |own: &Vec<Option<f64>>| {
        let after = own.len().min(k + SIDE);
        Some(middle(&own[*k..after])? - middle(&own[side(*k)])?)
    };
    let stays = median(sizes.iter().filter_map(stays))?;
    let clear = change.abs() > libm::log(1.0 + LEAST).max(CLEAR * usual.max(error));
    (clear && is_of_all && (stays - change).abs() < 0.5 * change.abs()).then(|| Magnification {
        frame: grid.frame(*k),
        factor: libm::exp(*change),
        cells: own.len(),
    })
}

/// Half the logarithm of a cell's area in each frame in which it is seen.
fn sizes(grid: &Grid, cell: &CellModes) -> Vec<Option<f64>> {
    let mut sizes = vec![None; grid.times.len()];
    for frame in cell.frames.iter().filter(|frame| frame.is_seen() && frame.area > 0.0) {
        if let Some(size) = grid.place(frame.frame).and_then(|k| sizes.get_mut(k)) {
            *size = Some(0.5 * libm::log(frame.area));
        }
    }
    sizes
}
