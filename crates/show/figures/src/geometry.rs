//! Points, boxes and ranges, in pixels (y down) or in data units (y up).

/// A point or vector of the plane.
pub type Point = [f64; 2];

/// A box in pixels: left, top, width, height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rect {
    /// Left edge.
    pub x: f64,
    /// Top edge.
    pub y: f64,
    /// Width, at least 0.
    pub w: f64,
    /// Height, at least 0.
    pub h: f64,
}

impl Rect {
    /// Right edge.
    pub fn right(&self) -> f64 {
        self.x + self.w
    }

    /// Bottom edge.
    pub fn bottom(&self) -> f64 {
        self.y + self.h
    }
}

/// A closed interval of data values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Lower end.
    pub min: f64,
    /// Upper end.
    pub max: f64,
}

impl Range {
    /// Smallest range that holds all values; `None` without values.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        values.into_iter().fold(None, |range: Option<Self>, v| {
            Some(range.map_or(Self { min: v, max: v }, |r| Self { min: r.min.min(v), max: r.max.max(v) }))
        })
    }

    /// Length of the interval.
    pub fn span(&self) -> f64 {
        self.max - self.min
    }

    /// Centre of the interval.
    pub fn middle(&self) -> f64 {
        0.5 * self.min + 0.5 * self.max
    }

    /// The range of the given length about the same centre.
    pub fn with_span(&self, span: f64) -> Self {
        Self { min: self.middle() - 0.5 * span, max: self.middle() + 0.5 * span }
    }

    /// The range widened on both sides by `fraction` of its length, and enough to be an axis: an empty range
    /// becomes one of length 1 (or 20 % of the value, if that is more), one too narrow for distinct
    /// double-precision ticks is widened to 1e-9 of the value.
    pub fn padded(&self, fraction: f64) -> Self {
        let size = self.min.abs().max(self.max.abs());
        let span = if self.span() > 0.0 { self.span() } else { (0.2 * size).max(1.0) };
        self.with_span((span * (1.0 + 2.0 * fraction)).max(1e-9 * size).max(1e-100))
    }
}

impl Range {
    /// The range of an axis for values whose differences are known from `least` on: as it is where the values differ by so much. Values
    /// that do not are one: the range holds 20 % of it, or is empty where it is 0 as far as is known. A `least` of 0 leaves every range.
    pub fn resolved(&self, least: f64) -> Self {
        if self.span() >= least {
            return *self;
        }
        let one = self.middle();
        if one.abs() < least { Self { min: 0.0, max: 0.0 } } else { self.with_span(0.2 * one.abs()) }
    }
}

/// Distance of two points.
pub(crate) fn distance(a: Point, b: Point) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_does_not_show_errors() {
        let range = |min, max| Range { min, max };
        let fine = range(18.221_402_00, 18.221_402_02);
        assert_eq!(fine.resolved(0.0), fine);
        assert_eq!(fine.resolved(1e-8), fine, "they differ by 2e-8");
        let flat = fine.resolved(3e-8);
        assert!(
            (flat.min - 0.9 * fine.middle()).abs() < 1e-9 && (flat.max - 1.1 * fine.middle()).abs() < 1e-9
        );
        assert_eq!(range(0.0, 1e-24).resolved(1e-12), range(0.0, 0.0));
    }
}
