//! Data to pixels on axes of any kind.

use super::axes::{AxisKind, Scale};
use super::clip::clip;
use super::geometry::Point;

/// The frame of a chart: values have places along its axes, and places have pixels.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plane {
    /// Places along the axes to pixels.
    pub(super) scale: Scale,
    /// The divisions of the axes, across and upwards.
    pub(super) kinds: [AxisKind; 2],
}

impl Plane {
    /// The pixels of a data point; `None` where it has no place on a logarithmic axis.
    pub(super) fn at(&self, [x, y]: Point) -> Option<Point> {
        Some(self.scale.map([self.kinds[0].place(x)?, self.kinds[1].place(y)?]))
    }

    /// The pixels of a data point that lies in the frame.
    pub(super) fn within(&self, point: Point) -> Option<Point> {
        let frame = self.scale.frame;
        let inside =
            |[x, y]: &Point| (frame.x..=frame.right()).contains(x) && (frame.y..=frame.bottom()).contains(y);
        self.at(point).filter(inside)
    }

    /// The polylines through data points inside the frame, interrupted where a point has no place.
    pub(super) fn pieces(&self, points: impl IntoIterator<Item = Point>) -> Vec<Vec<Point>> {
        let places: Vec<Option<Point>> = points.into_iter().map(|point| self.at(point)).collect();
        let pieces = places.split(Option::is_none);
        let piece = |piece: &[Option<Point>]| piece.iter().copied().flatten().collect::<Vec<_>>();
        pieces.flat_map(|points| clip(&piece(points), self.scale.frame)).collect()
    }

    /// The place of a value upwards, cut off at the frame; what has none lies at the lower edge.
    pub(super) fn upwards(&self, y: f64) -> f64 {
        let range = self.scale.y;
        self.kinds[1].place(y).unwrap_or(range.min).clamp(range.min, range.max)
    }
}
