//! SVG to PNG, with our own fonts only: the same bits on every machine.

use resvg::tiny_skia::{Color, Pixmap, Transform};
use resvg::usvg::fontdb::Database;
use resvg::usvg::{Options, Tree};
use std::sync::{Arc, OnceLock};

use super::error::{FigureError, Result, check_range};
use super::fonts::{Face, OWN_FAMILY};

/// Most pixels of an image: 100 million.
const MOST_PIXELS: f64 = 1e8;

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
    let options = Options { fontdb: database(), font_family: OWN_FAMILY.to_owned(), ..Options::default() };
    let tree = Tree::from_str(svg, &options)?;
    let size = [tree.size().width(), tree.size().height()].map(|side| (f64::from(side) * scale).ceil());
    let pixels = size[0] * size[1];
    check_range("number of pixels", pixels, 1.0, MOST_PIXELS)?;
    let mut pixmap = Pixmap::new(size[0] as u32, size[1] as u32).ok_or(FigureError::OutOfRange {
        what: "number of pixels",
        value: pixels,
        min: 1.0,
        max: MOST_PIXELS,
    })?;
    pixmap.fill(Color::WHITE); // the sheet may end inside the last row and column
    let scale = scale as f32;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    Ok(pixmap)
}

/// The font database of the rasteriser: our two faces and no system fonts.
fn database() -> Arc<Database> {
    static DATABASE: OnceLock<Arc<Database>> = OnceLock::new();
    Arc::clone(DATABASE.get_or_init(|| {
        let mut database = Database::new();
        for face in [Face::Regular, Face::Italic] {
            database.load_font_data(face.bytes().to_vec());
        }
        database.set_sans_serif_family(OWN_FAMILY);
        Arc::new(database)
    }))
}
