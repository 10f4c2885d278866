//! Wrapped lines of text: titles, notes, captions.

use super::geometry::Point;
use super::svg::{Anchor, Svg};
use super::text::Label;

/// Font size of a title, in pixels.
const TITLE: f64 = 15.0;
/// Font size of a caption, in pixels.
const CAPTION: f64 = 12.0;
/// Distance of baselines, in font sizes.
const LEADING: f64 = 1.4;

/// Text broken to a width.
#[derive(Debug, Clone)]
pub(crate) struct Block {
    lines: Vec<Label>,
    size: f64,
}

impl Block {
    /// A title of at most `width` pixels.
    pub(crate) fn title(text: &str, width: f64) -> Self {
        Self { lines: Label::parse(text).wrap(TITLE, width), size: TITLE }
    }

    /// Paragraphs of a caption, each starting on a new line.
    pub(crate) fn caption<'a>(paragraphs: impl IntoIterator<Item = &'a String>, width: f64) -> Self {
        let wrap = |p: &String| Label::parse(p).wrap(CAPTION, width);
        Self { lines: paragraphs.into_iter().flat_map(wrap).collect(), size: CAPTION }
    }

    /// Height in pixels, with some room below; 0 without text.
    pub(crate) fn height(&self) -> f64 {
        if self.lines.is_empty() { 0.0 } else { self.size * (LEADING * self.lines.len() as f64 + 0.4) }
    }

    /// Draws with the top left corner at `at`.
    pub(crate) fn draw(&self, svg: &mut Svg, at: Point) {
        for (i, line) in self.lines.iter().enumerate() {
            let baseline = at[1] + self.size * (1.05 + LEADING * i as f64);
            svg.text([at[0], baseline], self.size, Anchor::Start, line);
        }
    }
}
