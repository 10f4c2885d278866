//! Writes pictures as an animated PNG, each as the rectangle of what changed.

use png::{BitDepth, BlendOp, ColorType, DeflateCompression, Encoder, Filter, Writer};
use tiny_skia::Pixmap;

use super::colours::{KEEP, Palette};
use crate::error::Result;

/// A film being written.
pub(super) struct Film<'a> {
    writer: Writer<&'a mut Vec<u8>>,
    palette: Palette,
    width: usize,
    /// The last picture as indices; empty before the first.
    shown: Vec<u8>,
    /// The last picture as it was painted.
    painted: Vec<u8>,
}

/// The smallest rectangle that holds some pixels; ends are exclusive.
#[derive(Debug, Clone, Copy)]
struct Patch {
    left: usize,
    right: usize,
    top: usize,
    bottom: usize,
}

impl Patch {
    /// Holds no pixel.
    const NONE: Self = Self { left: usize::MAX, right: 0, top: usize::MAX, bottom: 0 };

    /// Takes in a pixel.
    fn grow(&mut self, x: usize, y: usize) {
        (self.left, self.right) = (self.left.min(x), self.right.max(x + 1));
        (self.top, self.bottom) = (self.top.min(y), self.bottom.max(y + 1));
    }

    /// The rectangle, or the top left pixel if it is empty: a frame of a film cannot be.
    fn or_one(self) -> Self {
        if self.right == 0 { Self { left: 0, right: 1, top: 0, bottom: 1 } } else { self }
    }
}

impl<'a> Film<'a> {
    /// Starts a film of a number of frames that repeats without end.
    pub(super) fn new(out: &'a mut Vec<u8>, size: (u32, u32), frames: usize, fps: f64) -> Result<Self> {
        let palette = Palette::new();
        let mut encoder = Encoder::new(out, size.0, size.1);
        encoder.set_color(ColorType::Indexed);
        encoder.set_depth(BitDepth::Eight);
        encoder.set_palette(palette.rgb());
        encoder.set_trns(vec![0]); // KEEP is transparent, the rest opaque
        encoder.set_deflate_compression(DeflateCompression::Level(1));
        encoder.set_filter(Filter::NoFilter);
        encoder.set_animated(u32::try_from(frames).unwrap_or(u32::MAX), 0)?;
        encoder.set_frame_delay(100, (100.0 * fps).round() as u16)?;
        let writer = encoder.write_header()?;
        Ok(Self { writer, palette, width: size.0 as usize, shown: Vec::new(), painted: Vec::new() })
    }

    /// Adds a picture.
    pub(super) fn push(&mut self, picture: &Pixmap) -> Result<()> {
        if self.shown.is_empty() {
            self.shown = self.indices(picture.data());
            self.writer.write_image_data(&self.shown)?;
        } else {
            let (patch, data) = self.difference(picture.data());
            let [x, y] = [patch.left, patch.top].map(|n| n as u32);
            let [w, h] = [patch.right - patch.left, patch.bottom - patch.top].map(|n| n as u32);
            self.writer.reset_frame_position()?;
            self.writer.set_frame_dimension(w, h)?;
            self.writer.set_frame_position(x, y)?;
            self.writer.set_blend_op(BlendOp::Over)?;
            self.writer.write_image_data(&data)?;
        }
        self.painted.clear();
        self.painted.extend_from_slice(picture.data());
        Ok(())
    }

    /// Ends the film.
    pub(super) fn finish(self) -> Result<()> {
        Ok(self.writer.finish()?)
    }

    fn indices(&self, rgba: &[u8]) -> Vec<u8> {
        rgba.as_chunks().0.iter().map(|pixel| self.palette.index(*pixel)).collect()
    }

    /// Takes over the new picture; returns the rectangle that changed, with [`KEEP`] where it did not.
    fn difference(&mut self, rgba: &[u8]) -> (Patch, Vec<u8>) {
        let mut change = vec![KEEP; self.shown.len()];
        let mut patch = Patch::NONE;
        for y in 0..self.shown.len() / self.width {
            let row = y * self.width..(y + 1) * self.width;
            let bytes = 4 * row.start..4 * row.end;
            if rgba[bytes.clone()] == self.painted[bytes.clone()] {
                continue;
            }
            let new = rgba[bytes].as_chunks().0.iter().map(|pixel| self.palette.index(*pixel));
            let pixels = self.shown[row.clone()].iter_mut().zip(&mut change[row]).zip(new);
            for (x, ((shown, change), new)) in pixels.enumerate() {
                if *shown != new {
                    (*shown, *change) = (new, new);
                    patch.grow(x, y);
                }
            }
        }
        let patch = patch.or_one();
        let lines = change.chunks_exact(self.width).take(patch.bottom).skip(patch.top);
        let data = lines.flat_map(|line| &line[patch.left..patch.right]).copied().collect();
        (patch, data)
    }
}
