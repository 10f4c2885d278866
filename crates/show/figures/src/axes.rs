//! A framed plot: data to pixels, ticks, labels.

use super::geometry::{Point, Range, Rect};
use super::paint::Paint;
use super::palette::{INK, PALE};
use super::sheet::Sheet;
use super::svg::Anchor;
use super::text::Label;
use super::ticks::Ticks;

/// Font size of tick labels, in pixels.
pub(crate) const TICK_SIZE: f64 = 12.0;
/// Font size of axis labels, in pixels.
pub(crate) const LABEL_SIZE: f64 = 13.0;
const TICK_LENGTH: f64 = 5.0;
const MINOR_LENGTH: f64 = 3.0;
/// Least distance of ticks, in pixels; one for both axes, so that equal axes get equal steps.
const SPACING: f64 = 60.0;
const LINE: f64 = LABEL_SIZE * 1.25;

/// Room for tick labels and axis label below the frame, in pixels.
pub(crate) const BELOW: f64 = TICK_LENGTH + TICK_SIZE + LINE + 12.0;

/// Maps data to the pixels of a frame.
#[derive(Debug, Clone, Copy)]
pub struct Scale {
    /// The frame, in pixels.
    pub frame: Rect,
    /// Data range across.
    pub x: Range,
    /// Data range upwards.
    pub y: Range,
}

impl Scale {
    /// Pixel position of a data point.
    pub fn map(&self, [x, y]: Point) -> Point {
        [
            self.frame.x + (x - self.x.min) / self.x.span() * self.frame.w,
            self.frame.bottom() - (y - self.y.min) / self.y.span() * self.frame.h,
        ]
    }

    /// A scale with one unit for both axes that shows at least `x` and `y`: the shorter axis is widened.
    pub fn equal(frame: Rect, x: Range, y: Range) -> Self {
        let unit = (x.span() / frame.w).max(y.span() / frame.h);
        Self { frame, x: x.with_span(unit * frame.w), y: y.with_span(unit * frame.h) }
    }
}

/// The division of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisKind {
    /// Equal differences are equally far apart.
    Linear,
    /// Equal ratios are equally far apart.
    Logarithmic,
}

impl AxisKind {
    /// Logarithmic or not.
    pub fn of(logarithmic: bool) -> Self {
        if logarithmic { Self::Logarithmic } else { Self::Linear }
    }

    /// The place of a value along the axis; `None` if it has none.
    pub fn place(self, value: f64) -> Option<f64> {
        match self {
            Self::Linear => Some(value),
            Self::Logarithmic => (value > 0.0).then(|| libm::log10(value)),
        }
    }

    /// The range of an axis that shows all places, with some room at its ends; `None` without places.
    pub fn range(self, places: impl IntoIterator<Item = f64>, room: f64) -> Option<Range> {
        let range = Range::of(places)?;
        Some(match self {
            Self::Linear => range.padded(room),
            Self::Logarithmic => range.with_span((range.span() * (1.0 + 2.0 * room)).max(1.0)),
        })
    }
}

/// The axes of a plot: what [`Scale`] maps, with ticks and labels.
#[derive(Debug, Clone)]
pub struct Axes {
    /// Data to pixels.
    pub scale: Scale,
    x_ticks: Ticks,
    y_ticks: Ticks,
    x_label: Option<Label>,
    y_label: Vec<Label>,
}

impl Axes {
    /// Chooses the ticks. Without `x_label` the x axis has ticks but no text (panels that share an axis).
    ///
    /// The y label is wrapped to the height of the frame.
    pub fn new(scale: Scale, x_label: Option<&str>, y_label: &str) -> Self {
        let width = |text: &str| Label::parse(text).width(TICK_SIZE);
        let Rect { w, h, .. } = scale.frame;
        let mut x_ticks = Ticks::fitting(scale.x, w, SPACING, width);
        let mut y_ticks = Ticks::fitting(scale.y, h, SPACING, |_| TICK_SIZE);
        if (scale.x.span() * h / (scale.y.span() * w) - 1.0).abs() < 1e-6 {
            Ticks::share_step((&mut x_ticks, scale.x), (&mut y_ticks, scale.y));
        }
        let x_label = x_label.map(|label| Label::parse(&x_ticks.scaled_label(label)));
        let y_label = Label::parse(&y_ticks.scaled_label(y_label)).wrap_words(LABEL_SIZE, h + 10.0);
        Self { scale, x_ticks, y_ticks, x_label, y_label }
    }

    /// Axes across and upwards of a kind each; along a logarithmic one the scale is in log10 of its quantity.
    pub fn of_kinds(scale: Scale, kinds: [AxisKind; 2], x_label: &str, y_label: &str) -> Self {
        let width = |text: &str| Label::parse(text).width(TICK_SIZE);
        let mut axes = Self::new(scale, Some(x_label), y_label);
        let Rect { w, h, .. } = scale.frame;
        if kinds[0] == AxisKind::Logarithmic {
            axes.x_ticks = Ticks::decades(scale.x, w, width);
            axes.x_label = Some(Label::parse(x_label));
        }
        if kinds[1] == AxisKind::Logarithmic {
            axes.y_ticks = Ticks::decades(scale.y, h, |_| TICK_SIZE);
            axes.y_label = Label::parse(y_label).wrap_words(LABEL_SIZE, h + 10.0);
        }
        axes
    }

    /// The same axes with ticks at the numbers of listed values, where there are some, labelled by the values.
    #[must_use]
    pub(crate) fn over(mut self, columns: [Option<&[f64]>; 2], labels: [&str; 2]) -> Self {
        let Rect { w, h, .. } = self.scale.frame;
        if let Some(values) = columns[0] {
            let width = |text: &str| Label::parse(text).width(TICK_SIZE);
            self.x_ticks = Ticks::listed(values, w / self.scale.x.span(), width);
            self.x_label = Some(Label::parse(labels[0]));
        }
        if let Some(values) = columns[1] {
            self.y_ticks = Ticks::listed(values, h / self.scale.y.span(), |_| TICK_SIZE);
            self.y_label = Label::parse(labels[1]).wrap_words(LABEL_SIZE, h + 10.0);
        }
        self
    }

    /// Pixels that the y axis needs to the left of its frame.
    pub fn left_margin(&self) -> f64 {
        self.tick_label_width() + TICK_LENGTH + 12.0 + LINE * self.y_label.len() as f64
    }

    /// Length of the longest line of the y label, along the axis: a lower frame leaves it no room.
    pub(crate) fn label_length(&self) -> f64 {
        self.y_label.iter().map(|line| line.width(LABEL_SIZE)).fold(0.0, f64::max)
    }

    /// The same axes with the frame moved to a left edge.
    #[must_use]
    pub fn moved_to(mut self, x: f64) -> Self {
        self.scale.frame.x = x;
        self
    }

    fn tick_label_width(&self) -> f64 {
        let widths = self.y_ticks.labels.iter().map(|l| Label::parse(l).width(TICK_SIZE));
        widths.fold(0.0, f64::max)
    }

    /// Draws grid lines, to be called before the data.
    pub fn draw_grid(&self, sheet: &mut impl Sheet) {
        let Rect { x, y, .. } = self.scale.frame;
        let (right, bottom) = (self.scale.frame.right(), self.scale.frame.bottom());
        let mut lines: Vec<_> = self.x_positions().map(|px| [[px, y], [px, bottom]]).collect();
        lines.extend(self.y_positions().map(|py| [[x, py], [right, py]]));
        sheet.lines(&lines, &Paint::stroke(PALE, 1.0));
    }

    /// Draws frame, ticks and labels, to be called after the data.
    pub fn draw(&self, sheet: &mut impl Sheet) {
        self.draw_with_margin(sheet, self.left_margin());
    }

    /// [`Axes::draw`] with the y label at the left end of a given margin, so that stacked panels line up.
    pub fn draw_with_margin(&self, sheet: &mut impl Sheet, margin: f64) {
        let Rect { x, y, w, h } = self.scale.frame;
        self.draw_ticks(sheet);
        sheet.rect(self.scale.frame, &Paint::stroke(INK, 1.0));
        if let Some(label) = &self.x_label {
            sheet.text([x + 0.5 * w, y + h + BELOW - 8.0], LABEL_SIZE, Anchor::Middle, label);
        }
        for (i, line) in self.y_label.iter().enumerate() {
            let at = [x - margin + LINE * (i as f64 + 0.8), y + 0.5 * h];
            sheet.upward_text(at, LABEL_SIZE, Anchor::Middle, line);
        }
    }

    fn draw_ticks(&self, sheet: &mut impl Sheet) {
        let Rect { x, .. } = self.scale.frame;
        let bottom = self.scale.frame.bottom();
        let mut lines = Vec::new();
        lines.extend(self.x_minor().map(|px| [[px, bottom], [px, bottom + MINOR_LENGTH]]));
        lines.extend(self.y_minor().map(|py| [[x - MINOR_LENGTH, py], [x, py]]));
        for (px, label) in self.x_positions().zip(&self.x_ticks.labels) {
            lines.push([[px, bottom], [px, bottom + TICK_LENGTH]]);
            if self.x_label.is_some() && !label.is_empty() {
                let at = [px, bottom + TICK_LENGTH + TICK_SIZE + 2.0];
                sheet.text(at, TICK_SIZE, Anchor::Middle, &Label::parse(label));
            }
        }
        for (py, label) in self.y_positions().zip(&self.y_ticks.labels) {
            lines.push([[x - TICK_LENGTH, py], [x, py]]);
            if !label.is_empty() {
                let at = [x - TICK_LENGTH - 4.0, py + 0.36 * TICK_SIZE];
                sheet.text(at, TICK_SIZE, Anchor::End, &Label::parse(label));
            }
        }
        sheet.lines(&lines, &Paint::stroke(INK, 1.0));
    }

    fn x_positions(&self) -> impl Iterator<Item = f64> {
        across(self.scale, &self.x_ticks.values)
    }

    fn x_minor(&self) -> impl Iterator<Item = f64> {
        across(self.scale, &self.x_ticks.minor)
    }

    fn y_positions(&self) -> impl Iterator<Item = f64> {
        upwards(self.scale, &self.y_ticks.values)
    }

    fn y_minor(&self) -> impl Iterator<Item = f64> {
        upwards(self.scale, &self.y_ticks.minor)
    }
}

fn across(scale: Scale, values: &[f64]) -> impl Iterator<Item = f64> {
    values.iter().map(move |x| scale.map([*x, scale.y.min])[0])
}

fn upwards(scale: Scale, values: &[f64]) -> impl Iterator<Item = f64> {
    values.iter().map(move |y| scale.map([scale.x.min, *y])[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_axes_map_a_circle_to_a_circle() {
        let frame = Rect { x: 50.0, y: 20.0, w: 600.0, h: 250.0 };
        let scale = Scale::equal(frame, Range { min: -3.0, max: 1.0 }, Range { min: 0.0, max: 7.0 });
        let centre = scale.map([-1.0, 3.5]);
        assert_eq!(centre, [350.0, 145.0]);
        for i in 0..12 {
            let (s, c) = f64::from(i).sin_cos();
            let p = scale.map([-1.0 + 2.0 * c, 3.5 + 2.0 * s]);
            let radius = (p[0] - centre[0]).hypot(p[1] - centre[1]);
            assert!((radius - 2.0 * 250.0 / 7.0).abs() < 1e-9);
        }
        assert!(scale.map([0.0, 7.0])[1] < centre[1], "y points up");
    }
}
