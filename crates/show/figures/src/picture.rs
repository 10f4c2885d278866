//! A small PNG with a palette.

use super::error::Result;
use super::palette::Colour;

/// The PNG of pixels that are indices into a palette, row after row from the top.
pub(super) fn indexed_png(columns: usize, palette: &[Colour], pixels: &[u8]) -> Result<Vec<u8>> {
    let mut out = Vec::new();
    let mut encoder = png::Encoder::new(&mut out, columns as u32, (pixels.len() / columns) as u32);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(palette.iter().flat_map(|Colour(r, g, b)| [*r, *g, *b]).collect::<Vec<_>>());
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(out)
}
