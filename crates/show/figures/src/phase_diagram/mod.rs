//! Phase diagrams: regimes over one or two parameters.

mod cells;
mod inset;
mod labels;
mod mosaic;
mod names;
mod spacing;
mod strip;
mod tiles;

use super::axes::Scale;
use super::error::{FigureError, Result, check_finite};
use super::expected::ExpectedLine;
use super::figure::{Csv, figure};
use super::framed::Framed;
use super::geometry::{Range, Rect};
use super::legend::{Entry, Mark};
use super::marks::{REGIMES, RegimeMark};
use super::paint::Paint;
use super::palette::{Colour, WHITE};
use super::room::Room;
use super::svg::Svg;
use cells::Cells;
pub use inset::MapInset;
pub(crate) use names::Names;
pub(crate) use spacing::Spacing;

/// Most cells a side that get markers.
const TILES: usize = 40;
/// Widest frame of many cells, in pixels.
const WIDTH: f64 = 500.0;

/// The result at one point.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// Place across, one of the diagram's `x`.
    pub x: f64,
    /// Place upwards, one of the diagram's `y`; of no account in a strip.
    pub y: f64,
    /// Regimes by name (see [`super::regime_mark`]) with their shares of the initial states, which add up to 1.
    pub shares: Vec<(String, f64)>,
}

/// A phase diagram. Every cell has its centre at its value: an axis is linear where the steps between its values are equal, logarithmic
/// where their ratios are, and otherwise has columns of one width, with the values as ticks. Up to 40 x 40 cells carry markers on a pale
/// ground; finer ones are coloured, with one marker in each wide region. Where several motions occur, stripes show their shares, and the
/// two most frequent ones have their markers side by side.
///
/// With at most one value of `y` the diagram is a strip: over each `x` stands a bar of the shares, the markers above.
///
/// # Units   those of the values; texts are markup (see [`super::Label`])
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PhaseDiagram {
    /// Line above the legend.
    pub title: String,
    /// Paragraphs below the axes.
    pub caption: Vec<String>,
    /// Label of the x axis.
    pub x_label: String,
    /// Label of the y axis; a strip has its own.
    pub y_label: String,
    /// Cell centres across, increasing.
    pub x: Vec<f64>,
    /// Cell centres upwards, increasing; empty or a single value for a strip.
    pub y: Vec<f64>,
    /// The results; points without a cell stay white.
    pub cells: Vec<Cell>,
    /// Lines in front of the cells, behind their markers. In a strip their y runs from 0 to 1.
    pub lines: Vec<ExpectedLine>,
}

impl PhaseDiagram {
    /// Draws the figure for a width.
    ///
    /// # Errors   no cell or no x, a number that is not finite, centres that do not increase, a cell at no centre or at
    /// that of an earlier one, or shares that do not add up to 1
    pub fn svg_in(&self, room: Room) -> Result<Svg> {
        check_finite("boundary line value", self.lines.iter().flat_map(|l| &l.points).flatten().copied())?;
        let strip = self.y.len() < 2;
        let grid = |of: &Self| Cells::new(&of.x, if strip { &[] } else { &of.y }, &of.cells);
        grid(self)?;
        let spacings = self.spacings();
        let placed = self.placed(&spacings);
        let cells = grid(&placed)?;
        let look = Look::of(strip, cells.size(), room);
        let (w, h) = look.frame(cells.size());
        let [x, y] = cells.ranges();
        let scale = Scale { frame: Rect { x: 0.0, y: 0.0, w, h }, x, y };
        let y_label = if strip { "share of initial states" } else { &self.y_label };
        let sheet = Framed {
            title: &self.title,
            caption: &self.caption,
            legend: self.legend(&cells, look, None),
            scale,
            kinds: [spacings[0].kind(), spacings[1].kind()],
            columns: [spacings[0].listed(), spacings[1].listed()],
            labels: [&self.x_label, y_label],
            room,
            grid: false,
            head: if strip { strip::HEAD } else { 0.0 },
        };
        sheet.svg(|svg, scale| placed.draw(svg, scale, &cells, look))
    }

    /// Draws the cells into the frame of another figure, with their markers unless they have names
    /// ([`Self::names`]); what lies outside is cut off.
    pub(crate) fn draw_under(&self, svg: &mut Svg, scale: &Scale, room: Room, named: bool) -> Result<()> {
        let cells = Cells::new(&self.x, &self.y, &self.cells)?;
        let [x, y] = cells.ranges();
        let ([left, top], [right, bottom]) = (scale.map([x.min, y.max]), scale.map([x.max, y.min]));
        let own = Scale { frame: Rect { x: left, y: top, w: right - left, h: bottom - top }, x, y };
        let mut drawn = Ok(());
        svg.clipped(scale.frame, |svg| {
            if !named && Look::of(false, cells.size(), room) == Look::Tiles {
                tiles::draw_grounds(svg, &own, &cells);
                tiles::draw_markers(svg, &own, &cells);
            } else {
                drawn = mosaic::png(&own, &cells).map(|image| svg.image(own.frame, &image));
            }
            if !named && Look::of(false, cells.size(), room) == Look::Mosaic {
                labels::draw(svg, &own, &cells);
            }
        });
        drawn
    }

    /// The names of wide regions for the frame of another figure whose corner is the origin, with their
    /// paths, where `clear` has nothing against a place.
    pub(crate) fn names(
        &self,
        scale: &Scale,
        insets: &[MapInset],
        clear: &dyn Fn(&Rect) -> bool,
    ) -> Result<Names> {
        let cells = Cells::new(&self.x, &self.y, &self.cells)?;
        Ok(names::places(scale, &cells, insets, clear))
    }

    /// The ranges that the cells cover, across and upwards.
    pub(crate) fn ranges(&self) -> Result<[Range; 2]> {
        Ok(Cells::new(&self.x, &self.y, &self.cells)?.ranges())
    }

    /// The part of the legend that explains the cells: without the motions whose names stand in the plane.
    pub(crate) fn key_under(&self, room: Room, names: Option<&Names>) -> Result<Vec<Entry>> {
        let cells = Cells::new(&self.x, &self.y, &self.cells)?;
        let look = if names.is_some() { Look::Mosaic } else { Look::of(false, cells.size(), room) };
        Ok(Self::default().legend(&cells, look, names))
    }

    fn draw(&self, svg: &mut Svg, scale: &Scale, cells: &Cells, look: Look) -> Result<()> {
        match look {
            Look::Strip => strip::draw(svg, scale, cells),
            Look::Tiles => tiles::draw_grounds(svg, scale, cells),
            Look::Mosaic => svg.image(scale.frame, &mosaic::png(scale, cells)?),
        }
        self.draw_lines(svg, scale);
        match look {
            Look::Tiles => tiles::draw_markers(svg, scale, cells),
            Look::Mosaic => labels::draw(svg, scale, cells),
            Look::Strip => {}
        }
        Ok(())
    }

    fn legend(&self, cells: &Cells, look: Look, names: Option<&Names>) -> Vec<Entry> {
        let told = |rank| names.is_some_and(|names| names.tell(rank));
        let present = REGIMES.iter().enumerate().filter(|(rank, _)| cells.has(*rank) && !told(*rank));
        let mut entries: Vec<_> = present.map(|(_, mark)| Entry::new(look.key(*mark), mark.words)).collect();
        if let (Some([one, other]), true) = (cells.first_pair(), look != Look::Strip) {
            let stripes = Mark::Stripes(look.ground(&REGIMES[one]), look.ground(&REGIMES[other]));
            entries.push(Entry::new(stripes, "stripes: several motions"));
        }
        entries.extend(self.line_entries());
        entries
    }

    /// The legend of the lines: those of one kind have one entry.
    pub(crate) fn line_entries(&self) -> impl Iterator<Item = Entry> + '_ {
        let first = |(place, line): &(usize, &ExpectedLine)| {
            self.lines[..*place].iter().all(|other| other.label != line.label || other.style != line.style)
        };
        let kinds = self.lines.iter().enumerate().filter(first);
        kinds.map(|(_, line)| Entry::new(Mark::Line(line.style.paint()), &line.label))
    }

    pub(crate) fn draw_lines(&self, svg: &mut Svg, scale: &Scale) {
        self.lines.iter().for_each(|line| line.draw_cased(svg, scale));
    }

    /// A row per cell and regime, and one per point of each line, which has no share.
    fn csv(&self) -> String {
        let strip = self.y.len() < 2;
        let mut csv = Csv::new(["regime or line", &self.x_label, &self.y_label, "share"]);
        for cell in &self.cells {
            for (regime, share) in &cell.shares {
                csv.row(&[regime], [Some(cell.x), (!strip).then_some(cell.y), Some(*share)]);
            }
        }
        for line in &self.lines {
            line.points.iter().for_each(|[x, y]| csv.row(&[&line.label], [Some(*x), Some(*y), None]));
        }
        csv.finish()
    }
}

figure!(PhaseDiagram);

/// The style of the cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Look {
    /// Markers on pale tiles.
    Tiles,
    /// Coloured cells.
    Mosaic,
    /// Bars over one axis.
    Strip,
}

impl Look {
    fn of(strip: bool, (columns, rows): (usize, usize), room: Room) -> Self {
        let most = room.most(TILES, WIDTH);
        match strip {
            true => Self::Strip,
            false if columns <= most && rows <= most => Self::Tiles,
            false => Self::Mosaic,
        }
    }

    /// Size of the frame in pixels: cells of a handy size, whole half-pixels where there are many.
    fn frame(self, (columns, rows): (usize, usize)) -> (f64, f64) {
        let snapped = |cell: f64| if cell > 0.5 { (2.0 * cell).round() / 2.0 } else { cell };
        let (columns, rows) = (columns as f64, rows as f64);
        if self == Self::Strip {
            return (columns * snapped(520.0 / columns).min(130.0), 150.0);
        }
        let (w, h) = ((WIDTH / columns).min(56.0), (460.0 / rows).min(56.0));
        let (w, h) = (w.min(1.8 * h), h.min(1.4 * w));
        ((columns * snapped(w)).max(280.0), (rows * snapped(h)).max(160.0))
    }

    fn ground(self, mark: &RegimeMark) -> Colour {
        if self == Self::Tiles { mark.tint() } else { mark.area }
    }

    fn key(self, mark: RegimeMark) -> Mark {
        match self {
            Self::Tiles => Mark::Regime(mark, mark.tint()),
            Self::Mosaic | Self::Strip => Mark::Area(mark),
        }
    }
}
