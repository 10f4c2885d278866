//! Writes pictures as an animated PNG, each as the rectangle of what changed.

use std::ops::Range;

use png::{BitDepth, BlendOp, ColorType, DeflateCompression, Encoder, Filter, Writer};
use resvg::tiny_skia::Pixmap;

use super::colours::{KEEP, Palette};
use crate::figures::error::Result;

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

/// A rectangle of pixels.
struct Patch {
    rows: Range<usize>,
    columns: Range<usize>,
}

impl<'a> Film<'a> {
    /// Starts a film of a number of frames that repeats for ever.
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
            let [w, h] = [patch.columns.len(), patch.rows.len()].map(|n| n as u32);
            self.writer.reset_frame_position()?;
            self.writer.set_frame_dimension(w, h)?;
            self.writer.set_frame_position(patch.columns.start as u32, patch.rows.start as u32)?;
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
        let (mut rows, mut columns) = (usize::MAX..0, usize::MAX..0);
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
                    rows = rows.start.min(y)..y + 1;
                    columns = columns.start.min(x)..columns.end.max(x + 1);
                }
            }
        }
        let patch =
            if rows.is_empty() { Patch { rows: 0..1, columns: 0..1 } } else { Patch { rows, columns } };
        let lines = patch.rows.clone().map(|y| y * self.width + patch.columns.start);
        let data = lines.flat_map(|i| change[i..i + patch.columns.len()].iter().copied()).collect();
        (patch, data)
    }
}
