//! Mean-square displacement of places with gaps, by the estimator of [`motiform_statistics`].

use super::places::Places;
use crate::AtLag;
use motiform_inference::Fix;
use motiform_statistics::{MeanSquare, Measured, PathPiece, mean_square_of_paths};

/// Blocks of a record, and groups of cells, that are left out in turn.
const GROUPS: usize = 8;
/// Longest lag with an interval from blocks, as a part of the record.
const WITH_INTERVAL: f64 = 0.125;
/// Most intervals of a record: a grid of them is held in memory.
const MOST: f64 = 1e6;

/// Mean of |r(t + lag) - r(t)|^2 over all pairs of places that are seen so far apart, in one piece.
///
/// Each pair has the same weight. Lags are multiples of the sampling interval; places at other times count at the nearest one.
/// Intervals: eight blocks of the record by where pairs begin, each left out in turn, at lags up to an eighth of the record.
pub(super) fn of_cell(places: &Places) -> Vec<AtLag> {
    let grids = grids(places);
    let whole: usize = grids.iter().map(Vec::len).sum();
    let before = grids.iter().scan(0, |sum, grid| Some(std::mem::replace(sum, *sum + grid.len())));
    let groups: Vec<_> =
        before.map(|before| move |k: usize| ((before + k) * GROUPS / whole).min(GROUPS - 1)).collect();
    let pieces: Vec<PathPiece<'_>> =
        grids.iter().zip(&groups).map(|(position, group)| PathPiece { position, group }).collect();
    let longest = WITH_INTERVAL * whole as f64 * places.interval;
    points(&mean_square_of_paths(places.interval, &pieces, GROUPS), longest)
}

/// The same over cells of one sampling interval; intervals by leaving out groups of cells, from 8 cells on.
pub(super) fn of_cells(cells: &[&Places]) -> Vec<AtLag> {
    let interval = cells.first().map_or(0.0, |places| places.interval);
    let grids: Vec<_> = cells.iter().map(|places| grids(places)).collect();
    let groups: Vec<_> = (0..cells.len()).map(|number| move |_: usize| number % GROUPS).collect();
    let of_cell = grids.iter().zip(&groups);
    let pieces: Vec<PathPiece<'_>> = of_cell
        .flat_map(|(grids, group)| grids.iter().map(move |position| PathPiece { position, group }))
        .collect();
    let longest = if cells.len() < GROUPS { 0.0 } else { f64::INFINITY };
    points(&mean_square_of_paths(interval, &pieces, GROUPS), longest)
}

/// The curve where it is known, with intervals up to the longest lag that has them.
fn points(curve: &MeanSquare, longest: f64) -> Vec<AtLag> {
    let point = |place: usize| {
        let [known, everywhere] = curve.is_known(place);
        let lag = curve.lag(place);
        let measured = curve.measured(place);
        let interval = measured.interval.filter(|_| everywhere && lag <= longest && measured.value > 0.0);
        known.then_some(AtLag { lag, value: Measured { interval, ..measured } })
    };
    (0..curve.len()).filter_map(point).collect()
}

/// The places of each piece on the grid of the sampling interval; NaN where no frame is seen.
fn grids(places: &Places) -> Vec<Vec<[f64; 2]>> {
    let grid = |piece: &Vec<Fix>| {
        let first = piece.first()?.t;
        let last = places.lag(first, piece.last()?.t);
        if !(0.0..MOST).contains(&last) {
            return None;
        }
        let mut grid = vec![[f64::NAN; 2]; last as usize + 1];
        for fix in piece {
            let place = &mut grid[places.lag(first, fix.t) as usize];
            if place[0].is_nan() {
                *place = fix.at;
            }
        }
        Some(grid)
    };
    places.pieces.iter().filter_map(grid).collect()
}
