//! Grounds of more than one colour, and the hatch of what is not known.

use super::clip::clip;
use super::geometry::{Point, Rect};
use super::paint::Paint;
use super::palette::{Colour, GREY, WHITE};
use super::svg::Svg;

/// Distance of hatch lines along x, in pixels.
const HATCH: f64 = 6.0;

/// Fills a rectangle with falling stripes, `repeats` of each colour along an edge, as wide as their shares of 1.
pub(super) fn draw_bands(svg: &mut Svg, rect: Rect, shares: &[(Colour, f64)], repeats: u32) {
    let Some(((first, share), rest)) = shares.split_first() else { return };
    svg.rect(rect, &Paint::fill(*first)); // the others lie on it: no seams
    let mut from = *share;
    for (colour, share) in rest {
        let to = from + share;
        for k in (0..2 * repeats).map(f64::from) {
            let unit = f64::from(repeats);
            let band = band((k + from) / unit, ((k + to) / unit).min(2.0));
            let corner = |[u, v]: Point| [rect.x + u * rect.w, rect.y + v * rect.h];
            svg.polyline(&band.map(corner), true, &Paint::fill(*colour));
        }
        from = to;
    }
}

/// The part of the unit square with `from` <= u + v <= `to`, both within 0 to 2.
fn band(from: f64, to: f64) -> [Point; 6] {
    let ends = |s: f64| ([(s - 1.0).max(0.0), s.min(1.0)], [s.min(1.0), (s - 1.0).max(0.0)]);
    let (low, high) = (ends(from), ends(to));
    // a corner of the square lies between the two lines, or else coincides with one of the ends
    let middle = ends(1.0f64.clamp(from, to));
    [low.0, middle.0, high.0, high.1, middle.1, low.1]
}

/// Rising grey lines over a rectangle; those of neighbours continue each other.
pub(super) fn draw_hatch(svg: &mut Svg, rect: Rect) {
    draw_lines(svg, rect, 1.0, &Paint::stroke(GREY, 0.8));
}

/// Falling white lines, as areas of clockwise motions have.
pub(super) fn draw_falling(svg: &mut Svg, rect: Rect) {
    draw_lines(svg, rect, -1.0, &Paint::stroke(WHITE, 1.0));
}

/// Lines on which `sign x + y` is a multiple of their distance.
fn draw_lines(svg: &mut Svg, rect: Rect, sign: f64, paint: &Paint) {
    let ends = [rect.x, rect.right()].map(|x| sign * x);
    let first = ((ends[0].min(ends[1]) + rect.y) / HATCH).ceil() as i64;
    let last = ((ends[0].max(ends[1]) + rect.bottom()) / HATCH).floor() as i64;
    let line = |k: i64| {
        let sum = k as f64 * HATCH;
        let ends = [rect.x, rect.right()].map(|x| [x, sum - sign * x]);
        clip(&ends, rect).into_iter().next().map(|piece| [piece[0], piece[1]])
    };
    let lines: Vec<_> = (first..=last).filter_map(line).collect();
    svg.lines(&lines, paint);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(points: &[Point]) -> f64 {
        let next = points.iter().cycle().skip(1);
        0.5 * points.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>().abs()
    }

    #[test]
    fn stripes_take_the_area_of_their_shares() {
        for (from, to) in [(0.0, 0.3), (0.3, 1.0), (0.25, 0.5)] {
            let areas = [0.0, 1.0, 2.0, 3.0].map(|k| area(&band((k + from) / 2.0, (k + to) / 2.0)));
            let total: f64 = areas.iter().sum();
            assert!((total - (to - from)).abs() < 1e-12, "{from} to {to}: {total}");
        }
    }
}
