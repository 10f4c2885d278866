//! Branches of motions against a parameter: a bifurcation diagram.

use super::axes::AxisKind;
use super::clip::clip;
use super::error::{Result, check_finite};
use super::geometry::{Point, Range};
use super::glyph::Glyph;
use super::layer::{Marks, Row};
use super::legend::{Entry, Mark};
use super::marks::{REGIMES, regime_mark};
use super::paint::Paint;
use super::palette::{Colour, GREY, INK};
use super::plane::Plane;
use super::svg::Svg;

/// The reach of the axis towards unstable motions, in ranges of what is seen, where all of them would take more than [`SQUEEZED`] ranges.
const BEYOND: f64 = 2.0;
const SQUEEZED: f64 = 4.0;

/// The stability of a part of a branch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stability {
    /// Some deviation grows.
    Unstable,
    /// Nothing grows, and a growth rate is 0 within its error.
    Neutral,
    /// All deviations decay.
    Stable,
}

impl Stability {
    /// In the order in which they are drawn.
    const ALL: [Self; 3] = [Self::Unstable, Self::Neutral, Self::Stable];

    const fn name(self) -> &'static str {
        match self {
            Self::Unstable => "unstable",
            Self::Neutral => "neutral",
            Self::Stable => "stable",
        }
    }
}

/// A part of a branch over which neither motion nor stability changes.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchPart {
    /// The regime, for its colour.
    pub regime: String,
    /// Its stability.
    pub stability: Stability,
    /// Points in data units.
    pub points: Vec<Point>,
}

/// The samples of a sweep of the parameter in one direction.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchDots {
    /// Its label in the legend (markup).
    pub label: String,
    /// Upwards: dots; downwards: circles.
    pub up: bool,
    /// Points in data units.
    pub points: Vec<Point>,
}

/// A special point of a branch, with its marker.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchMark {
    /// Its label in the legend (markup).
    pub label: String,
    /// Its marker.
    pub glyph: Glyph,
    /// The point, in data units.
    pub at: Point,
}

/// Branches against a parameter, with the names of their motions beside them: thick where stable, thin where neutral, thin and dashed where
/// unstable, with markers at special points.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BranchDiagram {
    /// Range of the parameter; what lies outside is cut off.
    pub x: [f64; 2],
    /// The branches.
    pub parts: Vec<BranchPart>,
    /// Samples, drawn beneath.
    pub dots: Vec<BranchDots>,
    /// The special points, drawn on top.
    pub marks: Vec<BranchMark>,
}

impl Marks for BranchDiagram {
    fn check(&self) -> Result<()> {
        let parts = self.parts.iter().flat_map(|part| &part.points);
        let dots = self.dots.iter().flat_map(|dots| &dots.points);
        let points = parts.chain(self.marks.iter().map(|mark| &mark.at)).chain(dots);
        check_finite("branch value (parameter, value in turn)", points.flatten().chain(&self.x).copied())
    }

    fn extent(&self, [x, y]: [AxisKind; 2]) -> [Vec<f64>; 2] {
        let values = self.values(y).into_iter().flat_map(|range| [range.min, range.max]);
        [self.x.into_iter().filter_map(|end| x.place(end)).collect(), values.collect()]
    }

    fn frame(&self) -> [f64; 2] {
        [600.0, 360.0]
    }

    fn room(&self) -> [f64; 2] {
        [0.02, 0.06]
    }

    fn draw(&self, svg: &mut Svg, plane: &Plane, _: usize) {
        self.dots.iter().for_each(|dots| dots.draw(svg, plane));
        // stable parts on top of unstable ones
        for stability in Stability::ALL {
            self.parts
                .iter()
                .filter(|part| part.stability == stability)
                .for_each(|part| part.draw(svg, plane));
        }
        self.draw_names(svg, plane);
        for mark in &self.marks {
            if let Some(at) = plane.within(mark.at) {
                mark.glyph.draw(svg, at, 4.0, INK);
            }
        }
    }

    fn keys(&self, _: usize) -> Vec<Entry> {
        let has = |regime: &str| self.parts.iter().any(|part| regime_mark(&part.regime).name == regime);
        let regimes = REGIMES.iter().filter(|mark| has(mark.name));
        let mut entries: Vec<Entry> = regimes
            .map(|mark| Entry::new(Mark::Line(paint(mark.colour, Stability::Stable)), mark.words))
            .collect();
        for stability in Stability::ALL.into_iter().rev() {
            if self.parts.iter().any(|part| part.stability == stability) {
                entries.push(Entry::new(Mark::Line(paint(INK, stability)), stability.name()));
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

    fn columns(&self) -> [&'static [&'static str]; 2] {
        [&["part", "regime", "stable", "special"], &[]]
    }

    /// A row per point, part after part, then the special points and the samples.
    fn rows(&self) -> Vec<Row> {
        let row = |texts: [&str; 4], at: &Point| {
            let texts = texts.map(str::to_owned).to_vec();
            Row { texts, at: at.map(Some), numbers: Vec::new() }
        };
        let mut rows = Vec::new();
        for (number, part) in self.parts.iter().enumerate() {
            let (number, stable) =
                (number.to_string(), if part.stability == Stability::Stable { "1" } else { "0" });
            rows.extend(part.points.iter().map(|at| row([&number, &part.regime, stable, ""], at)));
        }
        rows.extend(self.marks.iter().map(|mark| row(["", "", "", &mark.label], &mark.at)));
        for dots in &self.dots {
            rows.extend(dots.points.iter().map(|at| row([&dots.label, "", "", ""], at)));
        }
        rows
    }
}

impl BranchDiagram {
    /// The places of values within the range of the parameter: of motions that are not unstable, marks and samples, or of everything.
    fn places(&self, kind: AxisKind, seen: bool) -> Option<Range> {
        let parts = self
            .parts
            .iter()
            .filter(|part| part.stability != Stability::Unstable || !seen)
            .flat_map(|part| &part.points);
        let points = parts.chain(self.dots.iter().flat_map(|dots| &dots.points));
        let points = points.chain(self.marks.iter().filter(|_| seen).map(|mark| &mark.at));
        let shown = points.filter(|p| self.x[0] <= p[0] && p[0] <= self.x[1]);
        Range::of(shown.filter_map(|p| kind.place(p[1])))
    }

    /// Returns `true` if a branch leaves the frame upwards or downwards.
    pub fn leaves(&self, kind: AxisKind) -> bool {
        let ends = |range: Option<Range>| range.map(|range| [range.min, range.max]);
        ends(self.places(kind, false)) != ends(self.values(kind))
    }

    /// The values in sight: an unstable motion whose values are far from those of all others leaves the frame, or it would squeeze them.
    fn values(&self, kind: AxisKind) -> Option<Range> {
        let all = self.places(kind, false)?;
        let Some(seen) = self.places(kind, true).filter(|seen| seen.span() > 0.0) else { return Some(all) };
        if all.span() <= SQUEEZED * seen.span() {
            return Some(all);
        }
        let far = BEYOND * seen.span();
        Some(Range { min: all.min.max(seen.min - far), max: all.max.min(seen.max + far) })
    }
}

/// Dashes and gaps of unstable motions, and the sum of both.
const DASHES: (&str, f64) = ("4 2.5", 6.5);

fn paint(colour: Colour, stability: Stability) -> Paint {
    match stability {
        Stability::Stable => Paint::stroke(colour, 3.0),
        Stability::Neutral => Paint::stroke(colour, 1.3),
        Stability::Unstable => Paint::stroke(colour, 1.3).dashed(DASHES.0),
    }
}

impl BranchPart {
    fn draw(&self, svg: &mut Svg, plane: &Plane) {
        let places: Vec<Point> = self.points.iter().filter_map(|point| plane.at(*point)).collect();
        for mut piece in clip(&places, plane.scale.frame) {
            let mut paint = paint(regime_mark(&self.regime).colour, self.stability);
            // dashes of unstable motions that lie on each other coincide: those at rest would fill each other's gaps, and look stable
            if self.stability == Stability::Unstable {
                if piece.first().map(|from| from[0]) > piece.last().map(|to| to[0]) {
                    piece.reverse();
                }
                paint = paint.dash_from(piece.first().map_or(0.0, |from| from[0].rem_euclid(DASHES.1)));
            }
            svg.polyline(&piece, false, &paint);
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

    fn draw(&self, svg: &mut Svg, plane: &Plane) {
        for at in self.points.iter().filter_map(|point| plane.within(*point)) {
            svg.circle(at, self.radius(), &self.paint());
        }
    }
}
