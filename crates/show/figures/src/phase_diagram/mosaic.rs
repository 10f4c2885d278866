//! Large grids: coloured cells as one picture.

use super::super::marks::{REGIMES, RegimeMark};
use super::super::palette::GREY;
use super::super::picture::indexed_png;
use super::cells::{Cells, Shares};
use super::{Colour, Result, Scale, WHITE};

/// Pixels of the picture per pixel of the frame.
const FINE: f64 = 2.0;
/// Distance of hatch lines, in pixels of the picture.
const HATCH: usize = 10;
/// Index of the ground where nothing is known, and of the hatch; the regimes come before them.
const BLANK: u8 = REGIMES.len() as u8;

/// The picture; its stripes repeat with the cells, so that they run on through a region.
pub(super) fn png(scale: &Scale, cells: &Cells) -> Result<Vec<u8>> {
    let [x, y] = cells.ranges();
    let (width, height) = ((FINE * scale.frame.w).round() as usize, (FINE * scale.frame.h).round() as usize);
    let (columns, rows) = cells.size();
    let place = |i: usize, n: usize, span: f64| (i as f64 + 0.5) / n as f64 * span;
    let across: Vec<_> =
        (0..width).map(|i| find(columns, |c| cells.column(c), x.min + place(i, width, x.span()))).collect();
    let mut pixels = Vec::with_capacity(width * height);
    for j in 0..height {
        let (row, v) = find(rows, |r| cells.row(r), y.max - place(j, height, y.span()));
        for (i, (column, u)) in across.iter().enumerate() {
            let ground = cells.at(*column, row).map_or(BLANK, |shares| colour(shares, (u + 1.0 - v).fract()));
            let mark = REGIMES.get(usize::from(ground));
            let rising = mark.is_some_and(RegimeMark::is_undetermined) && (i + j) % HATCH < 2;
            let falling = mark.is_some_and(RegimeMark::is_clockwise) && (i + height - j) % HATCH < 2;
            pixels.push(match (rising, falling) {
                (true, _) => BLANK + 1,
                (_, true) => BLANK,
                _ => ground,
            });
        }
    }
    let palette: Vec<Colour> = REGIMES.iter().map(|m| m.area).chain([WHITE, GREY]).collect();
    indexed_png(width, &palette, &pixels)
}

/// The cell that holds a value, and how far in it lies, from 0 to 1.
fn find(count: usize, edges: impl Fn(usize) -> [f64; 2], value: f64) -> (usize, f64) {
    let (mut low, mut high) = (0, count - 1);
    while low < high {
        let middle = (low + high) / 2;
        if edges(middle)[1] <= value {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    let [from, to] = edges(low);
    (low, (value - from) / (to - from))
}

/// The regime whose stripe holds a place from 0 to 1 across the stripes.
fn colour(shares: &Shares, at: f64) -> u8 {
    let mut to = 0.0;
    for (rank, share) in shares {
        to += share;
        if at < to {
            return *rank as u8;
        }
    }
    shares.last().map_or(BLANK, |(rank, _)| *rank as u8)
}
