//! The sheet around a frame: title, legend, axes, caption.

use super::axes::{Axes, BELOW, Scale};
use super::block::Block;
use super::legend::{Entry, Legend};
use super::svg::Svg;

const MARGIN: f64 = 14.0;

/// The elements around the data of a figure with one frame. The position of the frame is chosen here, its size is that of `axes`.
#[derive(Debug)]
pub(super) struct Framed<'a> {
    /// Line above the legend.
    pub(super) title: &'a str,
    /// Paragraphs below the axes.
    pub(super) caption: &'a [String],
    /// Marks and words, above the frame.
    pub(super) legend: Vec<Entry>,
    /// Axes at any place.
    pub(super) axes: Axes,
    /// Whether grid lines lie behind the data.
    pub(super) grid: bool,
    /// Room right above the frame, in pixels.
    pub(super) head: f64,
}

impl Framed<'_> {
    /// Draws the sheet; `data` draws between grid and axes.
    pub(super) fn svg<E>(self, data: impl FnOnce(&mut Svg, &Scale) -> Result<(), E>) -> Result<String, E> {
        // whole pixels: no blurred edges of cells
        let left = (MARGIN + self.axes.left_margin()).ceil();
        let mut axes = self.axes.moved_to(left);
        let width = axes.scale.frame.w;
        let inner = left - MARGIN + width + 16.0;
        let (title, caption) = (Block::title(self.title, inner), Block::caption(self.caption, inner));
        let legend = Legend::flowed(self.legend, width);
        let key = MARGIN + title.height() + 4.0;
        axes.scale.frame.y = (key + legend.height() + 4.0 + self.head).ceil();
        let foot = axes.scale.frame.bottom() + BELOW + 8.0;
        let sheet = [
            inner.max(left - MARGIN + legend.width()) + 2.0 * MARGIN,
            foot + caption.height() + MARGIN - 6.0,
        ];
        let mut svg = Svg::new(sheet[0].ceil(), sheet[1].ceil());
        title.draw(&mut svg, [MARGIN, MARGIN]);
        legend.draw(&mut svg, [left, key]);
        if self.grid {
            axes.draw_grid(&mut svg);
        }
        data(&mut svg, &axes.scale)?;
        axes.draw(&mut svg);
        caption.draw(&mut svg, [MARGIN, foot]);
        Ok(svg.finish())
    }
}
