//! Drawings as pixels.

use motiform_figures::palette::Colour;
use motiform_figures::png;
use std::io::Cursor;

pub(crate) struct Picture {
    pub(crate) width: usize,
    /// Red, green and blue, row after row from the top.
    pub(crate) pixels: Vec<Colour>,
}

impl Picture {
    /// A pixel for each unit of the drawing.
    pub(crate) fn of(svg: &str) -> Self {
        let bytes = png(svg, 1.0, &[]).expect("a picture");
        let mut reader = ::png::Decoder::new(Cursor::new(bytes)).read_info().expect("a header");
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
        let frame = reader.next_frame(&mut bytes).expect("an image");
        let pixels = bytes[..frame.buffer_size()].chunks_exact(3).map(|c| Colour(c[0], c[1], c[2])).collect();
        Self { width: frame.width as usize, pixels }
    }

    /// Columns and rows of the pixels of a colour.
    pub(crate) fn places(&self, colour: Colour) -> Vec<(usize, usize)> {
        let hits = self.pixels.iter().enumerate().filter(|(_, pixel)| **pixel == colour);
        hits.map(|(i, _)| (i % self.width, i / self.width)).collect()
    }
}
