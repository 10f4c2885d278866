//! One axis: a bar of shares over each value, markers above.

use super::super::geometry::Rect;
use super::super::marks::REGIMES;
use super::super::stripes::{draw_falling, draw_hatch};
use super::cells::{Cells, Shares};
use super::{Paint, Scale, Svg};

/// Room for the markers, in pixels.
pub(super) const HEAD: f64 = 18.0;
/// Columns of at least this many pixels have their own markers; others share that of their neighbours alike.
const WIDE: f64 = 16.0;
/// Smallest marker, as a radius in pixels.
const SMALLEST: f64 = 1.7;

pub(super) fn draw(svg: &mut Svg, scale: &Scale, cells: &Cells) {
    let columns = cells.size().0;
    for column in 0..columns {
        if let Some(shares) = cells.at(column, 0) {
            draw_bar(svg, scale, cells.column(column), shares);
        }
    }
    let mut from = 0;
    while from < columns {
        let kind = leaders(cells, from);
        let wide = scale.frame.w / columns as f64 >= WIDE;
        let end = if wide {
            from + 1
        } else {
            (from..columns).find(|c| leaders(cells, *c) != kind).unwrap_or(columns)
        };
        let x = |value: f64| scale.map([value, 0.0])[0];
        draw_markers(svg, scale, [x(cells.column(from)[0]), x(cells.column(end - 1)[1])], kind);
        from = end;
    }
}

/// The regimes of a column, from below in the order of all regimes, so that neighbours match.
fn draw_bar(svg: &mut Svg, scale: &Scale, [left, right]: [f64; 2], shares: &Shares) {
    let mut shares = shares.clone();
    shares.sort_by_key(|(rank, _)| *rank);
    let mut low = 0.0;
    for (rank, share) in shares {
        let high = f64::min(low + share, 1.0);
        let ([x, y], [far, bottom]) = (scale.map([left, high]), scale.map([right, low]));
        let bar = Rect { x, y, w: far - x, h: bottom - y };
        svg.rect(bar, &Paint::fill(REGIMES[rank].area));
        if REGIMES[rank].is_undetermined() {
            draw_hatch(svg, bar);
        }
        if REGIMES[rank].is_clockwise() {
            draw_falling(svg, bar);
        }
        low = high;
    }
}

/// The two largest shares of a column.
fn leaders(cells: &Cells, column: usize) -> [Option<usize>; 2] {
    let rank = |i: usize| Some(cells.at(column, 0)?.get(i)?.0);
    [rank(0), rank(1)]
}

fn draw_markers(svg: &mut Svg, scale: &Scale, [left, right]: [f64; 2], kind: [Option<usize>; 2]) {
    let ([x, y], w) = ([0.5 * (left + right), scale.frame.y - 0.5 * HEAD], right - left);
    let (alone, paired) = ((0.42 * w).min(4.6), (0.17 * w).min(4.2));
    match kind {
        [Some(first), Some(second)] if paired >= SMALLEST => {
            REGIMES[first].draw(svg, [x - 1.4 * paired, y], paired);
            REGIMES[second].draw(svg, [x + 1.4 * paired, y], paired);
        }
        [Some(first), _] if alone >= SMALLEST - 0.1 => REGIMES[first].draw(svg, [x, y], alone),
        _ => {}
    }
}
