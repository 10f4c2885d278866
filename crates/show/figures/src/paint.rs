//! Fill, edge, dash and opacity of a shape.

use std::fmt::{self, Display};

use super::palette::Colour;
use super::svg::Num;

/// The paint of a shape: fill and line.
#[derive(Debug, Clone, Copy)]
pub struct Paint {
    fill: Option<(Colour, f64)>,
    stroke: Option<(Colour, f64)>,
    dash: Option<&'static str>,
    /// Length into the dashes at which the line begins.
    dash_from: f64,
    opacity: f64,
}

impl Paint {
    /// Filled, no edge.
    pub fn fill(colour: Colour) -> Self {
        Self { fill: Some((colour, 1.0)), stroke: None, dash: None, dash_from: 0.0, opacity: 1.0 }
    }

    /// A line of a width in pixels, no filling.
    pub fn stroke(colour: Colour, width: f64) -> Self {
        Self { fill: None, stroke: Some((colour, width)), dash: None, dash_from: 0.0, opacity: 1.0 }
    }

    /// Adds an edge of a width in pixels.
    #[must_use]
    pub fn edge(self, colour: Colour, width: f64) -> Self {
        Self { stroke: Some((colour, width)), ..self }
    }

    /// Adds a filling of an opacity between 0 and 1.
    #[must_use]
    pub fn tint(self, colour: Colour, opacity: f64) -> Self {
        Self { fill: Some((colour, opacity)), ..self }
    }

    /// Dashes the line: lengths in pixels, as SVG writes them.
    #[must_use]
    pub fn dashed(self, dash: &'static str) -> Self {
        Self { dash: Some(dash), ..self }
    }

    /// Begins the line at this length into its dashes (pixels).
    #[must_use]
    pub fn dash_from(self, length: f64) -> Self {
        Self { dash_from: length, ..self }
    }

    /// Colour and width of the line, if there is one.
    pub(crate) fn line(&self) -> Option<(Colour, f64)> {
        self.stroke
    }

    /// Opacity of the whole shape, between 0 and 1.
    #[must_use]
    pub fn opacity(self, opacity: f64) -> Self {
        Self { opacity, ..self }
    }
}

impl Display for Paint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.fill {
            Some((colour, opacity)) if opacity < 1.0 => {
                write!(f, " fill=\"{colour}\" fill-opacity=\"{}\"", Num(opacity))?;
            }
            Some((colour, _)) => write!(f, " fill=\"{colour}\"")?,
            None => f.write_str(" fill=\"none\"")?,
        }
        if let Some((colour, width)) = self.stroke {
            write!(f, " stroke=\"{colour}\" stroke-width=\"{}\"", Num(width))?;
            write!(
                f,
                " stroke-linejoin=\"round\" stroke-linecap=\"{}\"",
                if self.dash.is_some() { "butt" } else { "round" }
            )?;
        }
        if let Some(dash) = self.dash {
            write!(f, " stroke-dasharray=\"{dash}\"")?;
            if self.dash_from > 0.0 {
                write!(f, " stroke-dashoffset=\"{}\"", Num(self.dash_from))?;
            }
        }
        if self.opacity < 1.0 {
            write!(f, " opacity=\"{}\"", Num(self.opacity))?;
        }
        Ok(())
    }
}
