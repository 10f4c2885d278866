//! Drawing: plain data in, SVG text out. Independent of models, study files and solvers.
//!
//! A [`Chart`] is a list of [`Layer`]s on one pair of axes: [`BandCurve`], [`SurvivalCurve`], [`ErrorBarSeries`], [`Interval`]s,
//! [`ExpectedLine`], [`Spectra`], [`Returns`], [`BranchDiagram`]. Figures with another sheet ([`PathFigure`], [`SeriesFigure`],
//! [`SpaceTimeFigure`], [`PhaseDiagram`], [`CurveMap`], [`PlaceMap`], [`TrackPanels`]) and [`Panels`] of any of them return, as charts do,
//! self-contained SVG text (fonts and pictures are
//! inside); [`png()`] and [`pdf()`] (feature `raster`) convert that text to files; [`Animation`] returns an animated
//! PNG. The same data give the same bytes: numbers are rounded to 0.01 pixel and no system font is used. All texts are
//! markup, see [`Label`]; every regime has its [`RegimeMark`].

mod animation;
pub mod axes;
mod bands;
mod beside;
mod block;
mod branch_names;
mod branches;
mod callouts;
mod chart;
mod clip;
mod colour_bar;
mod curve_map;
mod embedded;
mod error;
mod error_bars;
mod expected;
mod figure;
mod fonts;
mod framed;
pub mod geometry;
mod glyph;
mod heat_map;
mod html;
mod interval;
mod layer;
mod legend;
mod letters;
mod line_style;
mod log_ticks;
mod marks;
pub mod paint;
pub mod palette;
mod panels;
mod path;
#[cfg(feature = "raster")]
mod pdf;
mod phase_diagram;
mod picture;
mod place_map;
mod plane;
mod portable;
#[cfg(feature = "raster")]
mod raster;
pub mod report;
mod rescale;
mod return_map;
mod room;
mod series;
pub mod sheet;
mod simplify;
mod space_time;
mod spectrum;
mod stripes;
mod style;
mod survival;
pub mod svg;
mod text;
pub mod ticks;
mod track_panels;

pub use animation::{Animation, Camera, Frame};
pub use bands::{BandCurve, BandPoint};
pub use branches::{BranchDiagram, BranchDots, BranchMark, BranchPart, Stability};
pub use chart::Chart;
pub use curve_map::{CurveMap, CurveStyle, MapCurve, MapEnd, MapMark};
pub use embedded::{embedded, font_rules};
pub use error::{FigureError, Result};
pub use error_bars::{ErrorBarSeries, Measured};
pub use expected::ExpectedLine;
pub use figure::{Drawn, Figure};
pub use glyph::Glyph;
pub use interval::Interval;
pub use layer::Layer;
pub use line_style::LineStyle;
pub use marks::{Hand, REGIMES, RegimeMark, regime_mark, turning_mark};
pub use panels::Panels;
pub use path::{OutlineStamp, PathFigure, PathPoint, SectionLine};
pub use phase_diagram::{Cell, MapInset, PhaseDiagram};
pub use place_map::{MapPlace, PlaceMap};
pub use portable::{DEFAULT_SCALE, RASTER, pdf, png};
pub use return_map::Returns;
pub use room::Room;
pub use series::{Curve, Panel, SeriesFigure};
pub use simplify::simplify;
pub use space_time::SpaceTimeFigure;
pub use spectrum::{Spectra, SpectrumCurve};
pub use style::{Medium, Style, Width};
pub use survival::{SurvivalCurve, SurvivalStep};
pub use text::{Label, literal, sentence};
pub use track_panels::{TrackPanel, TrackPanels};
