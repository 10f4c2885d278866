//! A chart: layers of marks on one pair of axes.

use super::axes::{AxisKind, Scale};
use super::error::{FigureError, Result};
use super::figure::{Csv, figure};
use super::framed::Framed;
use super::geometry::Rect;
use super::layer::{Layer, Marks, Rank};
use super::paint::Paint;
use super::palette::GREY;
use super::plane::Plane;
use super::room::Room;
use super::svg::Svg;

/// Layers on axes of any kind: curves with bands, steps, points with error bars, lines.
///
/// The axes show the data of all layers but lines of theory; what reaches beyond is cut off. Layers are drawn in their order, bands beneath
/// all of them; each measured layer has its own colour (and marker). Legend and table begin with the measured layers. On a logarithmic axis
/// what is not above 0 has no place: a curve is interrupted there, points are left out and counted in the caption, and a band or bar that
/// reaches down to 0 ends at the frame.
///
/// # Units   those of the labels; texts are markup (see [`super::Label`])
///
/// ```
/// use motiform_figures::{Chart, ErrorBarSeries, ExpectedLine, LineStyle, Measured};
///
/// let points = [0.5, 1.0, 2.0].map(|x: f64| Measured { x, y: x * x, error: 0.1 }).to_vec();
/// let measured = ErrorBarSeries { label: "runs".into(), points, joined: false };
/// let theory = ExpectedLine { label: "slope 2".into(), style: LineStyle::Dashed, points: vec![[0.1, 0.01], [10.0, 100.0]] };
/// let labels = Chart { x_label: "*x*".into(), y_label: "*y*".into(), ..Chart::default() };
/// let chart = Chart { logarithmic_x: true, logarithmic_y: true, ..labels };
/// assert!(chart.with([theory]).with([measured]).svg()?.starts_with("<svg"));
/// # Ok::<(), motiform_figures::FigureError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Chart {
    /// Line above the legend.
    pub title: String,
    /// Paragraphs below the axes, in particular the meaning of bands and bars.
    pub caption: Vec<String>,
    /// Label of the x axis.
    pub x_label: String,
    /// Label of the y axis.
    pub y_label: String,
    /// `true` if the value 0 is in sight and has a line (of no account on a logarithmic axis).
    pub zero_line: bool,
    /// `true` if the x axis is logarithmic.
    pub logarithmic_x: bool,
    /// `true` if the y axis is logarithmic.
    pub logarithmic_y: bool,
    /// The data, drawn in this order.
    pub layers: Vec<Layer>,
}

impl Chart {
    /// The chart with more layers on top.
    #[must_use]
    pub fn with<L: Into<Layer>>(mut self, layers: impl IntoIterator<Item = L>) -> Self {
        self.layers.extend(layers.into_iter().map(Into::into));
        self
    }

    /// `true` if it shows no data: lines of theory alone are no figure.
    pub fn is_empty(&self) -> bool {
        self.layers.iter().all(|layer| layer.marks().rank() == Rank::Theory)
    }

    /// Draws the figure for a width.
    ///
    /// # Errors   nothing that has a place on the axes, a number that is not finite, or what a layer refuses
    pub fn svg_in(&self, room: Room) -> Result<Svg> {
        self.layers.iter().try_for_each(|layer| layer.marks().check())?;
        let kinds = self.kinds();
        let sheet = Framed {
            title: &self.title,
            caption: &self.caption_in(kinds),
            legend: self.sorted().flat_map(|(marks, number)| marks.keys(number)).collect(),
            scale: self.scale(kinds)?,
            kinds,
            columns: [None; 2],
            labels: [&self.x_label, &self.y_label],
            room,
            grid: true,
            head: 0.0,
        };
        sheet.svg(|svg, scale| {
            self.draw(svg, &Plane { scale: *scale, kinds });
            Ok(())
        })
    }

    fn draw(&self, svg: &mut Svg, plane: &Plane) {
        if self.zero().is_some() {
            let [left, right] = [plane.scale.x.min, plane.scale.x.max].map(|x| plane.scale.map([x, 0.0]));
            svg.line(left, right, &Paint::stroke(GREY, 1.2));
        }
        self.numbered().for_each(|(marks, number)| marks.draw_ground(svg, plane, number));
        self.numbered().for_each(|(marks, number)| marks.draw(svg, plane, number));
    }

    /// The layers, and how many measured ones lie below each.
    fn numbered(&self) -> impl Iterator<Item = (&dyn Marks, usize)> {
        self.layers.iter().map(Layer::marks).scan(0, |next, marks| {
            let number = *next;
            *next += usize::from(marks.rank() == Rank::Measured);
            Some((marks, number))
        })
    }

    /// The layers by their rank.
    fn sorted(&self) -> impl Iterator<Item = (&dyn Marks, usize)> {
        let ranks = [Rank::Measured, Rank::Interval, Rank::Theory].into_iter();
        ranks.flat_map(|rank| self.numbered().filter(move |(marks, _)| marks.rank() == rank))
    }

    fn kinds(&self) -> [AxisKind; 2] {
        [self.logarithmic_x, self.logarithmic_y].map(AxisKind::of)
    }

    fn zero(&self) -> Option<f64> {
        (self.zero_line && !self.logarithmic_y).then_some(0.0)
    }

    fn scale(&self, kinds: [AxisKind; 2]) -> Result<Scale> {
        let (mut extent, mut room) = ([Vec::new(), self.zero().into_iter().collect()], [0.0f64; 2]);
        for marks in self.layers.iter().map(Layer::marks) {
            let own = marks.extent(kinds);
            extent.iter_mut().zip(own).for_each(|(all, own)| all.extend(own));
            room = [0, 1].map(|side| room[side].max(marks.room()[side]));
        }
        let [xs, ys] = extent;
        let (Some(x), Some(y)) = (kinds[0].range(xs, room[0]), kinds[1].range(ys, room[1])) else {
            return Err(FigureError::Empty { what: "list of values (on a logarithmic axis: above 0)" });
        };
        let [w, h] = self.sorted().next().map_or([0.0; 2], |(marks, _)| marks.frame());
        Ok(Scale { frame: Rect { x: 0.0, y: 0.0, w, h }, x, y })
    }

    fn caption_in(&self, kinds: [AxisKind; 2]) -> Vec<String> {
        let left_out: usize = self.layers.iter().map(|layer| layer.marks().left_out(kinds)).sum();
        let note = format!("Not drawn, since not above 0: {left_out} of the values.");
        self.caption.iter().cloned().chain((left_out > 0).then_some(note)).collect()
    }

    /// The tables of all layers one below the other. What names a mark is in the first columns of all.
    fn csv(&self) -> String {
        let axes = [self.x_label.as_str(), self.y_label.as_str()];
        let layers: Vec<&dyn Marks> = self.sorted().map(|(marks, _)| marks).collect();
        if let Some(table) = layers.first().and_then(|first| first.table(axes)) {
            return table.finish();
        }
        let [before, after] = columns(&layers);
        let mut csv = Csv::new(before.iter().chain(&axes).chain(&after));
        for (marks, row) in
            layers.iter().flat_map(|marks| marks.rows().into_iter().map(move |row| (marks, row)))
        {
            let own = marks.columns()[1];
            let number = |name: &&str| row.numbers.get(own.iter().position(|own| own == name)?).copied();
            let texts = row.texts.iter().map(String::as_str).chain(std::iter::repeat(""));
            let texts: Vec<&str> = texts.take(before.len()).collect();
            csv.row(&texts, row.at.into_iter().chain(after.iter().map(number)));
        }
        csv.finish()
    }
}

/// The columns of a table with the rows of all layers: the first of those with most texts, and all kinds of numbers.
fn columns(layers: &[&dyn Marks]) -> [Vec<&'static str>; 2] {
    let (mut before, mut after) = (Vec::new(), Vec::new());
    for [texts, numbers] in layers.iter().map(|marks| marks.columns()) {
        if texts.len() > before.len() {
            before = texts.to_vec();
        }
        after.extend(numbers.iter().copied().filter(|name| !after.contains(name)).collect::<Vec<_>>());
    }
    [before, after]
}

figure!(Chart);

#[cfg(test)]
mod tests {
    use super::super::{BandCurve, BandPoint, ErrorBarSeries, Measured};
    use super::*;

    fn figure() -> Chart {
        let point = |k: u32| {
            let x = f64::from(k);
            BandPoint { x, y: x * x, low: x * x - 10.0, high: x * x + 10.0 }
        };
        let curve = BandCurve { label: "curve".into(), points: (0..9).map(point).collect() };
        Chart { x_label: "x".into(), y_label: "y".into(), ..Chart::default() }.with([curve])
    }

    #[test]
    fn bands_that_leave_the_frame_are_cut_off() {
        for (logarithmic_x, logarithmic_y) in [(false, false), (false, true), (true, true)] {
            let svg = Chart { logarithmic_x, logarithmic_y, ..figure() }.svg().expect("a figure");
            assert!(!svg.contains("NaN") && !svg.contains("inf"));
        }
        assert_eq!(figure().csv().lines().count(), 10);
    }

    #[test]
    fn the_table_has_the_columns_of_all_layers() {
        let series = ErrorBarSeries {
            label: "runs".into(),
            points: vec![Measured { x: 0.0, y: 1.0, error: 0.5 }],
            joined: false,
        };
        let table = figure().with([series]).csv();
        let lines: Vec<&str> = table.lines().collect();
        assert_eq!(lines[0], "curve,x,y,low,high,error");
        assert_eq!([lines[1], lines[10]], ["curve,0.0,0.0,-10.0,10.0,", "runs,0.0,1.0,,,0.5"]);
    }

    #[test]
    fn nothing_to_draw_is_an_error() {
        assert!(Chart::default().svg().is_err());
        let point = BandPoint { x: 1.0, y: 1.0, low: 1.0, high: f64::INFINITY };
        let broken = BandCurve { label: "curve".into(), points: vec![point] };
        assert!(figure().with([broken]).svg().is_err());
    }
}
