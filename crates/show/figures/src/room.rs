//! The width that a sheet is laid out for.

use super::geometry::Point;

/// The narrowest frame, in units of the drawing.
const NARROWEST: f64 = 90.0;

/// Height of a frame over its width where less would be cramped.
const FLATTEST: f64 = 0.62;

/// The width of a sheet in units of its drawing, in which sizes of text and lines are fixed: a narrow sheet has smaller frames, not
/// smaller letters. Without a width each figure has its own.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Room {
    width: Option<f64>,
    /// Height of the frame, where a row of panels or a slide has one.
    height: Option<f64>,
    /// The place of the sheet on a larger one.
    corner: Point,
    /// The number of the panel, from 0.
    panel: usize,
}

impl Room {
    /// The default width of each figure.
    pub const OWN: Self = Self { width: None, height: None, corner: [0.0; 2], panel: 0 };

    /// A sheet of this width.
    pub const fn of(width: f64) -> Self {
        Self { width: Some(width), ..Self::OWN }
    }

    /// A panel of a larger sheet: its number, width, the height of its frame and its upper left corner.
    pub(crate) const fn panel(panel: usize, width: f64, height: Option<f64>, corner: Point) -> Self {
        Self { width: Some(width), height, corner, panel }
    }

    /// The same with a frame of this height.
    pub(crate) const fn with_height(self, height: f64) -> Self {
        Self { height: Some(height), ..self }
    }

    /// The height of the frame, if one is asked for.
    pub(crate) const fn height(self) -> Option<f64> {
        self.height
    }

    /// The place of the sheet on a larger one.
    pub(crate) const fn corner(self) -> Point {
        self.corner
    }

    /// The number from which the names inside a sheet count, so that no two panels share one.
    pub(crate) const fn ids(self) -> u32 {
        1000 * self.panel as u32
    }

    /// The width, if one is asked for.
    pub const fn width(self) -> Option<f64> {
        self.width
    }

    /// Width and height of a frame whose default size is `[w, h]`, where labels and margins take `beside`
    /// units of the width. A narrower frame keeps the aspect ratio, but its height is at least .62 of its
    /// width, or `h` where that is less. A panel has the height of its row.
    pub(crate) fn frame(self, [w, h]: [f64; 2], beside: f64) -> [f64; 2] {
        let Some(width) = self.width else { return [w, h] };
        let wide = (width - beside).floor().max(NARROWEST);
        [wide, self.height.unwrap_or_else(|| (h * wide / w).max(h.min(FLATTEST * wide)).round())]
    }

    /// The number, out of `most`, of marks that have room side by side in a frame whose default width is `w`.
    pub(crate) fn most(self, most: usize, w: f64) -> usize {
        self.width.map_or(most, |width| (most as f64 * ((width - 80.0) / w).clamp(0.1, 1.0)) as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_fills_what_is_left_and_keeps_its_shape() {
        assert_eq!(Room::OWN.frame([600.0, 360.0], 80.0), [600.0, 360.0]);
        assert_eq!(Room::of(380.0).frame([600.0, 360.0], 80.0), [300.0, 186.0]); // not flatter than .62
        assert_eq!(Room::of(380.0).frame([420.0, 420.0], 80.0), [300.0, 300.0]);
        assert_eq!(Room::of(380.0).frame([600.0, 120.0], 80.0), [300.0, 120.0]);
        assert_eq!(Room::of(1280.0).frame([600.0, 360.0], 80.0), [1200.0, 720.0]);
        assert_eq!(Room::of(20.0).frame([600.0, 360.0], 80.0)[0], NARROWEST);
    }
}
