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

/// Room around a path, in pixels: that of the arrow head, which reaches 6.4 beyond its end.
const ROOM: f64 = 6.5;

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

#[cfg(test)]
mod tests {
    use super::*;

    /// Paths that end in a corner of their box, or at its edge, with their arrow heads: all places of the drawing lie within.
    #[test]
    fn arrow_heads_stay_in_their_box() {
        let place = Rect { x: 0.0, y: 0.0, w: SIZE[0], h: SIZE[1] };
        for end in [[1.0, 0.0], [1.0, 1.0], [3.0, 0.1], [0.1, 3.0]] {
            let mut svg = Svg::new(SIZE[0], SIZE[1]);
            draw(&mut svg, place, &[[0.0, 0.0], end]);
            let text = svg.finish();
            let paths = text.split(" d=\"").skip(1).filter_map(|path| path.split('"').next());
            let places = paths.flat_map(|path| path.split(['M', 'L', 'Z'])).filter_map(|place| {
                let (x, y) = place.split_once(' ')?;
                Some([x.parse::<f64>().ok()?, y.parse::<f64>().ok()?])
            });
            let places: Vec<_> = places.collect();
            assert!(places.len() >= 6, "{text}");
            let inside = |[x, y]: &[f64; 2]| (0.0..=SIZE[0]).contains(x) && (0.0..=SIZE[1]).contains(y);
            assert!(places.iter().all(inside), "{places:?}");
        }
    }
}
