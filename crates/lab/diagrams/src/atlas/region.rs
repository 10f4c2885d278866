//! Connected parts of the plane with the same motions.

use crate::atlas::boundary::descending;
use crate::atlas::grid::Grid;
use motiform_analysis::{Course, Regime};
use motiform_study::AtlasPlan;

/// A connected part of the plane in which all cells have the same motions.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Its motions, in the order of legends: more than one where motions coexist.
    pub motions: Vec<Regime>,
    /// Its cells.
    pub cells: usize,
    /// Its share of the plane.
    pub share: f64,
    /// The computed cell farthest from its border.
    pub inner: usize,
    /// Where that is, across and upwards.
    pub at: [f64; 2],
    /// Of a region of one motion with several courses: a computed cell for each, in which there is no other.
    pub courses: Vec<(Course, usize)>,
}

/// The regions of a grid, the largest first.
pub fn regions(plan: &AtlasPlan, grid: &Grid) -> Vec<Region> {
    let (labels, scan) = (grid.labels(), plan.scan());
    let mut seen = vec![false; labels.len()];
    let mut all = Vec::new();
    for first in 0..labels.len() {
        let cells = spread(grid, &labels, first, &mut seen);
        let Some(inner) = innermost(grid, &labels, &cells) else { continue };
        let values = scan.axis_values(inner);
        all.push(Region {
            motions: labels[first].clone(),
            cells: cells.len(),
            share: cells.len() as f64 / labels.len() as f64,
            inner,
            at: [values[0], values[1]],
            courses: courses(grid, &labels[first], &cells),
        });
    }
    descending(all, |region| region.cells)
}

/// The courses of a region of one motion, with a cell of each, of those in their order the middle one; none where there are not several.
fn courses(grid: &Grid, motions: &[Regime], cells: &[usize]) -> Vec<(Course, usize)> {
    let [motion] = motions else { return Vec::new() };
    let mut ordered = cells.to_vec();
    ordered.sort_unstable();
    let cell = |course: Course| {
        let own = |cell: &&usize| {
            let place = &grid.places[**cell];
            place.like.is_none() && place.motion(*motion).is_some_and(|found| found.courses == [course])
        };
        let all: Vec<&usize> = ordered.iter().filter(own).collect();
        all.get(all.len() / 2).map(|cell| (course, **cell))
    };
    let all: Vec<(Course, usize)> = Course::ALL.into_iter().filter_map(cell).collect();
    if all.len() > 1 { all } else { Vec::new() }
}

/// The cells that are connected with one by cells of the same motions; none if it was seen.
fn spread(grid: &Grid, labels: &[Vec<Regime>], first: usize, seen: &mut [bool]) -> Vec<usize> {
    let (mut open, mut all) = (vec![first], Vec::new());
    while let Some(cell) = open.pop() {
        if labels[cell] != labels[first] || std::mem::replace(&mut seen[cell], true) {
            continue;
        }
        all.push(cell);
        open.extend(beside(grid, cell));
    }
    all
}

/// The cells to the right, to the left, above and below.
fn beside(grid: &Grid, cell: usize) -> impl Iterator<Item = usize> {
    let ([i, j], [columns, rows]) = (grid.place(cell), grid.size);
    let all = [
        (i + 1 < columns).then(|| [i + 1, j]),
        i.checked_sub(1).map(|i| [i, j]),
        (j + 1 < rows).then(|| [i, j + 1]),
        j.checked_sub(1).map(|j| [i, j]),
    ];
    all.into_iter().flatten().map(|place| grid.cell(place))
}

/// The cell with the most room around it within its region: with all its motions found in it, if there is such a one.
fn innermost(grid: &Grid, labels: &[Vec<Regime>], cells: &[usize]) -> Option<usize> {
    let mut depth: Vec<(usize, usize)> = Vec::new();
    let mut layer: Vec<usize> = cells
        .iter()
        .copied()
        .filter(|cell| {
            beside(grid, *cell).count() < 4 || beside(grid, *cell).any(|near| labels[near] != labels[*cell])
        })
        .collect();
    let mut done = vec![false; labels.len()];
    let mut level = 0;
    while !layer.is_empty() {
        layer.iter().for_each(|cell| done[*cell] = true);
        depth.extend(layer.iter().map(|cell| (*cell, level)));
        let mut next: Vec<usize> = layer
            .iter()
            .flat_map(|cell| beside(grid, *cell))
            .filter(|near| !done[*near] && labels[*near] == labels[cells[0]])
            .collect();
        next.sort_unstable();
        next.dedup();
        layer = next;
        level += 1;
    }
    let whole = |cell: usize| grid.places[cell].label() == labels[cell];
    depth
        .into_iter()
        .max_by_key(|(cell, level)| (whole(*cell), *level, std::cmp::Reverse(*cell)))
        .map(|one| one.0)
}
