//! Branches of motions against a parameter: a bifurcation diagram.

use super::axes::{AxisKind, Scale};
use super::clip::clip;
use super::error::{FigureError, Result, check_finite};
use super::figure::{Csv, figure};
use super::framed::Framed;
use super::geometry::{Point, Range, Rect};
use super::glyph::Glyph;
use super::legend::{Entry, Mark};
use super::marks::{REGIMES, regime_mark};
use super::paint::Paint;
use super::palette::{Colour, GREY, INK};
use super::room::Room;
use super::svg::Svg;

const WIDTH: f64 = 600.0;
const HEIGHT: f64 = 360.0;
/// How far unstable motions widen the axis, in ranges of what is seen.
const BEYOND: f64 = 2.0;

/// A part of a branch over which neither motion nor stability changes.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchPart {
    /// The regime, for its colour.
    pub regime: String,
    /// Whether it is stable.
    pub stable: bool,
    /// Points in data units.
    pub points: Vec<Point>,
}

/// What was sampled while the parameter was swept in one direction.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchDots {
    /// What it is, as the legend says (markup).
    pub label: String,
    /// Upwards: dots; downwards: circles.
    pub up: bool,
    /// Points in data units.
    pub points: Vec<Point>,
}

/// A special point.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchMark {
    /// What it is, as the legend says (markup).
    pub label: String,
    /// Its marker.
    pub glyph: Glyph,
    /// Where it is, in data units.
    pub at: Point,
}

/// Branches against a parameter: thick where stable, thin and dashed where not, with markers at special points.
///
/// # Units   those of the labels; texts are markup (see [`super::Label`])
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BranchDiagram {
    /// Line above the legend.
    pub title: String,
    /// Paragraphs below the axes.
    pub caption: Vec<String>,
    /// Label of the parameter.
    pub x_label: String,
    /// Label of what is shown against it.
    pub y_label: String,
    /// Whether the values stand on a logarithmic axis.
    pub logarithmic: bool,
    /// Range of the parameter; what lies outside is cut off.
    pub x: [f64; 2],
    /// The branches.
    pub parts: Vec<BranchPart>,
    /// Samples, drawn beneath.
    pub dots: Vec<BranchDots>,
    /// The special points, drawn on top.
    pub marks: Vec<BranchMark>,
}

impl BranchDiagram {
    /// Draws the figure for a width.
    ///
    /// # Errors   no point, a number that is not finite, or a range that does not rise
    pub fn svg_in(&self, room: Room) -> Result<Svg> {
        let values = self.parts.iter().flat_map(|part| &part.points).flatten();
        let marks = self.marks.iter().flat_map(|mark| &mark.at);
        let dots = self.dots.iter().flat_map(|dots| &dots.points).flatten();
        let marks = marks.chain(dots);
        check_finite("branch value (parameter, value in turn)", values.chain(marks).chain(&self.x).copied())?;
        let sheet = Framed {
            title: &self.title,
            caption: &self.caption,
            legend: self.legend(),
            scale: self.scale()?,
            kinds: self.kinds(),
            labels: [&self.x_label, &self.y_label],
            room,
            grid: true,
            head: 0.0,
        };
        sheet.svg(|svg, scale| {
            self.dots.iter().for_each(|dots| dots.draw(svg, scale, self.kinds()));
            // stable parts on top of unstable ones
            for stable in [false, true] {
                let parts = self.parts.iter().filter(|part| part.stable == stable);
                parts.for_each(|part| part.draw(svg, scale, self.kinds()));
            }
            self.marks.iter().for_each(|mark| mark.draw(svg, scale, self.kinds()));
            Ok(())
        })
    }

    fn legend(&self) -> Vec<Entry> {
        let has = |regime: &str| self.parts.iter().any(|part| regime_mark(&part.regime).name == regime);
        let regimes = REGIMES.iter().filter(|mark| has(mark.name));
        let mut entries: Vec<Entry> =
            regimes.map(|mark| Entry::new(Mark::Line(paint(mark.colour, true)), mark.name)).collect();
        for (stable, word) in [(true, "stable"), (false, "unstable")] {
            if self.parts.iter().any(|part| part.stable == stable) {
                entries.push(Entry::new(Mark::Line(paint(INK, stable)), word));
            }
        }
        entries.extend(
            self.dots.iter().map(|dots| Entry::new(Mark::Dot(dots.paint(), dots.radius()), &dots.label)),
        );
        let mut seen: Vec<&str> = Vec::new();
        for mark in &self.marks {
            if !seen.contains(&mark.label.as_str()) {
                seen.push(&mark.label);
                entries.push(Entry::new(Mark::Point(mark.glyph, INK, false), &mark.label));
            }
        }
        entries
    }

    /// The places of values within the range of the parameter: of stable motions, marks and samples, or of everything.
    fn places(&self, seen: bool) -> Option<Range> {
        let kind = self.kinds()[1];
        let parts = self.parts.iter().filter(|part| part.stable || !seen).flat_map(|part| &part.points);
        let points = parts.chain(self.dots.iter().flat_map(|dots| &dots.points));
        let points = points.chain(self.marks.iter().filter(|_| seen).map(|mark| &mark.at));
        let shown = points.filter(|p| self.x[0] <= p[0] && p[0] <= self.x[1]);
        Range::of(shown.filter_map(|p| kind.place(p[1])))
    }

    /// The values in sight: an unstable motion whose values are far from those of all others leaves the frame, or it would squeeze them.
    fn values(&self) -> Option<Range> {
        let all = self.places(false)?;
        let Some(seen) = self.places(true).filter(|seen| seen.span() > 0.0) else { return Some(all) };
        let far = BEYOND * seen.span();
        Some(Range { min: all.min.max(seen.min - far), max: all.max.min(seen.max + far) })
    }

    fn scale(&self) -> Result<Scale> {
        let kind = self.kinds()[1];
        let range = self.values().and_then(|values| kind.range([values.min, values.max], 0.06));
        let (Some(y), Some(x)) = (range, Range::of(self.x)) else {
            return Err(FigureError::Empty { what: "list of points within the range" });
        };
        let frame = Rect { x: 0.0, y: 0.0, w: WIDTH, h: HEIGHT };
        Ok(Scale { frame, x: x.padded(0.02), y })
    }

    fn kinds(&self) -> [AxisKind; 2] {
        [AxisKind::Linear, if self.logarithmic { AxisKind::Logarithmic } else { AxisKind::Linear }]
    }

    /// A row per point, part after part, then the special points.
    fn csv(&self) -> String {
        let head = ["part", "regime", "stable", "special"];
        let mut csv = Csv::new(head.into_iter().chain([self.x_label.as_str(), self.y_label.as_str()]));
        for (number, part) in self.parts.iter().enumerate() {
            let stable = if part.stable { "1" } else { "0" };
            for point in &part.points {
                csv.row(&[&number.to_string(), &part.regime, stable, ""], point.map(Some));
            }
        }
        for mark in &self.marks {
            csv.row(&["", "", "", &mark.label], mark.at.map(Some));
        }
        for dots in &self.dots {
            dots.points.iter().for_each(|at| csv.row(&[&dots.label, "", "", ""], at.map(Some)));
        }
        csv.finish()
    }
}

figure!(BranchDiagram);

fn paint(colour: Colour, stable: bool) -> Paint {
    if stable { Paint::stroke(colour, 3.0) } else { Paint::stroke(colour, 1.3).dashed("4 2.5") }
}

impl BranchPart {
    fn draw(&self, svg: &mut Svg, scale: &Scale, kinds: [AxisKind; 2]) {
        let place = |p: &Point| Some(scale.map([kinds[0].place(p[0])?, kinds[1].place(p[1])?]));
        let places: Vec<Point> = self.points.iter().filter_map(place).collect();
        for piece in clip(&places, scale.frame) {
            svg.polyline(&piece, false, &paint(regime_mark(&self.regime).colour, self.stable));
        }
    }
}

impl BranchDots {
    fn radius(&self) -> f64 {
        if self.up { 2.1 } else { 3.2 }
    }

    fn paint(&self) -> Paint {
        if self.up { Paint::fill(GREY) } else { Paint::stroke(GREY, 0.8) }
    }

    fn draw(&self, svg: &mut Svg, scale: &Scale, kinds: [AxisKind; 2]) {
        let frame = scale.frame;
        for [x, y] in &self.points {
            let (Some(x), Some(y)) = (kinds[0].place(*x), kinds[1].place(*y)) else { continue };
            let [x, y] = scale.map([x, y]);
            if (frame.x..=frame.right()).contains(&x) && (frame.y..=frame.bottom()).contains(&y) {
                svg.circle([x, y], self.radius(), &self.paint());
            }
        }
    }
}

impl BranchMark {
    fn draw(&self, svg: &mut Svg, scale: &Scale, kinds: [AxisKind; 2]) {
        let (Some(x), Some(y)) = (kinds[0].place(self.at[0]), kinds[1].place(self.at[1])) else { return };
        let [x, y] = scale.map([x, y]);
        let frame = scale.frame;
        if (frame.x..=frame.right()).contains(&x) && (frame.y..=frame.bottom()).contains(&y) {
            self.glyph.draw(svg, [x, y], 4.0, INK);
        }
    }
}
