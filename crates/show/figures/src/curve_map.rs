//! Curves of bifurcations in a plane of two parameters, over the regimes if these are known.

use super::axes::Scale;
use super::callouts::{Around, Callouts, taken};
use super::clip::clip;
use super::error::{FigureError, Result, check_finite};
use super::figure::{Csv, figure};
use super::framed::Framed;
use super::geometry::{Point, Range, Rect};
use super::glyph::Glyph;
use super::legend::{Entry, Mark, packed};
use super::line_style::LineStyle;
use super::paint::Paint;
use super::palette::{INK, WHITE};
use super::phase_diagram::{MapInset, Names, PhaseDiagram, Spacing};
use super::room::Room;
use super::svg::Svg;

const WIDTH: f64 = 600.0;
const HEIGHT: f64 = 420.0;

/// The style of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveStyle {
    /// As a line of theory.
    Line(LineStyle),
    /// A stroke and two dots in turn.
    DashDotDotted,
    /// Unbroken and thick.
    Thick,
}

impl CurveStyle {
    fn paint(self) -> Paint {
        match self {
            Self::Line(style) => style.paint(),
            Self::DashDotDotted => LineStyle::Solid.paint().dashed("9 2.5 1.7 2.5 1.7 2.5"),
            Self::Thick => Paint::stroke(INK, 3.2),
        }
    }
}

/// A stretch of a curve along which nothing changes.
#[derive(Debug, Clone, PartialEq)]
pub struct MapCurve {
    /// Its label in the legend (markup).
    pub label: String,
    /// Dashes.
    pub style: CurveStyle,
    /// `true` if the motion has no growing direction but the critical one: other curves are pale.
    pub bounds: bool,
    /// Points in units of the axes; what lies outside the frame is cut off.
    pub points: Vec<Point>,
}

/// A point of codimension two.
#[derive(Debug, Clone, PartialEq)]
pub struct MapMark {
    /// Its label in the figure (markup).
    pub label: String,
    /// The point, in units of the axes.
    pub at: Point,
}

/// A place where a motion ends in a connection.
#[derive(Debug, Clone, PartialEq)]
pub struct MapEnd {
    /// Its label in the legend (markup).
    pub label: String,
    /// The point, in units of the axes.
    pub at: Point,
}

/// The words in the frame of a map, with their places.
struct Words {
    names: Option<Names>,
    callouts: Callouts,
    /// The ends that are shown.
    ends: Vec<Point>,
}

/// Curves of bifurcations in a plane of two parameters, with their points of codimension two. Over regimes the axes are those of
/// their diagram: logarithmic, or columns, where that has them.
///
/// # Units   those of the labels; texts are markup (see [`super::Label`])
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CurveMap {
    /// Line above the legend.
    pub title: String,
    /// Paragraphs below the axes.
    pub caption: Vec<String>,
    /// Label of the x axis.
    pub x_label: String,
    /// Label of the y axis.
    pub y_label: String,
    /// Range across.
    pub x: [f64; 2],
    /// Range upwards.
    pub y: [f64; 2],
    /// The regimes beneath; of this diagram only the cells are drawn.
    pub under: Option<PhaseDiagram>,
    /// `true` if wide regions have their names in them.
    pub named: bool,
    /// Paths below the names of regions that have room for them.
    pub insets: Vec<MapInset>,
    /// The curves.
    pub curves: Vec<MapCurve>,
    /// Ends of motions.
    pub ends: Vec<MapEnd>,
    /// The points of codimension two.
    pub marks: Vec<MapMark>,
}

impl CurveMap {
    /// Draws the figure for a width.
    ///
    /// # Errors   a range or a number that is not finite, or what a [`PhaseDiagram`] refuses
    pub fn svg_in(&self, room: Room) -> Result<Svg> {
        let points = self.curves.iter().flat_map(|curve| &curve.points).flatten();
        let places = self.marks.iter().map(|mark| mark.at).chain(self.ends.iter().map(|end| end.at));
        check_finite("value of a curve", points.copied().chain(places.flatten()))?;
        let paths = self.insets.iter().flat_map(|inset| &inset.paths).flatten().flatten();
        check_finite("coordinate of a path", paths.copied())?;
        check_finite("end of a range", self.x.into_iter().chain(self.y))?;
        let even = [Spacing::Even, Spacing::Even];
        let spacings = self.under.as_ref().map_or(even, PhaseDiagram::spacings);
        self.placed(&spacings).drawn(&spacings, room)
    }

    /// The map with places along its axes instead of values; what has none is left out.
    fn placed(&self, spacings: &[Spacing; 2]) -> Self {
        let place = |[x, y]: Point| Some([spacings[0].place(x)?, spacings[1].place(y)?]);
        let ends =
            |range: [f64; 2], side: usize| range.map(|end| spacings[side].place(end).unwrap_or(f64::NAN));
        let moved = |path: &Vec<Point>| path.iter().copied().filter_map(place).collect();
        let curve = |curve: &MapCurve| MapCurve { points: moved(&curve.points), ..curve.clone() };
        let mark = |mark: &MapMark| Some(MapMark { at: place(mark.at)?, ..mark.clone() });
        let end = |end: &MapEnd| Some(MapEnd { at: place(end.at)?, ..end.clone() });
        let inset = |inset: &MapInset| Some(MapInset { cell: place(inset.cell)?, ..inset.clone() });
        Self {
            x: ends(self.x, 0),
            y: ends(self.y, 1),
            under: self.under.as_ref().map(|under| under.placed(spacings).into_owned()),
            insets: self.insets.iter().filter_map(inset).collect(),
            curves: self.curves.iter().map(curve).collect(),
            ends: self.ends.iter().filter_map(end).collect(),
            marks: self.marks.iter().filter_map(mark).collect(),
            ..self.clone()
        }
    }

    /// Draws it, at places along axes of these kinds.
    fn drawn(&self, spacings: &[Spacing; 2], room: Room) -> Result<Svg> {
        let beneath = self.under.as_ref().map(PhaseDiagram::ranges).transpose()?;
        let range = |own: [f64; 2], side: usize| {
            let cells = beneath.iter().flat_map(|ranges| [ranges[side].min, ranges[side].max]);
            Range::of(own.into_iter().filter(|end| end.is_finite()).chain(cells))
                .ok_or(FigureError::Empty { what: "range" })
        };
        let (x, y) = (range(self.x, 0)?, range(self.y, 1)?);
        let frame = Rect { x: 0.0, y: 0.0, w: WIDTH, h: HEIGHT };
        let scale = Scale { frame, x: x.padded(0.0), y: y.padded(0.0) };
        let mut sheet = Framed {
            title: &self.title,
            caption: &self.caption,
            legend: Vec::new(),
            scale,
            kinds: spacings.each_ref().map(Spacing::kind),
            columns: spacings.each_ref().map(Spacing::listed),
            labels: [&self.x_label, &self.y_label],
            room,
            grid: self.under.is_none(),
            head: 0.0,
        };
        let (scale, width) = sheet.layout();
        let words = self.words_in(&scale)?;
        sheet.legend = packed(self.legend(room, &words)?, width);
        let key = words.callouts.key.iter().zip(1..);
        sheet.legend.extend(key.map(|(text, number)| Entry::new(Mark::Words, &format!("{number}: {text}"))));
        sheet.svg(|svg, scale| self.draw(svg, scale, room, &words))
    }

    /// The words in the frame: first the labels of points, then the names of regions, none on another, on a
    /// point or, if that can be, on a boundary.
    fn words_in(&self, scale: &Scale) -> Result<Words> {
        let shown = |at: &Point| {
            let ([x, y], frame) = (scale.map(*at), scale.frame);
            (frame.x..=frame.right()).contains(&x) && (frame.y..=frame.bottom()).contains(&y)
        };
        let marks: Vec<&MapMark> = self.marks.iter().filter(|mark| shown(&mark.at)).collect();
        let ends: Vec<Point> = self.ends.iter().map(|end| end.at).filter(shown).collect();
        let points = marks.iter().map(|mark| mark.at).chain(ends.iter().copied());
        let lines: Vec<_> =
            self.curves.iter().filter(|curve| curve.bounds).flat_map(|curve| curve.pieces(scale)).collect();
        let taken = points.map(|at| taken(scale.map(at))).collect();
        let mut around = Around { frame: scale.frame, taken, lines: &lines };
        let labels: Vec<_> = marks.iter().map(|mark| (scale.map(mark.at), mark.label.as_str())).collect();
        // a label lies beside its point, a name anywhere in its region
        let callouts = Callouts::new(&labels, &mut around);
        let names = match &self.under {
            Some(under) if self.named => {
                Some(under.names(scale, &self.insets, &|place| around.is_clear(place))?)
            }
            _ => None,
        };
        Ok(Words { callouts, names, ends })
    }

    fn draw(&self, svg: &mut Svg, scale: &Scale, room: Room, words: &Words) -> Result<()> {
        if let Some(under) = &self.under {
            under.draw_under(svg, scale, room, self.named)?;
        }
        // pale ones first: nothing hides what bounds a regime
        for bounds in [false, true] {
            let curves = || self.curves.iter().filter(move |curve| curve.bounds == bounds);
            // all grounds first: none hides a curve beside it
            curves().filter(|curve| curve.bounds).for_each(|curve| curve.draw_ground(svg, scale));
            curves().for_each(|curve| curve.draw(svg, scale));
        }
        let corner = [scale.frame.x, scale.frame.y];
        words.names.iter().for_each(|names| names.draw(svg, corner));
        for at in &words.ends {
            svg.circle(scale.map(*at), 5.0, &Paint::fill(WHITE).opacity(0.85));
            Glyph::Cross.draw(svg, scale.map(*at), 3.6, INK);
        }
        words.callouts.draw(svg, corner);
        Ok(())
    }

    fn legend(&self, room: Room, words: &Words) -> Result<Vec<Entry>> {
        let under = self.under.as_ref();
        let mut entries =
            under.map_or(Ok(Vec::new()), |under| under.key_under(room, words.names.as_ref()))?;
        let mut seen: Vec<&str> = Vec::new();
        for curve in &self.curves {
            if !seen.contains(&curve.label.as_str()) {
                seen.push(&curve.label);
                entries.push(Entry::new(Mark::Line(curve.style.paint()), &curve.label));
            }
        }
        if self.curves.iter().any(|curve| !curve.bounds) {
            let pale = LineStyle::Solid.paint().opacity(PALE);
            entries.push(Entry::new(Mark::Line(pale), "pale: of a motion unstable on both sides"));
        }
        for end in &self.ends {
            if !seen.contains(&end.label.as_str()) {
                seen.push(&end.label);
                entries.push(Entry::new(Mark::Point(Glyph::Cross, INK, false), &end.label));
            }
        }
        if !self.marks.is_empty() {
            entries.push(Entry::new(Mark::Point(Glyph::Ring, INK, false), "codimension two"));
        }
        Ok(entries)
    }

    /// A row per point, curve after curve, then the marks, then the cells beneath.
    fn csv(&self) -> String {
        let head = ["part", "line or regime", "bounds"];
        let mut csv =
            Csv::new(head.into_iter().chain([self.x_label.as_str(), self.y_label.as_str(), "share"]));
        for (number, curve) in self.curves.iter().enumerate() {
            let bounds = if curve.bounds { "1" } else { "0" };
            for [x, y] in &curve.points {
                csv.row(&[&number.to_string(), &curve.label, bounds], [Some(*x), Some(*y), None]);
            }
        }
        let ends = self.ends.iter().map(|end| (&end.label, end.at));
        for (label, [x, y]) in self.marks.iter().map(|mark| (&mark.label, mark.at)).chain(ends) {
            csv.row(&["", label, ""], [Some(x), Some(y), None]);
        }
        for cell in self.under.iter().flat_map(|under| &under.cells) {
            for (regime, share) in &cell.shares {
                csv.row(&["", regime, ""], [Some(cell.x), Some(cell.y), Some(*share)]);
            }
        }
        csv.finish()
    }
}

figure!(CurveMap);

/// Opacity of curves that bound nothing.
const PALE: f64 = 0.4;

impl MapCurve {
    fn pieces(&self, scale: &Scale) -> Vec<Vec<Point>> {
        let points: Vec<Point> = self.points.iter().map(|point| scale.map(*point)).collect();
        clip(&points, scale.frame)
    }

    /// The white ground of the line.
    fn draw_ground(&self, svg: &mut Svg, scale: &Scale) {
        let ground = Paint::stroke(WHITE, 3.6).opacity(0.85);
        self.pieces(scale).iter().for_each(|piece| svg.polyline(piece, false, &ground));
    }

    fn draw(&self, svg: &mut Svg, scale: &Scale) {
        let paint = self.style.paint();
        let paint = if self.bounds { paint } else { paint.opacity(PALE) };
        self.pieces(scale).iter().for_each(|piece| svg.polyline(piece, false, &paint));
    }
}

#[cfg(test)]
mod tests {
    use super::super::phase_diagram::Cell;
    use super::*;

    /// Over a diagram whose axes are logarithmic, or columns, curves and points lie at the values of the cells.
    #[test]
    fn axes_are_those_of_the_cells_beneath() {
        let (x, y) = (vec![0.01, 0.1, 1.0, 10.0], vec![0.1, 0.4, 0.8]);
        let places = x.iter().flat_map(|x| y.iter().map(|y| (*x, *y)));
        let cells = places.map(|(x, y)| Cell { x, y, shares: vec![("straight".to_owned(), 1.0)] }).collect();
        let style = CurveStyle::Line(LineStyle::Solid);
        let map = CurveMap {
            x: [0.0, 10.0],
            y: [0.1, 0.8],
            under: Some(PhaseDiagram { x, y, cells, ..PhaseDiagram::default() }),
            curves: vec![MapCurve {
                label: String::new(),
                style,
                bounds: true,
                points: vec![[0.1, 0.4], [0.0, 0.4], [1.0, 0.6]],
            }],
            marks: vec![MapMark { label: "cusp".to_owned(), at: [10.0, 0.8] }],
            ..CurveMap::default()
        };
        let found = map.placed(&map.under.as_ref().map(PhaseDiagram::spacings).expect("a diagram"));
        assert_eq!(found.curves[0].points, [[-1.0, 1.0], [0.0, 1.5]]); // 0 has no logarithm
        assert_eq!(found.marks[0].at, [1.0, 2.0]);
        assert!(map.svg().is_ok() && map.csv().contains("0.1,0.4"));
    }
}
