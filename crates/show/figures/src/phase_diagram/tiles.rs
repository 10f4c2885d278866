//! Small grids: a marker on a pale tile.

use super::super::geometry::{Point, Rect};
use super::super::marks::REGIMES;
use super::super::stripes::{draw_bands, draw_hatch};
use super::cells::{Cells, Shares};
use super::{Scale, Svg};

/// Cells of at least this many pixels have two stripes of each colour.
const LARGE: f64 = 24.0;

/// The grounds.
pub(super) fn draw_grounds(svg: &mut Svg, scale: &Scale, cells: &Cells) {
    tiles(scale, cells).for_each(|(tile, shares)| draw_ground(svg, tile, shares));
}

/// The markers, in front of all lines.
pub(super) fn draw_markers(svg: &mut Svg, scale: &Scale, cells: &Cells) {
    tiles(scale, cells).for_each(|(tile, shares)| draw_marker(svg, tile, shares));
}

/// The motions found in each cell, with its place in pixels.
fn tiles<'a>(scale: &'a Scale, cells: &'a Cells) -> impl Iterator<Item = (Rect, &'a Shares)> {
    let (columns, rows) = cells.size();
    let places = (0..rows).flat_map(move |row| (0..columns).map(move |column| (column, row)));
    places.filter_map(|(column, row)| {
        let ([left, right], [low, high]) = (cells.column(column), cells.row(row));
        let ([x, y], [far, bottom]) = (scale.map([left, high]), scale.map([right, low]));
        // half a pixel of white all around parts the tiles
        let tile = Rect { x: x + 0.5, y: y + 0.5, w: far - x - 1.0, h: bottom - y - 1.0 };
        Some((tile, cells.at(column, row)?))
    })
}

fn draw_ground(svg: &mut Svg, tile: Rect, shares: &Shares) {
    let tints: Vec<_> = shares.iter().map(|(rank, share)| (REGIMES[*rank].tint(), *share)).collect();
    draw_bands(svg, tile, &tints, if tile.w.min(tile.h) < LARGE { 1 } else { 2 });
    if let [(rank, _)] = shares[..]
        && REGIMES[rank].is_undetermined()
    {
        draw_hatch(svg, tile);
    }
}

/// One marker, or those of the two largest shares side by side.
fn draw_marker(svg: &mut Svg, tile: Rect, shares: &Shares) {
    let [x, y]: Point = [tile.x + 0.5 * tile.w, tile.y + 0.5 * tile.h];
    match shares[..] {
        [] => {}
        [(rank, _)] => REGIMES[rank].draw(svg, [x, y], (0.28 * tile.w.min(tile.h)).min(7.0)),
        [(first, _), (second, _), ..] => {
            let radius = (0.26 * tile.h).min(0.135 * tile.w).min(5.5);
            let aside = (0.24 * tile.w).min(2.4 * radius);
            REGIMES[first].draw(svg, [x - aside, y], radius);
            REGIMES[second].draw(svg, [x + aside, y], radius);
        }
    }
}
