//! Places on a phase diagram, with what is uncertain about them.

use super::axes::{AxisKind, Scale};
use super::beside::beside;
use super::clip::clip;
use super::error::{FigureError, Result, check_finite};
use super::figure::{Csv, figure};
use super::framed::Framed;
use super::geometry::{Point, Range, Rect};
use super::glyph::Glyph;
use super::legend::{Entry, Mark, draw_edge, draw_region};
use super::paint::Paint;
use super::palette::{BLACK, INK, WHITE};
use super::phase_diagram::PhaseDiagram;
use super::room::Room;
use super::svg::{Anchor, Svg};
use super::text::Label;

const WIDTH: f64 = 560.0;
const HEIGHT: f64 = 400.0;
/// Size of names, in pixels.
const NAME: f64 = 12.0;
/// Most places that have their names beside them.
const NAMED: usize = 12;

/// A place with its uncertainty.
#[derive(Debug, Clone, PartialEq)]
pub struct MapPlace {
    /// Its name (markup).
    pub name: String,
    /// The point.
    pub at: Point,
    /// The boundary of its region of confidence, closed by the drawing; empty for none.
    pub region: Vec<Point>,
    /// Samples of where it may be.
    pub cloud: Vec<Point>,
}

/// Places on a phase diagram: names, regions of confidence, clouds of samples.
///
/// # Units   those of the labels; texts are markup (see [`super::Label`])
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PlaceMap {
    /// Line above the legend.
    pub title: String,
    /// Paragraphs below the axes, in particular the meaning of the regions.
    pub caption: Vec<String>,
    /// Label of the x axis.
    pub x_label: String,
    /// Label of the y axis.
    pub y_label: String,
    /// The diagram beneath, with its lines.
    pub under: PhaseDiagram,
    /// The label of the regions in the legend (markup).
    pub region_label: String,
    /// The label of the clouds in the legend (markup).
    pub cloud_label: String,
    /// The places.
    pub places: Vec<MapPlace>,
}

impl PlaceMap {
    /// Draws the figure for a width. All places are in sight; regions and clouds are cut off at the frame.
    ///
    /// # Errors   no place, a number that is not finite, or what a [`PhaseDiagram`] refuses
    pub fn svg_in(&self, room: Room) -> Result<Svg> {
        let all = || {
            self.places.iter().flat_map(|p| [p.at].into_iter().chain(p.region.clone()).chain(p.cloud.clone()))
        };
        check_finite("coordinate of a place", all().flatten())?;
        if self.places.is_empty() {
            return Err(FigureError::Empty { what: "list of places" });
        }
        let beneath = self.under.ranges()?;
        let range = |side: usize| {
            let own = Range::of(self.places.iter().map(|place| place.at[side]));
            let own = own.unwrap_or(beneath[side]);
            if own.min >= beneath[side].min && own.max <= beneath[side].max {
                return beneath[side];
            }
            let both = [own.min, own.max, beneath[side].min, beneath[side].max];
            Range::of(both).unwrap_or(beneath[side]).padded(0.04)
        };
        let scale = Scale { frame: Rect { x: 0.0, y: 0.0, w: WIDTH, h: HEIGHT }, x: range(0), y: range(1) };
        let sheet = Framed {
            title: &self.title,
            caption: &self.caption,
            legend: self.legend(room)?,
            scale,
            kinds: [AxisKind::Linear; 2],
            columns: [None; 2],
            labels: [&self.x_label, &self.y_label],
            room,
            grid: false,
            head: 0.0,
        };
        sheet.svg(|svg, scale| {
            self.under.draw_under(svg, scale, room, false)?;
            self.under.draw_lines(svg, scale);
            self.places.iter().for_each(|place| place.draw(svg, scale));
            let mut taken = Vec::new();
            let named = self.places.len() <= NAMED;
            self.places.iter().filter(|_| named).for_each(|place| place.write(svg, scale, &mut taken));
            Ok(())
        })
    }

    fn legend(&self, room: Room) -> Result<Vec<Entry>> {
        let mut entries = self.under.key_under(room, None)?;
        entries.extend(self.under.line_entries());
        entries.push(Entry::new(Mark::Point(Glyph::Diamond, BLACK, false), "the cell"));
        if self.places.iter().any(|place| !place.region.is_empty()) {
            entries.push(Entry::new(Mark::Region, &self.region_label));
        }
        if self.places.iter().any(|place| !place.cloud.is_empty()) {
            entries.push(Entry::new(Mark::Dot(dot(), 1.8), &self.cloud_label));
        }
        Ok(entries)
    }

    /// A row per place, point of a region and sample.
    fn csv(&self) -> String {
        let mut csv = Csv::new(["place", "part", &self.x_label, &self.y_label]);
        for place in &self.places {
            csv.row(&[&place.name, "place"], place.at.map(Some));
            place.region.iter().for_each(|at| csv.row(&[&place.name, "region"], at.map(Some)));
            place.cloud.iter().for_each(|at| csv.row(&[&place.name, "sample"], at.map(Some)));
        }
        csv.finish()
    }
}

figure!(PlaceMap);

fn dot() -> Paint {
    Paint::fill(INK).edge(WHITE, 0.5)
}

impl MapPlace {
    fn draw(&self, svg: &mut Svg, scale: &Scale) {
        let mut closed: Vec<Point> = self.region.iter().map(|at| scale.map(*at)).collect();
        closed.extend(closed.first().copied());
        svg.clipped(scale.frame, |svg| {
            draw_region(svg, &closed);
            self.cloud.iter().for_each(|at| svg.circle(scale.map(*at), 1.8, &dot()));
        });
        clip(&closed, scale.frame).iter().for_each(|piece| draw_edge(svg, piece));
        let at = scale.map(self.at);
        svg.circle(at, 6.5, &Paint::fill(WHITE).opacity(0.9));
        Glyph::Diamond.draw(svg, at, 4.6, BLACK);
    }

    /// The name beside the place, where there is room.
    fn write(&self, svg: &mut Svg, scale: &Scale, taken: &mut Vec<Rect>) {
        let [x, y] = scale.map(self.at);
        let label = Label::parse(&self.name);
        let (w, h) = (label.width(NAME) + 6.0, NAME + 5.0);
        let place = beside([x, y], [w, h], 10.0, scale.frame, taken);
        svg.rect(place, &Paint::fill(WHITE).opacity(0.88));
        svg.text([place.x + 3.0, place.y + 0.5 * h + 0.36 * NAME], NAME, Anchor::Start, &label);
        taken.push(place);
    }
}
