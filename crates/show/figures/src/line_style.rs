//! Line styles that distinguish lines of one colour.

use super::paint::Paint;
use super::palette::INK;

/// Dashes of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LineStyle {
    /// Unbroken.
    #[default]
    Solid,
    /// Long strokes.
    Dashed,
    /// Dots.
    Dotted,
    /// Strokes and dots in turn.
    DashDotted,
    /// Very long strokes.
    LongDashed,
}

impl LineStyle {
    /// A dark line of this style.
    pub(crate) fn paint(self) -> Paint {
        let line = Paint::stroke(INK, 1.7);
        match self {
            Self::Solid => line,
            Self::Dashed => line.dashed("6 3.5"),
            Self::Dotted => line.dashed("1.7 2.8"),
            Self::DashDotted => line.dashed("7 3 1.7 3"),
            Self::LongDashed => line.dashed("14 4"),
        }
    }
}
