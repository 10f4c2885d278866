//! Mean-square displacement of places with gaps.

use super::places::Places;
use crate::AtLag;
use motiform_inference::Fix;
use motiform_statistics::{Measured, jackknife};

/// Blocks of a record, and groups of cells, that are left out in turn.
const GROUPS: usize = 8;
/// Lags per decade.
const PER_DECADE: f64 = 8.0;
/// Longest lag, and longest lag with an interval from blocks, as parts of the record.
const LONGEST: f64 = 0.5;
const WITH_INTERVAL: f64 = 0.125;
/// Most intervals of a record: a grid of them is held in memory.
const MOST: f64 = 1e6;

/// Mean of |r(t + lag) - r(t)|^2 over all pairs of places that are seen so far apart, in one piece.
///
/// Each pair has the same weight. Lags are multiples of the sampling interval (places at other times count at the nearest one), about 8 per decade, up to half of the longest
/// piece. Intervals: eight blocks of the record by where pairs begin, each left out in turn, on logarithms, at lags up to an eighth of the record.
pub(super) fn of_cell(places: &Places) -> Vec<AtLag> {
    let grids = grids(places);
    let whole: usize = grids.iter().map(Vec::len).sum();
    let longest = grids.iter().map(Vec::len).max().unwrap_or(0);
    let lags = lags((LONGEST * longest as f64) as usize, longest);
    let mut found = Vec::new();
    for lag in lags {
        let (mut sums, mut before) = ([[0.0; 2]; GROUPS], 0);
        for grid in &grids {
            for (k, square) in pairs(grid, lag) {
                add(&mut sums[((before + k) * GROUPS / whole).min(GROUPS - 1)], square);
            }
            before += grid.len();
        }
        let short = lag as f64 <= WITH_INTERVAL * whole as f64;
        found.extend(value(&sums, short).map(|value| AtLag { lag: lag as f64 * places.interval, value }));
    }
    found
}

/// The same over cells of one sampling interval, each pair with the same weight; intervals by leaving out groups of cells, from 8 cells on.
pub(super) fn of_cells(cells: &[&Places]) -> Vec<AtLag> {
    let all: Vec<Vec<Vec<Option<[f64; 2]>>>> = cells.iter().map(|places| grids(places)).collect();
    let longest = all.iter().flatten().map(Vec::len).max().unwrap_or(0);
    let interval = cells.first().map_or(0.0, |places| places.interval);
    let mut found = Vec::new();
    for lag in lags((LONGEST * longest as f64) as usize, longest) {
        let mut sums = [[0.0; 2]; GROUPS];
        for (number, grid) in
            all.iter().enumerate().flat_map(|(k, grids)| grids.iter().map(move |grid| (k, grid)))
        {
            pairs(grid, lag).for_each(|(_, square)| add(&mut sums[number % GROUPS], square));
        }
        let value = value(&sums, cells.len() >= GROUPS);
        found.extend(value.map(|value| AtLag { lag: lag as f64 * interval, value }));
    }
    found
}

/// 1, 2, 3, .. and from there on logarithmically; at least the first where there are two places.
fn lags(longest: usize, places: usize) -> Vec<usize> {
    let ratio = libm::pow(10.0, 1.0 / PER_DECADE);
    let (mut lags, mut lag) = (Vec::new(), 1);
    while lag <= longest.max(usize::from(places > 1)) {
        lags.push(lag);
        lag = (lag + 1).max((lag as f64 * ratio).round() as usize);
    }
    lags
}

/// The places of each piece on the grid of the sampling interval; `None` where no frame is seen.
fn grids(places: &Places) -> Vec<Vec<Option<[f64; 2]>>> {
    let grid = |piece: &Vec<Fix>| {
        let first = piece.first()?.t;
        let last = places.lag(first, piece.last()?.t);
        if !(0.0..MOST).contains(&last) {
            return None;
        }
        let mut grid = vec![None; last as usize + 1];
        for fix in piece {
            grid[places.lag(first, fix.t) as usize].get_or_insert(fix.at);
        }
        Some(grid)
    };
    places.pieces.iter().filter_map(grid).collect()
}

/// Squares of the displacements over a lag, with where they begin.
fn pairs(grid: &[Option<[f64; 2]>], lag: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
    let later = grid.get(lag..).unwrap_or_default();
    grid.iter().zip(later).enumerate().filter_map(|(k, (a, b))| {
        let (a, b) = ((*a)?, (*b)?);
        let [x, y] = [b[0] - a[0], b[1] - a[1]];
        Some((k, x * x + y * y))
    })
}

fn add(group: &mut [f64; 2], square: f64) {
    *group = [group[0] + square, group[1] + 1.0];
}

/// The mean of all groups; `None` without a pair.
fn value(sums: &[[f64; 2]; GROUPS], with_interval: bool) -> Option<Measured> {
    let mean = |left_out: usize| {
        let kept = sums.iter().enumerate().filter(|(group, _)| *group != left_out);
        let [sum, count] = kept.fold([0.0; 2], |all, (_, one)| [all[0] + one[0], all[1] + one[1]]);
        sum / count
    };
    let value = mean(GROUPS);
    if !value.is_finite() {
        return None;
    }
    if !with_interval || value <= 0.0 || sums.iter().any(|group| group[1] == 0.0) {
        return Some(Measured { value, interval: None });
    }
    let without: Vec<f64> = (0..GROUPS).map(|group| libm::log(mean(group))).collect();
    Some(jackknife(libm::log(value), &without).map(libm::exp)).map(|found| Measured { value, ..found })
}
