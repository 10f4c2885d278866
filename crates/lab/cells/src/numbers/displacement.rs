//! Mean-square displacement of places with gaps, by the estimator of [`motiform_statistics`].

use super::places::Places;
use crate::AtLag;
use motiform_inference::{Fix, PersistentWalk};
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
/// Intervals: eight blocks of the record by where pairs begin, each left out in turn, at lags up to an eighth of the record, [`widened`] by
/// the memory of the walk; none without a walk.
pub(super) fn of_cell(places: &Places, walk: Option<&PersistentWalk>) -> Vec<AtLag> {
    let grids = grids(places);
    let whole: usize = grids.iter().map(Vec::len).sum();
    let before = grids.iter().scan(0, |sum, grid| Some(std::mem::replace(sum, *sum + grid.len())));
    let groups: Vec<_> =
        before.map(|before| move |k: usize| ((before + k) * GROUPS / whole).min(GROUPS - 1)).collect();
    let pieces: Vec<PathPiece<'_>> =
        grids.iter().zip(&groups).map(|(position, group)| PathPiece { position, group }).collect();
    let longest = WITH_INTERVAL * whole as f64 * places.interval;
    let points = points(&mean_square_of_paths(places.interval, &pieces, GROUPS), longest);
    widened(points, whole as f64 * places.interval, walk.map(|walk| walk.persistence.value))
}

/// Largest ratio of the error of a mean over a record to that over blocks which are taken as independent.
const MOST_WIDENED: f64 = 3.0;

/// Curves of a record whose intervals are those over eight blocks of it, as for independent ones, with intervals for blocks that share
/// their memory: squared displacements over a lag keep their correlation for a third of the lag (Brownian motion) and half of the
/// persistence time (straight motion) together. For a correlation exp(-t/m) a mean over the time b has the variance
/// `g(b) = 2 m/b (1 - m/b (1 - e^{-b/m}))`, and that over the record T of G blocks B is `(G - 1) g(T)/(g(B) - g(T))` of what the blocks
/// show. No interval above 9 times the variance, or without a walk: the record is too short to show one.
pub(crate) fn widened(points: Vec<AtLag>, record: f64, persistence: Option<f64>) -> Vec<AtLag> {
    let ratio = |lag: f64| {
        let memory = lag / 3.0 + 0.5 * persistence?;
        let g = |time: f64| {
            let x = time / memory;
            2.0 / x * (1.0 + libm::expm1(-x) / x)
        };
        let (whole, block) = (g(record), g(record / GROUPS as f64));
        Some(((GROUPS - 1) as f64 * whole / (block - whole)).sqrt()).filter(|ratio| *ratio <= MOST_WIDENED)
    };
    let wider = |mut at: AtLag| {
        let Measured { value, interval } = at.value;
        let ends = interval.zip(ratio(at.lag));
        at.value.interval =
            ends.map(|(ends, by)| ends.map(|end| value * libm::exp(by * libm::log(end / value))));
        at.value.interval = at.value.interval.filter(|ends| ends.iter().all(|end| end.is_finite()));
        at
    };
    points.into_iter().map(wider).collect()
}

/// The same over cells of one sampling interval; intervals by leaving out cells, or groups of them, from 8 cells on. Groups are those of
/// cells in the order of their lengths and first places, whatever their order in the file.
pub(super) fn of_cells(cells: &[&Places]) -> Vec<AtLag> {
    let interval = cells.first().map_or(0.0, |places| places.interval);
    let mut grids: Vec<_> = cells.iter().map(|places| grids(places)).collect();
    grids.sort_by(|a, b| key(a).0.cmp(&key(b).0).then_with(|| by_place(key(a).1, key(b).1)));
    let count = cells.len().min(MOST_GROUPS);
    let groups: Vec<_> = (0..cells.len()).map(|number| move |_: usize| number % count).collect();
    let of_cell = grids.iter().zip(&groups);
    let pieces: Vec<PathPiece<'_>> = of_cell
        .flat_map(|(grids, group)| grids.iter().map(move |position| PathPiece { position, group }))
        .collect();
    let longest = if cells.len() < GROUPS { 0.0 } else { f64::INFINITY };
    points(&mean_square_of_paths(interval, &pieces, count), longest)
}

/// Most groups of cells.
const MOST_GROUPS: usize = 64;

/// The length of a cell's record, and its first place.
fn key(grids: &[Vec<[f64; 2]>]) -> (usize, [f64; 2]) {
    let first = grids.first().and_then(|grid| grid.first());
    (grids.iter().map(Vec::len).sum(), first.copied().unwrap_or_default())
}

/// The order of places.
pub(crate) fn by_place(a: [f64; 2], b: [f64; 2]) -> std::cmp::Ordering {
    a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1]))
}

/// The curve where it is known, with intervals up to the longest lag that has them.
fn points(curve: &MeanSquare, longest: f64) -> Vec<AtLag> {
    let point = |place: usize| {
        let lag = curve.lag(place);
        let measured = curve.measured(place);
        let interval = measured.interval.filter(|_| lag <= longest && measured.value > 0.0);
        curve.is_known(place).then_some(AtLag { lag, value: Measured { interval, ..measured } })
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
