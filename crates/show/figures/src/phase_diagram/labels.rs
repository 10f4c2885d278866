//! Large grids: the marker of each wide region, once, so that the diagram can be read without colours.

use super::super::geometry::Point;
use super::super::marks::REGIMES;
use super::cells::Cells;
use super::{Paint, Scale, Svg, WHITE};

/// Least distance of a marker from the border of its region, in pixels.
const ROOM: f64 = 11.0;

/// A place on the grid: column, row.
type Place = (usize, usize);

/// Marks every region of one motion alone that is wide enough.
pub(super) fn draw(svg: &mut Svg, scale: &Scale, cells: &Cells) {
    let (columns, rows) = cells.size();
    let cell = (scale.frame.w / columns as f64).min(scale.frame.h / rows as f64);
    for (place, depth, rank) in deepest(cells) {
        if depth as f64 * cell >= ROOM {
            let ([left, right], [low, high]) = (cells.column(place.0), cells.row(place.1));
            let at = scale.map([0.5 * (left + right), 0.5 * (low + high)]);
            svg.circle(at, 8.0, &Paint::fill(WHITE).opacity(0.85));
            REGIMES[rank].draw(svg, at, 4.6);
        }
    }
}

/// For each region: its innermost cell, how many cells that lies from the border, and the regime.
fn deepest(cells: &Cells) -> Vec<(Place, usize, usize)> {
    let (columns, rows) = cells.size();
    let depths = depths(cells);
    let mut seen = vec![false; columns * rows];
    let mut found = Vec::new();
    for start in (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row))) {
        let Some(rank) = alone(cells, start) else { continue };
        let region = region(cells, start, &mut seen);
        let depth = |(column, row): &Place| depths[row * columns + column];
        let most = region.iter().map(depth).max().unwrap_or(0);
        // of equally deep cells the one nearest to the middle: a long band is marked half-way
        let mean =
            |i: fn(&Place) -> usize| region.iter().map(|p| i(p) as f64).sum::<f64>() / region.len() as f64;
        let middle: Point = [mean(|p| p.0), mean(|p| p.1)];
        let off = |p: &Place| (p.0 as f64 - middle[0]).powi(2) + (p.1 as f64 - middle[1]).powi(2);
        let inner = region.iter().filter(|p| depth(p) == most).min_by(|a, b| off(a).total_cmp(&off(b)));
        found.extend(inner.map(|place| (*place, most, rank)));
    }
    found
}

/// The regime of a cell with one motion.
fn alone(cells: &Cells, (column, row): Place) -> Option<usize> {
    match cells.at(column, row)?[..] {
        [(rank, _)] => Some(rank),
        _ => None,
    }
}

/// Number of steps, diagonal ones included, to the nearest cell that differs or lies outside the grid.
fn depths(cells: &Cells) -> Vec<usize> {
    let (columns, rows) = cells.size();
    let mut depths = vec![usize::MAX; columns * rows];
    let mut pass = |(column, row): Place, sides: [(i64, i64); 4]| {
        for (right, up) in sides {
            let place = step((column, row), (right, up), cells);
            let near = place.filter(|p| alone(cells, *p) == alone(cells, (column, row)));
            let depth = near.map_or(1, |(c, r)| depths[r * columns + c].saturating_add(1));
            let own = &mut depths[row * columns + column];
            *own = depth.min(*own);
        }
    };
    let all = || (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
    all().for_each(|p| pass(p, [(-1, 0), (-1, -1), (0, -1), (1, -1)]));
    let backwards = (0..rows).rev().flat_map(|row| (0..columns).rev().map(move |column| (column, row)));
    backwards.for_each(|p| pass(p, [(1, 0), (1, 1), (0, 1), (-1, 1)]));
    depths
}

/// The connected cells of one regime about `start`; none if they were seen before.
fn region(cells: &Cells, start: Place, seen: &mut [bool]) -> Vec<Place> {
    let columns = cells.size().0;
    let (mut open, mut region) = (vec![start], Vec::new());
    while let Some(place) = open.pop() {
        if std::mem::replace(&mut seen[place.1 * columns + place.0], true) {
            continue;
        }
        region.push(place);
        let near = [(1, 0), (-1, 0), (0, 1), (0, -1)].into_iter().filter_map(|side| step(place, side, cells));
        open.extend(near.filter(|p| alone(cells, *p) == alone(cells, start)));
    }
    region
}

/// A neighbour inside the grid.
fn step((column, row): Place, (right, up): (i64, i64), cells: &Cells) -> Option<Place> {
    let (columns, rows) = cells.size();
    let moved = |at: usize, by: i64, count: usize| {
        let to = usize::try_from(i64::try_from(at).ok()? + by).ok()?;
        (to < count).then_some(to)
    };
    Some((moved(column, right, columns)?, moved(row, up, rows)?))
}

#[cfg(test)]
mod tests {
    use super::super::super::marks::rank;
    use super::super::Cell;
    use super::*;

    #[test]
    fn each_region_is_marked_once_where_it_is_widest() {
        let axis: Vec<f64> = (0..9).map(f64::from).collect();
        let name = |x: f64| if x < 3.0 { "zigzag" } else { "straight" };
        let places = axis.iter().flat_map(|y| axis.iter().map(move |x| (*x, *y)));
        let cells: Vec<_> = places.map(|(x, y)| Cell { x, y, shares: vec![(name(x).into(), 1.0)] }).collect();
        let cells = Cells::new(&axis, &axis, &cells).expect("cells");
        // three columns of zigzag, six of straight
        let (zigzag, straight) = (rank("zigzag"), rank("straight"));
        assert_eq!(deepest(&cells), [((1, 4), 2, zigzag), ((5, 4), 3, straight)]);
    }
}
