//! SVG to PDF: vectors and selectable text, fonts embedded.

use std::sync::Arc;

use svg2pdf::usvg::fontdb::Database;
use svg2pdf::usvg::{Options, Tree};
use svg2pdf::{ConversionOptions, PageOptions};

use super::error::{FigureError, Result};
use super::fonts::{Face, OWN_FAMILY};

/// Turns an SVG into a one-page PDF; an SVG unit is 1/96 inch.
///
/// The writer brings an older parser than the rasteriser's (usvg 0.45), hence the second font database.
///
/// # Errors   the text is not SVG, or the writer failed
pub fn pdf(svg: &str) -> Result<Vec<u8>> {
    let fail = |why: String| FigureError::Pdf { why };
    let mut fonts = Database::new();
    fonts.load_font_data(Face::Regular.bytes().to_vec());
    fonts.load_font_data(Face::Italic.bytes().to_vec());
    fonts.set_sans_serif_family(OWN_FAMILY);
    let options =
        Options { fontdb: Arc::new(fonts), font_family: OWN_FAMILY.to_owned(), ..Options::default() };
    let tree = Tree::from_str(svg, &options).map_err(|e| fail(e.to_string()))?;
    let page = PageOptions { dpi: 96.0 };
    svg2pdf::to_pdf(&tree, ConversionOptions::default(), page).map_err(|e| fail(e.to_string()))
}
