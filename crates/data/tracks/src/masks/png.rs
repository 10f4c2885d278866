//! PNG images of labels.

use super::{Labels, pixels, unsuitable};
use crate::{Error, Place, Result};
use ::png::{ColorType, Decoder, Transformations};
use std::io::Cursor;

pub(super) fn is_png(head: &[u8]) -> bool {
    head.starts_with(&[0x89, b'P', b'N', b'G'])
}

/// An image of one channel, grey or with a palette, whose numbers count; of 1 to 16 bits.
pub(super) fn decode(bytes: &[u8], place: &Place) -> Result<Labels> {
    let damaged = |error: ::png::DecodingError| {
        Error::structure(place, format!("a damaged image ({error})"), "a label mask as PNG")
    };
    let mut decoder = Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(Transformations::IDENTITY);
    let mut reader = decoder.read_info().map_err(damaged)?;
    let (colour, depth) = reader.output_color_type();
    if !matches!(colour, ColorType::Grayscale | ColorType::Indexed) {
        return Err(unsuitable(place, format!("pixels of several channels ({colour:?})")));
    }
    let [width, height] = [reader.info().width as usize, reader.info().height as usize];
    pixels(width, height, place)?;
    let size = reader.output_buffer_size().unwrap_or(0);
    let mut data = vec![0; size];
    let line = reader.next_frame(&mut data).map_err(damaged)?.line_size;
    let bits = depth as usize;
    let label = |row: &[u8], x: usize| match bits {
        16 => u32::from(row[2 * x]) << 8 | u32::from(row[2 * x + 1]),
        8 => u32::from(row[x]),
        // several pixels in a byte, the first in its highest bits
        _ => u32::from(row[x * bits / 8] >> (8 - bits - x * bits % 8)) & ((1 << bits) - 1),
    };
    let rows = data.chunks_exact(line).take(height);
    let of = rows.flat_map(|row| (0..width).map(move |x| label(row, x))).collect();
    Ok(Labels { width, height, of })
}
