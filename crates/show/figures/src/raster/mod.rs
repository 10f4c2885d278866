//! SVG to PNG: the drawings of this crate, with its own fonts. The same bits on every machine.

pub(crate) mod element;
pub(crate) mod painter;
mod pixels;
pub(crate) mod shapes;

use tiny_skia::Pixmap;

use super::error::{Result, check_range};

/// As [`crate::png()`].
pub(crate) fn png(svg: &str, scale: f64, texts: &[(&str, &str)]) -> Result<Vec<u8>> {
    let pixmap = pixmap(svg, scale)?;
    let mut out = Vec::new();
    let mut encoder = png::Encoder::new(&mut out, pixmap.width(), pixmap.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let dots = (96.0 * scale / 0.0254).round() as u32; // an SVG unit is 1/96 inch
    encoder.set_pixel_dims(Some(png::PixelDimensions { xppu: dots, yppu: dots, unit: png::Unit::Meter }));
    for (keyword, text) in texts {
        encoder.add_itxt_chunk((*keyword).to_owned(), (*text).to_owned())?;
    }
    let mut writer = encoder.write_header()?;
    // the sheet is opaque white, so premultiplied equals plain colour
    let rgb: Vec<u8> = pixmap.pixels().iter().flat_map(|p| [p.red(), p.green(), p.blue()]).collect();
    writer.write_image_data(&rgb)?;
    writer.finish()?;
    Ok(out)
}

/// Draws an SVG into memory.
pub(crate) fn pixmap(svg: &str, scale: f64) -> Result<Pixmap> {
    check_range("scale", scale, 0.1, 16.0)?;
    Ok(painter::paint(svg, |sheet| pixels::Pixels::new(sheet, scale))?.pixmap)
}
