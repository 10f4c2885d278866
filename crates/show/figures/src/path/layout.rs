//! The layout of a path figure.

use super::PathFigure;
use crate::axes::{Axes, BELOW, Scale};
use crate::block::Block;
use crate::colour_bar::ColourBar;
use crate::geometry::{Range, Rect};
use crate::legend::Legend;
use crate::palette::time_colour;
use crate::room::Room;
use crate::svg::Svg;

/// Longest side of the frame, in pixels.
const WIDE: f64 = 600.0;
/// Longest upright side of the frame, in pixels.
const TALL: f64 = 540.0;
/// The frame is at most this many times longer than wide, or the other way round.
const ASPECT: f64 = 3.0;
/// Narrowest text, in pixels.
const TEXT: f64 = 420.0;
/// Margin around everything, in pixels.
const MARGIN: f64 = 14.0;

/// The finished plan of a sheet.
pub(super) struct Layout {
    width: f64,
    height: f64,
    /// Width of what stands beside the frame.
    around: f64,
    title: Block,
    caption: Block,
    axes: Axes,
    bar: Option<ColourBar>,
    legend: Legend,
    /// Legend in the column at the right of the axes, not below.
    beside: bool,
    /// Left edge of a legend below.
    key: f64,
}

/// Width and height of the frame for data of a width and height; it is as wide as it can be where the sheet has a width.
fn frame_size(x: Range, y: Range, wide: f64, room: Room) -> (f64, f64) {
    let aspect = (x.span() / y.span()).clamp(1.0 / ASPECT, ASPECT);
    // equal areas while neither side hits its limit
    let w = room.width().map_or(wide * aspect.sqrt() * 0.8, |_| wide).min(wide).min(TALL * aspect);
    (w, w / aspect)
}

impl Layout {
    /// Plans the sheet.
    pub(super) fn of(figure: &PathFigure, room: Room) -> Self {
        let own = Self::with(figure, WIDE, room);
        let Some(width) = room.width() else { return own };
        let fitting = |layout: &Self| room.frame([WIDE, TALL], layout.around.min(width))[0];
        // labels of a lower frame may need more lines
        let first = Self::with(figure, fitting(&own), room);
        Self::with(figure, fitting(&first), room)
    }

    /// Plans a sheet whose frame is at most `wide`.
    fn with(figure: &PathFigure, wide: f64, room: Room) -> Self {
        let range =
            |i: usize| Range::of(figure.places().map(|p| p[i])).unwrap_or(Range { min: 0.0, max: 0.0 });
        let (x, y) = with_equal_padding(range(0), range(1));
        let (w, h) = room.height().map_or_else(|| frame_size(x, y, wide, room), |height| (wide, height));
        let scale = Scale::equal(Rect { x: 0.0, y: 0.0, w, h }, x, y);
        let axes = Axes::new(scale, Some(&figure.x_label), &figure.y_label);
        let left = MARGIN + axes.left_margin();
        let bar = figure
            .time_range()
            .map(|range| ColourBar::new(range, time_colour, &figure.time_label, h.min(210.0)));
        let text = room.width().map_or(TEXT, |width| (width - 2.0 * MARGIN).min(TEXT));
        let beside = room.width().is_none() && w < TEXT;
        let key = room.width().map_or(w, |_| text.max(w));
        let mut legend = Legend::flowed(figure.legend(), if beside { 0.0 } else { key });
        if !beside && legend.width() > key {
            legend = Legend::flowed(figure.legend(), 0.0);
        }
        let bar_width = bar.as_ref().map_or(0.0, |bar| bar.width() + 16.0);
        let column = if beside { bar_width.max(legend.width() + 16.0) } else { bar_width };
        let around = left + column.max(12.0) + MARGIN;
        let inner = (around - 2.0 * MARGIN + w).max(text);
        let title = Block::title(&figure.title, inner);
        let caption = Block::caption(&figure.caption, inner);
        let width = inner + 2.0 * MARGIN;
        let key_left = room.width().map_or(left, |_| MARGIN);
        let mut layout =
            Self { width, height: 0.0, around, title, caption, axes, bar, legend, beside, key: key_left };
        let top = MARGIN + layout.title.height() + 4.0;
        layout.axes.scale.frame = Rect { x: left, y: top, w, h };
        layout.height = layout.caption_top() + layout.caption.height() + MARGIN - 6.0;
        layout
    }

    fn caption_top(&self) -> f64 {
        let frame = self.axes.scale.frame;
        let bar = self.bar.as_ref().map_or(0.0, |_| frame.h.min(210.0) + 14.0);
        if self.beside {
            (frame.bottom() + BELOW).max(frame.y + bar + self.legend.height()) + 8.0
        } else {
            frame.bottom() + BELOW + self.legend.height() + 10.0
        }
    }

    /// Draws the sheet.
    pub(super) fn draw(&self, figure: &PathFigure, room: Room) -> Svg {
        let mut svg = Svg::in_room(room, self.width.ceil(), self.height.ceil());
        let frame = self.axes.scale.frame;
        svg.frame(frame);
        self.title.draw(&mut svg, [MARGIN, MARGIN]);
        self.axes.draw_grid(&mut svg);
        svg.clipped(frame, |svg| figure.draw_data(svg, &self.axes.scale));
        self.axes.draw(&mut svg);
        let column = frame.right() + 16.0;
        let mut below_bar = frame.y;
        if let Some(bar) = &self.bar {
            bar.draw(&mut svg, [column, frame.y]);
            below_bar += frame.h.min(210.0) + 14.0;
        }
        let key = if self.beside { [column, below_bar] } else { [self.key, frame.bottom() + BELOW] };
        self.legend.draw(&mut svg, key);
        self.caption.draw(&mut svg, [MARGIN, self.caption_top()]);
        svg
    }
}

/// Widens both ranges by one length: the same margin on all sides, and no empty range.
fn with_equal_padding(x: Range, y: Range) -> (Range, Range) {
    if x.span() == 0.0 && y.span() == 0.0 {
        let span = x.padded(0.0).span().max(y.padded(0.0).span());
        return (x.with_span(span), y.with_span(span));
    }
    let longer = x.span().max(y.span());
    let size = [x.min, x.max, y.min, y.max].into_iter().fold(0.0f64, |m, v| m.max(v.abs()));
    let pad = (0.12 * longer).max(1e-9 * size).max(1e-100);
    (x.with_span(x.span() + pad), y.with_span(y.span() + pad))
}
