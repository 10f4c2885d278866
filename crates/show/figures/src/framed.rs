//! The sheet around a frame: title, legend, axes, caption.

use super::axes::{Axes, AxisKind, BELOW, Scale};
use super::block::Block;
use super::geometry::Rect;
use super::legend::{Entry, Legend};
use super::room::Room;
use super::svg::Svg;

const MARGIN: f64 = 14.0;

/// The elements around the data of a figure with one frame. The position of the frame is chosen here, and its
/// size where the room has a width.
#[derive(Debug)]
pub(super) struct Framed<'a> {
    /// Line above the legend.
    pub(super) title: &'a str,
    /// Paragraphs below the axes.
    pub(super) caption: &'a [String],
    /// Marks and words, above the frame.
    pub(super) legend: Vec<Entry>,
    /// The data ranges, and the own size of the frame.
    pub(super) scale: Scale,
    /// The divisions of the axes, across and upwards.
    pub(super) kinds: [AxisKind; 2],
    /// The values of axes whose places are their numbers, across and upwards.
    pub(super) columns: [Option<&'a [f64]>; 2],
    /// Labels of the axes, across and upwards.
    pub(super) labels: [&'a str; 2],
    /// The room in which the sheet is laid out.
    pub(super) room: Room,
    /// `true` if grid lines lie behind the data.
    pub(super) grid: bool,
    /// Room right above the frame, in pixels.
    pub(super) head: f64,
}

/// A sheet whose data are to be drawn.
struct Begun {
    svg: Svg,
    axes: Axes,
    caption: Block,
    foot: f64,
}

impl Begun {
    fn finish(mut self) -> Svg {
        self.axes.draw(&mut self.svg);
        self.caption.draw(&mut self.svg, [MARGIN, self.foot]);
        self.svg
    }
}

impl Framed<'_> {
    /// Draws the sheet; `data` draws between grid and axes.
    pub(super) fn svg<E>(self, data: impl FnOnce(&mut Svg, &Scale) -> Result<(), E>) -> Result<Svg, E> {
        let mut begun = self.begin();
        data(&mut begun.svg, &begun.axes.scale)?;
        Ok(begun.finish())
    }

    /// The scale of the frame as it will be, its upper left corner at the origin, and the width that the legend has.
    pub(super) fn layout(&self) -> (Scale, f64) {
        let axes = self.axes();
        let Rect { w, .. } = axes.scale.frame;
        let width = self.room.width().map_or(w, |_| left_of(&axes) - MARGIN + w + RIGHT);
        (axes.scale, width)
    }

    /// The sheet up to its data: what is the same code for all figures.
    fn begin(self) -> Begun {
        let axes = self.axes();
        let left = left_of(&axes);
        let mut axes = axes.moved_to(left);
        let width = axes.scale.frame.w;
        let inner = left - MARGIN + width + RIGHT;
        let (title, caption) = (Block::title(self.title, inner), Block::caption(self.caption, inner));
        // a narrow sheet has no room to spare above the numbers of the y axis
        let (key_left, key_width) = self.room.width().map_or((left, width), |_| (MARGIN, inner));
        let legend = match self.room.width() {
            Some(_) => Legend::narrow(self.legend, key_width),
            None => Legend::flowed(self.legend, key_width),
        };
        let key = MARGIN + title.height() + 4.0;
        axes.scale.frame.y = (key + legend.height() + 4.0 + self.head).ceil();
        let foot = axes.scale.frame.bottom() + BELOW + 8.0;
        let sheet = [
            inner.max(key_left - MARGIN + legend.width()) + 2.0 * MARGIN,
            foot + caption.height() + MARGIN - 6.0,
        ];
        let mut svg = Svg::in_room(self.room, sheet[0].ceil(), sheet[1].ceil());
        svg.frame(axes.scale.frame);
        title.draw(&mut svg, [MARGIN, MARGIN]);
        legend.draw(&mut svg, [key_left, key]);
        if self.grid {
            axes.draw_grid(&mut svg);
        }
        Begun { svg, axes, caption, foot }
    }

    /// The axes, with the frame that the room leaves beside their labels.
    fn axes(&self) -> Axes {
        let Rect { w, h, .. } = self.scale.frame;
        let with = |[w, h]: [f64; 2]| {
            let scale = Scale { frame: Rect { x: 0.0, y: 0.0, w, h }, ..self.scale };
            Axes::of_kinds(scale, self.kinds, self.labels[0], self.labels[1]).over(self.columns, self.labels)
        };
        let own = with([w, h]);
        if self.room.width().is_none() {
            return own;
        }
        // another height may have other ticks, and labels of another width
        let fitting = |axes: &Axes| self.room.frame([w, h], left_of(axes) + RIGHT + MARGIN);
        let first = with(fitting(&own));
        with(fitting(&first))
    }
}

/// Room at the right of the frame, for half of a tick label.
const RIGHT: f64 = 16.0;

/// The left edge of the frame: whole pixels, so that edges of cells are sharp.
fn left_of(axes: &Axes) -> f64 {
    (MARGIN + axes.left_margin()).ceil()
}
