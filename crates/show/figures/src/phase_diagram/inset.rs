//! Small paths in a region: how a body moves there.

use super::super::clip::clip;
use super::super::geometry::{Point, Range, Rect};
use super::super::legend::draw_arrow;
use super::super::paint::Paint;
use super::super::palette::INK;
use super::super::simplify::simplify;
use super::super::svg::Svg;

/// Width and height of a path with the room around it, in pixels.
pub(super) const SIZE: [f64; 2] = [46.0, 38.0];

/// Room around a path, in pixels.
const ROOM: f64 = 4.0;

/// Paths of the motions of the region around a cell, each drawn as large as it fits.
#[derive(Debug, Clone, PartialEq)]
pub struct MapInset {
    /// The centre of the cell, in units of the axes.
    pub cell: Point,
    /// A path of each motion.
    pub paths: Vec<Vec<Point>>,
}

/// Draws a path into a box, both of its axes with one unit, with an arrow at its end.
pub(super) fn draw(svg: &mut Svg, place: Rect, path: &[Point]) {
    let range = |side: usize| Range::of(path.iter().map(|p| p[side]));
    let (Some(x), Some(y)) = (range(0), range(1)) else { return };
    let unit = ((place.w - 2.0 * ROOM) / x.span()).min((place.h - 2.0 * ROOM) / y.span());
    if !unit.is_finite() {
        return;
    }
    let middle = [place.x + 0.5 * place.w, place.y + 0.5 * place.h];
    let at = |p: &Point| [middle[0] + (p[0] - x.middle()) * unit, middle[1] - (p[1] - y.middle()) * unit];
    let points = simplify(&path.iter().map(at).collect::<Vec<_>>(), 0.1);
    for piece in clip(&points, place) {
        svg.polyline(&piece, false, &Paint::stroke(INK, 1.0));
    }
    if let [.., from, to] = points[..] {
        let long = (to[0] - from[0]).hypot(to[1] - from[1]);
        draw_arrow(svg, to, [(to[0] - from[0]) / long, (to[1] - from[1]) / long], INK);
    }
}
