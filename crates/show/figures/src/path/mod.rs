//! The path of a domain's centre with outlines along it.

mod draw;
mod layout;

use super::error::{FigureError, Result, check_finite};
use super::figure::{Csv, figure};
use super::geometry::Point;
use super::room::Room;
use super::svg::Svg;

/// A position at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathPoint {
    /// Time.
    pub t: f64,
    /// Position across.
    pub x: f64,
    /// Position upwards.
    pub y: f64,
}

/// The closed outline of the domain at a time.
#[derive(Debug, Clone, PartialEq)]
pub struct OutlineStamp {
    /// Time.
    pub t: f64,
    /// Vertices in the plane of the path, in order; closed by the drawing.
    pub points: Vec<Point>,
}

/// A straight section of the plane, with the points where the path crosses it.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionLine {
    /// One end.
    pub from: Point,
    /// Other end.
    pub to: Point,
    /// Markup for the legend, such as "section *y* = 3".
    pub label: String,
    /// Crossings, drawn as dots.
    pub crossings: Vec<Point>,
}

/// A path in the plane: equal axes, arrows of direction, outlines coloured by time, legend, caption.
///
/// The sheet takes the shape of the data between 1:3 and 3:1; beyond that the shorter axis shows more of the plane.
///
/// # Units   model length and time; texts are markup (see [`super::Label`])
/// # Not     scaling outlines: a caller that draws them enlarged must pass enlarged outlines and state this in the caption
#[derive(Debug, Clone, PartialEq)]
pub struct PathFigure {
    /// Line above the axes.
    pub title: String,
    /// Paragraphs below the axes: parameters, method, scale of the outlines.
    pub caption: Vec<String>,
    /// Label of the x axis.
    pub x_label: String,
    /// Label of the y axis.
    pub y_label: String,
    /// Label of the time colours.
    pub time_label: String,
    /// Pieces of the path, each in order of time; pieces are not joined.
    pub segments: Vec<Vec<PathPoint>>,
    /// Outlines, in order of time (later ones lie on top).
    pub outlines: Vec<OutlineStamp>,
    /// A section and its crossings.
    pub section: Option<SectionLine>,
}

impl Default for PathFigure {
    fn default() -> Self {
        Self {
            title: String::new(),
            caption: Vec::new(),
            x_label: "*x*".to_owned(),
            y_label: "*y*".to_owned(),
            time_label: "*t*".to_owned(),
            segments: Vec::new(),
            outlines: Vec::new(),
            section: None,
        }
    }
}

impl PathFigure {
    /// Draws the figure for a width.
    ///
    /// # Errors   neither path nor outline has a point, or a number is not finite
    pub fn svg_in(&self, room: Room) -> Result<Svg> {
        self.check()?;
        Ok(layout::Layout::of(self, room).draw(self, room))
    }

    fn points(&self) -> impl Iterator<Item = &PathPoint> {
        self.segments.iter().flatten()
    }

    fn outline_points(&self) -> impl Iterator<Item = Point> {
        self.outlines.iter().flat_map(|outline| outline.points.iter().copied())
    }

    fn section_points(&self) -> impl Iterator<Item = Point> {
        let line = |s: &SectionLine| [s.from, s.to].into_iter().chain(s.crossings.clone());
        self.section.iter().flat_map(line)
    }

    /// All places that must be visible.
    fn places(&self) -> impl Iterator<Item = Point> {
        let path = self.points().map(|p| [p.x, p.y]);
        path.chain(self.outline_points()).chain(self.section_points())
    }

    fn check(&self) -> Result<()> {
        if self.points().next().is_none() && self.outline_points().next().is_none() {
            return Err(FigureError::Empty { what: "path" });
        }
        check_finite("path value (t, x, y in turn)", self.points().flat_map(|p| [p.t, p.x, p.y]))?;
        check_finite("outline time", self.outlines.iter().map(|o| o.t))?;
        check_finite("outline coordinate", self.outline_points().flatten())?;
        check_finite("section coordinate", self.section_points().flatten())
    }

    /// A row per point of the path, of each outline and of the crossings of the section.
    fn csv(&self) -> String {
        let mut csv = Csv::new(["part", &self.time_label, &self.x_label, &self.y_label]);
        for segment in &self.segments {
            segment.iter().for_each(|p| csv.row(&["path"], [p.t, p.x, p.y].map(Some)));
        }
        for outline in &self.outlines {
            outline.points.iter().for_each(|[x, y]| csv.row(&["outline"], [outline.t, *x, *y].map(Some)));
        }
        for [x, y] in self.section.iter().flat_map(|section| &section.crossings) {
            csv.row(&["crossing"], [None, Some(*x), Some(*y)]);
        }
        csv.finish()
    }
}

figure!(PathFigure);
