//! Options of figures, shared by `simulate` and `figure`.

use super::{number, whole};
use clap::{Args, ValueEnum};
use motiform_figures::Width;

#[derive(Args)]
pub(crate) struct DrawingOptions {
    /// Do not draw the animation
    #[arg(long)]
    pub(crate) no_animation: bool,
    /// Radius R0 of the undeformed body (default: chosen so that the deformation is visible)
    #[arg(long, value_name = "R0", value_parser = number, allow_hyphen_values = true)]
    pub(crate) radius: Option<f64>,
    /// Scale of the outlines relative to the path (default: chosen for readability)
    #[arg(long, value_name = "F", value_parser = number, allow_hyphen_values = true)]
    pub(crate) scale: Option<f64>,
    /// Number of outlines along the path
    #[arg(long, value_name = "N", value_parser = whole, allow_hyphen_values = true)]
    pub(crate) outlines: Option<u64>,
    /// Draw from this time
    #[arg(long, value_name = "T", value_parser = number, allow_hyphen_values = true)]
    pub(crate) from: Option<f64>,
    /// Draw to this time
    #[arg(long, value_name = "T", value_parser = number, allow_hyphen_values = true)]
    pub(crate) to: Option<f64>,
    /// Title of the figures instead of the default (*letters* between asterisks are italic, _ starts a subscript)
    #[arg(long, value_name = "TEXT")]
    pub(crate) title: Option<String>,
    /// Omit the captions
    #[arg(long)]
    pub(crate) no_caption: bool,
    /// Width of the figures, e.g. 86mm, 3.4in or 1200px (default: as drawn, about 170 mm)
    #[arg(long, value_name = "WIDTH", value_parser = width)]
    pub(crate) width: Option<Width>,
    /// Also write the animation in this format (needs ffmpeg); give it twice for both
    #[arg(long, value_name = "FORMAT", conflicts_with = "no_animation")]
    pub(crate) film: Vec<FilmFormat>,
    /// Also write PDF figures
    #[cfg(feature = "pdf")]
    #[arg(long)]
    pub(crate) pdf: bool,
}

/// Video formats.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum FilmFormat {
    /// H.264 video
    Mp4,
    /// Animated GIF, 256 colours
    Gif,
}

fn width(text: &str) -> Result<Width, String> {
    text.parse().map_err(|error: motiform_figures::FigureError| error.to_string())
}
