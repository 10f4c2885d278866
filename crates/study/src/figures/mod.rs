//! Drawing: plain data in, SVG text out. Knows no model, no study file, no solver.
//!
//! Five figures ([`PathFigure`], [`SeriesFigure`], [`ReturnMapFigure`], [`SpaceTimeFigure`], [`SpectrumFigure`]) return
//! SVG text that stands alone (fonts and pictures are inside); [`png()`] and, under the feature `pdf`, `pdf` turn that
//! text into files; [`Animation`] returns an animated PNG. The same data give the same bytes: numbers are rounded to
//! 0.01 pixel and no system font is used. All
//! texts are markup, see [`Label`].

mod animation;
pub mod axes;
mod block;
mod colour_bar;
mod error;
mod fonts;
pub mod geometry;
mod heat_map;
mod legend;
mod log_ticks;
pub mod paint;
pub mod palette;
mod path;
#[cfg(feature = "pdf")]
mod pdf;
mod raster;
mod return_map;
mod series;
mod simplify;
mod space_time;
mod spectrum;
pub mod svg;
#[cfg(test)]
mod tests;
mod text;
pub mod ticks;

pub use animation::{Animation, Camera, Frame};
pub use error::{FigureError, Result};
pub use path::{OutlineStamp, PathFigure, PathPoint, SectionLine};
#[cfg(feature = "pdf")]
pub use pdf::pdf;
pub use raster::{DEFAULT_SCALE, png};
pub use return_map::ReturnMapFigure;
pub use series::{Curve, Panel, SeriesFigure};
pub use simplify::simplify;
pub use space_time::SpaceTimeFigure;
pub use spectrum::{SpectrumCurve, SpectrumFigure};
pub use text::{Label, literal};
