//! The legend of a figure: rows of marks with labels, always outside the data.

use super::geometry::{Point, Rect};
use super::glyph::Glyph;
use super::marks::RegimeMark;
use super::paint::Paint;
use super::palette::{BLACK, Colour, GREY, INK, WHITE};
use super::stripes::{draw_bands, draw_falling, draw_hatch};
use super::svg::{Anchor, Svg};
use super::text::Label;

const SIZE: f64 = 12.0;
const MARK: f64 = 22.0;
const GAP: f64 = 18.0;
/// Height of a row, in pixels.
pub(crate) const ROW: f64 = 19.0;

/// More rows than this are packed more densely on a narrow sheet.
const MANY: f64 = 3.0;
/// Gap between entries and height of a row there, in pixels.
const DENSE: [f64; 2] = [11.0, 16.0];

/// The mark before the label.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Mark {
    /// A line.
    Line(Paint),
    /// A line with an arrow head.
    Arrow(Paint, Colour),
    /// A filled closed curve.
    Outline(Paint),
    /// A tinted region within its edge, both on a white ground as over cells.
    Region,
    /// A disc of a radius in pixels.
    Dot(Paint, f64),
    /// The mark of the first point.
    Start,
    /// The mark of the last point.
    End,
    /// A marker, on a line if its points are joined.
    Point(Glyph, Colour, bool),
    /// A regime: its marker on its ground of the given colour.
    Regime(RegimeMark, Colour),
    /// A regime: its marker beside the colour of its areas.
    Area(RegimeMark),
    /// Stripes of two colours.
    Stripes(Colour, Colour),
    /// A line on a band of the same colour.
    Band(Colour),
    /// None: the label says it all.
    Words,
}

/// A mark and its label.
#[derive(Debug, Clone)]
pub(crate) struct Entry {
    mark: Mark,
    label: Label,
}

impl Entry {
    /// An entry; `label` is markup.
    pub(crate) fn new(mark: Mark, label: &str) -> Self {
        Self { mark, label: Label::parse(label) }
    }

    fn width(&self) -> f64 {
        self.indent() + self.label.width(SIZE)
    }

    /// The indentation of the label.
    fn indent(&self) -> f64 {
        if matches!(self.mark, Mark::Words) { 0.0 } else { MARK + 6.0 }
    }
}

/// The entries in an order in which they fill fewer rows of a width: each fills up the first row that has room for it.
pub(crate) fn packed(entries: Vec<Entry>, width: f64) -> Vec<Entry> {
    packed_by(entries, width, GAP)
}

fn packed_by(entries: Vec<Entry>, width: f64, gap: f64) -> Vec<Entry> {
    let mut rows: Vec<(f64, Vec<Entry>)> = Vec::new();
    for entry in entries {
        let wide = entry.width();
        // a key in words stays together, at the end
        let first = if matches!(entry.mark, Mark::Words) { rows.len().saturating_sub(1) } else { 0 };
        match rows.iter_mut().skip(first).find(|(used, _)| used + gap + wide <= width) {
            Some((used, row)) => {
                *used += gap + wide;
                row.push(entry);
            }
            None => rows.push((wide, vec![entry])),
        }
    }
    rows.into_iter().flat_map(|row| row.1).collect()
}

/// Entries with their places.
#[derive(Debug, Clone)]
pub(crate) struct Legend {
    placed: Vec<(Point, Entry)>,
    width: f64,
    height: f64,
    /// Height of a row.
    row: f64,
}

impl Legend {
    /// Flows the entries into rows of at most `width` pixels; one a row if the width is 0.
    pub(crate) fn flowed(entries: Vec<Entry>, width: f64) -> Self {
        Self::spaced(entries, width, [GAP, ROW])
    }

    /// The same on a narrow sheet: entries that fill many rows are packed more densely.
    pub(crate) fn narrow(entries: Vec<Entry>, width: f64) -> Self {
        let usual = Self::flowed(entries, width);
        if usual.height <= MANY * ROW {
            return usual;
        }
        let entries = usual.placed.into_iter().map(|placed| placed.1).collect();
        Self::spaced(packed_by(entries, width, DENSE[0]), width, DENSE)
    }

    fn spaced(entries: Vec<Entry>, width: f64, [gap, row]: [f64; 2]) -> Self {
        let mut legend = Self { placed: Vec::new(), width: 0.0, height: 0.0, row };
        let (mut x, mut y) = (0.0, 0.0);
        for entry in entries {
            if x > 0.0 && x + entry.width() > width {
                (x, y) = (0.0, y + row);
            }
            legend.width = legend.width.max(x + entry.width());
            legend.height = y + row;
            let next = x + entry.width() + gap;
            legend.placed.push(([x, y], entry));
            x = next;
        }
        legend
    }

    /// Width in pixels.
    pub(crate) fn width(&self) -> f64 {
        self.width
    }

    /// Height in pixels; 0 without entries.
    pub(crate) fn height(&self) -> f64 {
        self.height
    }

    /// Draws with the top left corner at `at`.
    pub(crate) fn draw(&self, svg: &mut Svg, at: Point) {
        for ([x, y], entry) in &self.placed {
            let (left, middle) = (at[0] + x, at[1] + y + 0.5 * self.row);
            draw_mark(svg, entry.mark, [left + 0.5 * MARK, middle]);
            svg.text([left + entry.indent(), middle + 0.36 * SIZE], SIZE, Anchor::Start, &entry.label);
        }
    }
}

fn draw_mark(svg: &mut Svg, mark: Mark, [x, y]: Point) {
    let (left, right) = ([x - 0.5 * MARK, y], [x + 0.5 * MARK, y]);
    match mark {
        Mark::Words => {}
        Mark::Line(paint) => svg.line(left, right, &paint),
        Mark::Arrow(paint, colour) => {
            svg.line(left, [x + 3.0, y], &paint);
            draw_arrow(svg, [x + 5.0, y], [1.0, 0.0], colour);
        }
        Mark::Outline(paint) => {
            svg.polyline(&ellipse([x, y], [0.42 * MARK, 0.26 * MARK]), true, &paint);
        }
        Mark::Region => {
            let rim = ellipse([x, y], [0.46 * MARK, 0.31 * MARK]);
            draw_region(svg, &rim);
            draw_edge(svg, &rim);
        }
        Mark::Dot(paint, radius) => svg.circle([x, y], radius, &paint),
        Mark::Start => draw_start(svg, [x, y]),
        Mark::End => draw_end(svg, [x, y]),
        Mark::Point(glyph, colour, joined) => {
            if joined {
                svg.line(left, right, &Paint::stroke(colour, 1.4));
            }
            glyph.draw(svg, [x, y], 3.6, colour);
        }
        Mark::Regime(mark, ground) => {
            draw_swatch(svg, swatch([x, y], 20.0), &mark, ground);
            mark.draw(svg, [x, y], 4.2);
        }
        Mark::Area(mark) => {
            draw_swatch(svg, swatch([x + 5.5, y], 11.0), &mark, mark.area);
            mark.draw(svg, [x - 6.5, y], 4.0);
        }
        Mark::Stripes(one, other) => {
            let swatch = swatch([x, y], 20.0);
            draw_bands(svg, swatch, &[(one, 0.5), (other, 0.5)], 2);
            svg.rect(swatch, &Paint::stroke(GREY, 0.8));
        }
        Mark::Band(colour) => {
            let band = Rect { x: x - 0.5 * MARK, y: y - 5.0, w: MARK, h: 10.0 };
            svg.rect(band, &Paint::fill(colour).opacity(BAND));
            svg.line(left, right, &Paint::stroke(colour, 1.6));
        }
    }
}

/// An ellipse of 24 points, the first at its right end and again at the end.
fn ellipse([x, y]: Point, [a, b]: [f64; 2]) -> Vec<Point> {
    let point = |i: u32| {
        let (s, c) = (f64::from(i) * std::f64::consts::TAU / 24.0).sin_cos();
        [x + a * c, y + b * s]
    };
    (0..=24).map(point).collect()
}

/// The ground of a region of confidence.
pub(crate) fn draw_region(svg: &mut Svg, outline: &[Point]) {
    svg.polyline(outline, true, &Paint::fill(WHITE).opacity(REGION));
}

/// A piece of the edge of a region of confidence.
pub(crate) fn draw_edge(svg: &mut Svg, piece: &[Point]) {
    svg.polyline(piece, false, &Paint::stroke(WHITE, 3.6).opacity(0.85));
    svg.polyline(piece, false, &Paint::stroke(INK, 1.4).dashed("2.5 2"));
}

/// Opacity of the white ground of a region: the cells beneath stay in sight.
const REGION: f64 = 0.45;

/// Opacity of the band about a curve.
pub(crate) const BAND: f64 = 0.22;

fn swatch([x, y]: Point, w: f64) -> Rect {
    Rect { x: x - 0.5 * w, y: y - 7.0, w, h: 14.0 }
}

fn draw_swatch(svg: &mut Svg, rect: Rect, mark: &RegimeMark, ground: Colour) {
    svg.rect(rect, &Paint::fill(ground));
    if mark.is_undetermined() {
        draw_hatch(svg, rect);
    }
    if mark.is_clockwise() {
        draw_falling(svg, rect);
    }
    svg.rect(rect, &Paint::stroke(GREY, 0.8));
}

/// The first point: a white disc with a black edge.
pub(crate) fn draw_start(svg: &mut Svg, at: Point) {
    svg.circle(at, 4.2, &Paint::fill(WHITE).edge(BLACK, 1.6));
}

/// The last point: a black square with a white edge.
pub(crate) fn draw_end(svg: &mut Svg, [x, y]: Point) {
    let corners =
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[u, v]| [x + 4.0 * u, y + 4.0 * v]);
    svg.polyline(&corners, true, &Paint::fill(BLACK).edge(WHITE, 1.0));
}

/// An arrow head whose centre is `at`, along the unit vector `way`.
pub(crate) fn draw_arrow(svg: &mut Svg, at: Point, way: Point, colour: Colour) {
    let corner = |ahead: f64, aside: f64| {
        [at[0] + ahead * way[0] - aside * way[1], at[1] + ahead * way[1] + aside * way[0]]
    };
    let corners = [corner(6.0, 0.0), corner(-4.0, 3.8), corner(-2.2, 0.0), corner(-4.0, -3.8)];
    svg.polyline(&corners, true, &Paint::fill(colour).edge(WHITE, 0.7));
}
