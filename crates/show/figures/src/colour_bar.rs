//! The bar that tells which colour is which value.

use super::axes::{LABEL_SIZE, TICK_SIZE};
use super::geometry::{Point, Range, Rect};
use super::paint::Paint;
use super::palette::{Colour, INK};
use super::svg::{Anchor, Svg};
use super::text::Label;
use super::ticks::Ticks;

const BAR: f64 = 12.0;
const HEAD: f64 = 22.0;
const STEPS: u32 = 48;

/// A vertical bar of colours with ticks at its right.
#[derive(Debug, Clone)]
pub(crate) struct ColourBar {
    range: Range,
    colour: fn(f64) -> Colour,
    ticks: Ticks,
    label: Label,
    height: f64,
}

impl ColourBar {
    /// A bar of a total height in pixels, its label included; `colour` takes 0 at its lower end, 1 at its upper one.
    pub(crate) fn new(range: Range, colour: fn(f64) -> Colour, label: &str, height: f64) -> Self {
        let ticks = Ticks::fitting(range, height - HEAD, 40.0, |_| TICK_SIZE);
        let label = Label::parse(&ticks.scaled_label(label));
        Self { range, colour, ticks, label, height }
    }

    /// Width in pixels.
    pub(crate) fn width(&self) -> f64 {
        let labels = self.ticks.labels.iter().map(|l| Label::parse(l).width(TICK_SIZE));
        (BAR + 8.0 + labels.fold(0.0, f64::max)).max(self.label.width(LABEL_SIZE))
    }

    /// Draws with the top left corner at `at`.
    pub(crate) fn draw(&self, svg: &mut Svg, [x, y]: Point) {
        svg.text([x, y + 11.0], LABEL_SIZE, Anchor::Start, &self.label);
        let bar = Rect { x, y: y + HEAD, w: BAR, h: self.height - HEAD };
        for i in 0..STEPS {
            // each step reaches to the top, under the next ones: no seams, and no gradient, which the PDF writer bends
            let h = bar.h * f64::from(STEPS - i) / f64::from(STEPS);
            let colour = (self.colour)((f64::from(i) + 0.5) / f64::from(STEPS));
            svg.rect(Rect { h, ..bar }, &Paint::fill(colour));
        }
        svg.rect(bar, &Paint::stroke(INK, 0.8));
        for (value, label) in self.ticks.values.iter().zip(&self.ticks.labels) {
            let py = bar.bottom() - (value - self.range.min) / self.range.span() * bar.h;
            svg.line([bar.right(), py], [bar.right() + 4.0, py], &Paint::stroke(INK, 1.0));
            let at = [bar.right() + 7.0, py + 0.36 * TICK_SIZE];
            svg.text(at, TICK_SIZE, Anchor::Start, &Label::parse(label));
        }
    }
}
