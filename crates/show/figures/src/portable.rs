//! SVG to PNG and PDF, if that is built in.

use super::error::Result;

/// Scale factor for print and dense screens.
pub const DEFAULT_SCALE: f64 = 2.0;

/// `true` if [`png()`] and [`pdf()`] are built in (feature `raster`).
pub const RASTER: bool = cfg!(feature = "raster");

/// Draws an SVG, as the figures of this crate make it, into a PNG; `texts` are (keyword, text) pairs kept in
/// the file, such as a provenance.
///
/// # Units     `scale`: pixels per SVG unit, 0.1 to 16
/// # Errors
/// Another SVG, a scale out of range, a keyword that PNG does not allow (1 to 79 Latin-1 letters), or a program
/// without it ([`RASTER`]).
#[cfg(feature = "raster")]
pub fn png(svg: &str, scale: f64, texts: &[(&str, &str)]) -> Result<Vec<u8>> {
    super::raster::png(svg, scale, texts)
}

/// Refuses: this program was built without the feature `raster`.
#[cfg(not(feature = "raster"))]
pub fn png(_svg: &str, _scale: f64, _texts: &[(&str, &str)]) -> Result<Vec<u8>> {
    Err(super::error::FigureError::NoRaster)
}

/// Turns an SVG, as the figures of this crate make it, into a PDF of one page: vectors, and text with its fonts. An SVG unit is 1/96 inch.
///
/// # Errors    another SVG, or a program without it ([`RASTER`])
#[cfg(feature = "raster")]
pub fn pdf(svg: &str) -> Result<Vec<u8>> {
    super::pdf::pdf(svg)
}

/// Refuses: this program was built without the feature `raster`.
#[cfg(not(feature = "raster"))]
pub fn pdf(_svg: &str) -> Result<Vec<u8>> {
    Err(super::error::FigureError::NoRaster)
}
