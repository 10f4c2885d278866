//! The sheet that axes are drawn on.

use super::geometry::{Point, Rect};
use super::paint::Paint;
use super::svg::{Anchor, Svg};
use super::text::Label;

/// A sheet that takes lines and labels: an [`Svg`], or the background of a film. In pixels, y points down.
pub trait Sheet {
    /// An upright rectangle.
    fn rect(&mut self, rect: Rect, paint: &Paint);

    /// Several separate straight lines as one shape.
    fn lines(&mut self, lines: &[[Point; 2]], paint: &Paint);

    /// A label with its baseline at `at`; `size` in pixels.
    fn text(&mut self, at: Point, size: f64, anchor: Anchor, label: &Label);

    /// A label that reads upward, baseline at `at`.
    fn upward_text(&mut self, at: Point, size: f64, anchor: Anchor, label: &Label);
}

impl Sheet for Svg {
    fn rect(&mut self, rect: Rect, paint: &Paint) {
        Self::rect(self, rect, paint);
    }

    fn lines(&mut self, lines: &[[Point; 2]], paint: &Paint) {
        Self::lines(self, lines, paint);
    }

    fn text(&mut self, at: Point, size: f64, anchor: Anchor, label: &Label) {
        Self::text(self, at, size, anchor, label);
    }

    fn upward_text(&mut self, at: Point, size: f64, anchor: Anchor, label: &Label) {
        Self::upward_text(self, at, size, anchor, label);
    }
}
