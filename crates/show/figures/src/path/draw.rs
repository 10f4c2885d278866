//! The layers of a path figure: outlines, path, section, arrows, ends.

use super::{PathFigure, PathPoint, SectionLine};
use crate::axes::Scale;
use crate::geometry::{Point, Range, distance};
use crate::legend::{Entry, Mark, draw_arrow, draw_end, draw_start};
use crate::paint::Paint;
use crate::palette::{BLACK, Colour, INK, VERMILION, WHITE, time_colour_in};
use crate::simplify::simplify;
use crate::svg::Svg;

/// Tolerance of a decimated curve, in pixels: no corner shows at twice the size.
const FINE: f64 = 0.04;
/// Tolerance of a curve so long that its single turns are lost in the crowd.
const COARSE: f64 = 0.2;
/// Length of a path, in pixels, from which it counts as crowded.
const CROWDED: f64 = 20_000.0;
/// Distance of arrow heads along the path, in pixels, unless that makes too many.
const ARROW_DISTANCE: f64 = 140.0;
const MOST_ARROWS: f64 = 10.0;
const PATH_COLOUR: Colour = INK;
const NO_TIME: Range = Range { min: 0.0, max: 0.0 };

impl PathFigure {
    /// Times of the outlines; `None` if there are fewer than two.
    pub(super) fn time_range(&self) -> Option<Range> {
        Range::of(self.outlines.iter().map(|o| o.t)).filter(|range| range.span() > 0.0)
    }

    /// The entries of the legend: only what is drawn.
    pub(super) fn legend(&self) -> Vec<Entry> {
        let mut entries = Vec::new();
        let count = self.points().count();
        if count > 1 {
            entries.push(Entry::new(
                Mark::Arrow(Paint::stroke(PATH_COLOUR, 1.2), PATH_COLOUR),
                "path of the centre",
            ));
        }
        if !self.outlines.is_empty() {
            entries.push(Entry::new(Mark::Outline(self.sample_outline()), "domain outline"));
        }
        if let Some(section) = &self.section {
            entries.push(Entry::new(Mark::Line(section_paint()), &section.label));
            if !section.crossings.is_empty() {
                entries.push(Entry::new(Mark::Dot(crossing_paint(), 3.2), "crossings"));
            }
        }
        match count {
            0 => {}
            1 => entries.push(Entry::new(Mark::Start, "position")),
            _ => entries.extend([Entry::new(Mark::Start, "start"), Entry::new(Mark::End, "end")]),
        }
        entries
    }

    /// The outline of the legend: the colour of the middle of the run, or of the only outline.
    fn sample_outline(&self) -> Paint {
        self.time_range().map_or(outline_paint(0.0, NO_TIME), |range| outline_paint(range.middle(), range))
    }

    /// Draws everything that lies inside the frame.
    pub(super) fn draw_data(&self, svg: &mut Svg, scale: &Scale) {
        let range = self.time_range().unwrap_or(NO_TIME);
        for outline in &self.outlines {
            let points: Vec<_> = outline.points.iter().map(|p| scale.map(*p)).collect();
            svg.polyline(&simplify(&points, FINE), true, &outline_paint(outline.t, range));
        }
        let mut curves: Vec<Vec<Point>> = self.segments.iter().map(|s| pixels(s, scale)).collect();
        let length: f64 = curves.iter().map(|c| path_length(c)).sum();
        let mut paint = Paint::stroke(PATH_COLOUR, 1.2);
        if length > CROWDED {
            curves = curves.iter().map(|c| simplify(c, COARSE)).collect();
            paint = Paint::stroke(PATH_COLOUR.mix(WHITE, 0.4), 0.6);
        }
        for curve in &curves {
            svg.polyline(curve, false, &paint);
        }
        if let Some(section) = &self.section {
            draw_section(svg, scale, section);
        }
        draw_arrows(svg, &curves, length);
        self.draw_ends(svg, scale);
    }

    fn draw_ends(&self, svg: &mut Svg, scale: &Scale) {
        let at = |p: &PathPoint| scale.map([p.x, p.y]);
        if let (Some(first), Some(last)) = (self.points().next(), self.points().last()) {
            if self.points().count() > 1 {
                draw_end(svg, at(last));
            }
            draw_start(svg, at(first));
        }
    }
}

fn outline_paint(t: f64, range: Range) -> Paint {
    let colour = time_colour_in(t, range);
    Paint::stroke(colour.mix(BLACK, 0.25), 1.1).tint(colour, 0.18)
}

fn section_paint() -> Paint {
    Paint::stroke(VERMILION, 2.0)
}

fn crossing_paint() -> Paint {
    Paint::fill(VERMILION).edge(WHITE, 0.8)
}

fn draw_section(svg: &mut Svg, scale: &Scale, section: &SectionLine) {
    svg.line(scale.map(section.from), scale.map(section.to), &section_paint());
    for crossing in &section.crossings {
        svg.circle(scale.map(*crossing), 3.2, &crossing_paint());
    }
}

/// A piece of the path in pixels, decimated.
fn pixels(segment: &[PathPoint], scale: &Scale) -> Vec<Point> {
    let points: Vec<_> = segment.iter().map(|p| scale.map([p.x, p.y])).collect();
    simplify(&points, FINE)
}

fn path_length(curve: &[Point]) -> f64 {
    curve.windows(2).map(|w| distance(w[0], w[1])).sum()
}

/// Arrow heads at equal distances along the whole path, clear of its two ends; none on a path too short for one.
fn draw_arrows(svg: &mut Svg, curves: &[Vec<Point>], length: f64) {
    let count = (length / ARROW_DISTANCE).round().clamp(1.0, MOST_ARROWS);
    if length < 25.0 {
        return;
    }
    let ends: Vec<Point> =
        [curves[0].first(), curves[curves.len() - 1].last()].into_iter().flatten().copied().collect();
    let (spacing, mut walked) = (length / count, 0.0);
    let mut next = 0.5 * spacing;
    for step in curves.iter().flat_map(|curve| curve.windows(2)) {
        let (from, to) = (step[0], step[1]);
        let long = distance(from, to);
        while long > 0.0 && next <= walked + long {
            let way = [(to[0] - from[0]) / long, (to[1] - from[1]) / long];
            let ahead = next - walked;
            let at = [from[0] + ahead * way[0], from[1] + ahead * way[1]];
            if ends.iter().all(|end| distance(*end, at) > 14.0) {
                draw_arrow(svg, at, way, PATH_COLOUR);
            }
            next += spacing;
        }
        walked += long;
    }
}
