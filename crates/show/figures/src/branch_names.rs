//! The names of motions at their curves, so that a diagram can be read without colours.

use super::branches::BranchDiagram;
use super::callouts::{Around, taken};
use super::clip::clip;
use super::geometry::{Point, Rect, distance};
use super::marks::regime_mark;
use super::paint::Paint;
use super::palette::WHITE;
use super::plane::Plane;
use super::svg::{Anchor, Svg};
use super::text::Label;

/// Size of the letters, in pixels.
const SIZE: f64 = 12.0;
/// Distances of a name from its curve, in pixels.
const GAPS: [f64; 3] = [-3.0, 0.0, 4.0];
/// Places along a curve where its name is tried, as parts of its length.
const TRIED: [f64; 9] = [0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9];
/// No curve of another motion may be closer to a name by more than this, in pixels.
const CLOSER: f64 = 2.0;
/// A motion has its name again at this distance, in pixels.
const AGAIN: f64 = 180.0;

impl BranchDiagram {
    /// Draws the name of each motion beside its longest curves, where it hides neither curve nor mark.
    pub(super) fn draw_names(&self, svg: &mut Svg, plane: &Plane) {
        let mut curves: Vec<(&str, Vec<Point>)> = Vec::new();
        for part in &self.parts {
            let places: Vec<Point> = part.points.iter().filter_map(|point| plane.at(*point)).collect();
            let name = regime_mark(&part.regime).words;
            curves.extend(clip(&places, plane.scale.frame).into_iter().map(|piece| (name, piece)));
        }
        let lines: Vec<Vec<Point>> = curves.iter().map(|curve| curve.1.clone()).collect();
        let points = self
            .marks
            .iter()
            .map(|mark| mark.at)
            .chain(self.dots.iter().flat_map(|dots| dots.points.clone()));
        let points = points.filter_map(|at| plane.within(at)).map(taken).collect();
        let mut around = Around { frame: plane.scale.frame, taken: points, lines: &lines };
        curves.sort_by(|a, b| length(&b.1).total_cmp(&length(&a.1)));
        let mut named: Vec<(&str, Point)> = Vec::new();
        for (name, curve) in &curves {
            let words = Label::parse(name);
            let size = [words.width(SIZE) + 4.0, SIZE + 3.0];
            let again = |at: &Point| {
                named.iter().all(|(known, there)| known != name || distance(*there, *at) >= AGAIN)
            };
            let tried = TRIED.iter().map(|part| along(curve, part * length(curve))).filter(again);
            let others: Vec<&[Point]> = curves.iter().filter(|o| o.0 != *name).map(|o| &o.1[..]).collect();
            let own = |place: &Rect| gap(curve, place) <= nearest(&others, place) + CLOSER;
            let Some((at, place)) = first_clear(tried, size, &around, own) else { continue };
            around.taken.push(place);
            named.push((*name, at));
            draw(svg, &words, place);
        }
    }
}

/// The first of some points beside which a name fits, nearer to its curve than to those of other motions, and the place of the name.
fn first_clear(
    mut points: impl Iterator<Item = Point>,
    size: [f64; 2],
    around: &Around<'_>,
    own: impl Fn(&Rect) -> bool,
) -> Option<(Point, Rect)> {
    points.find_map(|at| Some((at, around.place(at, size, &GAPS, false).filter(&own)?)))
}

/// The distance of a place from the nearest of some curves.
fn nearest(curves: &[&[Point]], place: &Rect) -> f64 {
    curves.iter().map(|curve| gap(curve, place)).fold(f64::INFINITY, f64::min)
}

/// The distance of a place from a curve, up to a part of the steps between its points.
fn gap(curve: &[Point], place: &Rect) -> f64 {
    let from =
        |[x, y]: Point| distance([x, y], [x.clamp(place.x, place.right()), y.clamp(place.y, place.bottom())]);
    let within = |pair: &[Point]| {
        let at = |part: f64| [0, 1].map(|side| pair[0][side] + part * (pair[1][side] - pair[0][side]));
        [0.0, 0.25, 0.5, 0.75, 1.0].map(|part| from(at(part))).into_iter().fold(f64::INFINITY, f64::min)
    };
    curve.windows(2).map(within).fold(f64::INFINITY, f64::min)
}

fn draw(svg: &mut Svg, words: &Label, place: Rect) {
    svg.rect(place, &Paint::fill(WHITE).opacity(0.85));
    svg.text([place.x + 2.0, place.y + 0.5 * place.h + 0.36 * SIZE], SIZE, Anchor::Start, words);
}

fn length(curve: &[Point]) -> f64 {
    curve.windows(2).map(|pair| distance(pair[0], pair[1])).sum()
}

/// The point of a curve at a distance from its beginning.
fn along(curve: &[Point], mut left: f64) -> Point {
    for pair in curve.windows(2) {
        let step = distance(pair[0], pair[1]);
        if step > 0.0 && left <= step {
            let part = left / step;
            return [
                pair[0][0] + part * (pair[1][0] - pair[0][0]),
                pair[0][1] + part * (pair[1][1] - pair[0][1]),
            ];
        }
        left -= step;
    }
    curve.last().copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::super::Chart;
    use super::super::branches::{BranchPart, Stability};
    use super::*;

    /// Each motion has its name at its curve, in addition to the legend.
    #[test]
    fn long_curves_have_their_names() {
        let part = |regime: &str, points: Vec<Point>| BranchPart {
            regime: regime.to_owned(),
            stability: Stability::Stable,
            points,
        };
        let parts = vec![
            part("zigzag", vec![[0.0, 1.0], [1.0, 2.0]]),
            part("circular", vec![[0.0, 0.0], [1.0, 0.2]]),
        ];
        let chart =
            Chart::default().with([BranchDiagram { x: [0.0, 1.0], parts, ..BranchDiagram::default() }]);
        let svg = chart.svg().expect("a figure");
        for name in ["zigzag", "circular"] {
            assert!(svg.matches(&format!(">{name}<")).count() >= 2, "{name} in {svg}");
        }
    }
}
