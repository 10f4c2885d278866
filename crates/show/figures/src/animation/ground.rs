//! The background of the moving body: axes, or a frame with a scale bar.

use tiny_skia::{Color, Pixmap, Transform};

use super::brush::{stroke, write_turned};
use crate::error::{FigureError, Result};
use crate::geometry::{Point, Rect};
use crate::paint::Paint;
use crate::sheet::Sheet;
use crate::svg::Anchor;
use crate::text::Label;

/// A white sheet of pixels. Shapes have their line alone: no filling, no dashes.
pub(super) struct Ground(Pixmap);

impl Ground {
    /// An empty sheet; sizes in pixels, rounded up.
    pub(super) fn new(width: f64, height: f64) -> Result<Self> {
        let [w, h] = [width, height].map(|side| side.ceil() as u32);
        let mut pixmap = Pixmap::new(w, h).ok_or(FigureError::OutOfRange {
            what: "number of pixels",
            value: width * height,
            min: 1.0,
            max: f64::from(u32::MAX),
        })?;
        pixmap.fill(Color::WHITE);
        Ok(Self(pixmap))
    }

    pub(super) fn finish(self) -> Pixmap {
        self.0
    }

    fn write(&mut self, at: Point, degrees: f32, size: f64, anchor: Anchor, label: &Label) {
        let before = match anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => 0.5,
            Anchor::End => 1.0,
        };
        let [x, y] = at.map(|place| place as f32);
        let turned = Transform::from_translate(x, y).pre_rotate(degrees);
        let place = turned.pre_translate(-(before * label.width(size)) as f32, 0.0);
        write_turned(&mut self.0, label, place, size);
    }
}

impl Sheet for Ground {
    fn rect(&mut self, rect: Rect, paint: &Paint) {
        let Rect { x, y, .. } = rect;
        let corners = [[x, y], [rect.right(), y], [rect.right(), rect.bottom()], [x, rect.bottom()]];
        if let Some((colour, width)) = paint.line() {
            stroke(&mut self.0, &corners, true, colour, width as f32);
        }
    }

    fn lines(&mut self, lines: &[[Point; 2]], paint: &Paint) {
        for line in lines {
            if let Some((colour, width)) = paint.line() {
                stroke(&mut self.0, line, false, colour, width as f32);
            }
        }
    }

    fn text(&mut self, at: Point, size: f64, anchor: Anchor, label: &Label) {
        self.write(at, 0.0, size, anchor, label);
    }

    fn upward_text(&mut self, at: Point, size: f64, anchor: Anchor, label: &Label) {
        self.write(at, -90.0, size, anchor, label);
    }
}
