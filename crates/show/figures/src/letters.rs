//! Outlines of letters along a line.

use tiny_skia::{Path, PathBuilder};
use ttf_parser::OutlineBuilder;

use super::fonts::{Face, advance};

/// The outlines of a line of text whose baseline begins at the origin; y points down.
pub(crate) struct Letters {
    builder: PathBuilder,
    /// The start of the next letter, and its baseline, in pixels.
    x: f32,
    y: f64,
    /// Pixels for a unit of the font.
    scale: f32,
}

impl Default for Letters {
    fn default() -> Self {
        Self { builder: PathBuilder::new(), x: 0.0, y: 0.0, scale: 1.0 }
    }
}

impl Letters {
    /// Moves the baseline down by pixels.
    pub(crate) fn lower(&mut self, pixels: f64) {
        self.y += pixels;
    }

    /// Adds letters of a size in pixels. The fonts have no kerning: each letter is as wide as it is alone.
    pub(crate) fn set(&mut self, face: Face, text: &str, size: f64) {
        let Some(font) = face.font() else { return };
        self.scale = (size / f64::from(font.units_per_em())) as f32;
        for character in text.chars() {
            if let Some(glyph) = font.glyph_index(character) {
                font.outline_glyph(glyph, self); // one without an outline, such as the space, leaves a blank of its width
            }
            self.x += (size * advance(face, character)) as f32;
        }
    }

    /// The width so far, in pixels.
    #[cfg(feature = "raster")]
    pub(crate) fn width(&self) -> f32 {
        self.x
    }

    /// All outlines as one path; `None` if there is none.
    pub(crate) fn finish(self) -> Option<Path> {
        self.builder.finish()
    }

    /// A point of a glyph, whose y points up.
    fn place(&self, x: f32, y: f32) -> (f32, f32) {
        (self.x + self.scale * x, self.y as f32 - self.scale * y)
    }
}

impl OutlineBuilder for Letters {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.builder.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.builder.line_to(x, y);
    }

    fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
        let ((cx, cy), (x, y)) = (self.place(cx, cy), self.place(x, y));
        self.builder.quad_to(cx, cy, x, y);
    }

    fn curve_to(&mut self, ax: f32, ay: f32, bx: f32, by: f32, x: f32, y: f32) {
        let ((ax, ay), (bx, by), (x, y)) = (self.place(ax, ay), self.place(bx, by), self.place(x, y));
        self.builder.cubic_to(ax, ay, bx, by, x, y);
    }

    fn close(&mut self) {
        self.builder.close();
    }
}
