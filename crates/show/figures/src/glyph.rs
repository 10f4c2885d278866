//! Markers of data points, told apart by shape alone.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::geometry::Point;
use super::paint::Paint;
use super::palette::{BLACK, Colour, WHITE};
use super::svg::{Anchor, Svg};
use super::text::Label;

/// Shape of a marker.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Glyph {
    /// A filled disc.
    Disc,
    /// A circle, white inside.
    Ring,
    /// A filled triangle that points up.
    Triangle,
    /// A filled triangle that points down.
    DownTriangle,
    /// A filled square.
    Square,
    /// A filled square on its corner.
    Diamond,
    /// A zigzag line.
    Zigzag,
    /// An asterisk of six arms.
    Star,
    /// A diagonal cross.
    Cross,
    /// An upright cross.
    Plus,
    /// Two triangles that touch: an hourglass on its side.
    Bowtie,
    /// A question mark.
    Question,
}

/// The order in which series of points take their markers.
pub(crate) const SERIES: [Glyph; 6] =
    [Glyph::Disc, Glyph::Square, Glyph::Triangle, Glyph::Diamond, Glyph::Ring, Glyph::DownTriangle];

impl Glyph {
    /// Draws the marker about `at`; a disc has the given radius in pixels, the others look as large.
    pub(crate) fn draw(self, svg: &mut Svg, at: Point, radius: f64, colour: Colour) {
        let thick = (0.36 * radius).clamp(0.7, 2.2);
        let dark = colour.mix(BLACK, 0.35);
        let solid = Paint::fill(colour).edge(dark, (0.14 * radius).clamp(0.4, 0.9));
        let line = Paint::stroke(dark, thick);
        match self {
            Self::Disc => svg.circle(at, radius, &solid),
            Self::Ring => svg.circle(at, 0.92 * radius, &Paint::fill(WHITE).edge(dark, thick)),
            Self::Triangle => svg.polyline(&corners(at, 1.25 * radius, 3, -FRAC_PI_2), true, &solid),
            Self::DownTriangle => svg.polyline(&corners(at, 1.25 * radius, 3, FRAC_PI_2), true, &solid),
            Self::Square => svg.polyline(&corners(at, 1.27 * radius, 4, 0.25 * PI), true, &solid),
            Self::Diamond => svg.polyline(&corners(at, 1.32 * radius, 4, 0.0), true, &solid),
            Self::Zigzag => svg.polyline(&zigzag(at, radius), false, &line),
            Self::Bowtie => svg.polyline(&bowtie(at, 1.15 * radius), true, &solid),
            Self::Star => svg.lines(&arms(at, 1.2 * radius, 3, FRAC_PI_2), &line),
            Self::Cross => svg.lines(&arms(at, 1.2 * radius, 2, 0.25 * PI), &line),
            Self::Plus => svg.lines(&arms(at, 1.2 * radius, 2, 0.0), &line),
            Self::Question => {
                let size = 2.5 * radius;
                svg.text([at[0], at[1] + 0.36 * size], size, Anchor::Middle, &Label::parse("?"));
            }
        }
    }
}

/// Corners of a regular polygon; the first lies at `angle`, clockwise from the right.
fn corners([x, y]: Point, radius: f64, count: u32, angle: f64) -> Vec<Point> {
    let corner = |i: u32| {
        let (s, c) = (angle + TAU * f64::from(i) / f64::from(count)).sin_cos();
        [x + radius * c, y + radius * s]
    };
    (0..count).map(corner).collect()
}

/// Lines through the centre, at equal angles from `angle` on.
fn arms([x, y]: Point, radius: f64, count: u32, angle: f64) -> Vec<[Point; 2]> {
    let arm = |i: u32| {
        let (s, c) = (angle + PI * f64::from(i) / f64::from(count)).sin_cos();
        [[x - radius * c, y - radius * s], [x + radius * c, y + radius * s]]
    };
    (0..count).map(arm).collect()
}

fn zigzag([x, y]: Point, radius: f64) -> [Point; 4] {
    [(-1.5, 0.8), (-0.5, -0.8), (0.5, 0.8), (1.5, -0.8)].map(|(u, v)| [x + u * radius, y + v * radius])
}

fn bowtie([x, y]: Point, radius: f64) -> [Point; 4] {
    [(-1.0, -0.8), (1.0, 0.8), (1.0, -0.8), (-1.0, 0.8)].map(|(u, v)| [x + u * radius, y + v * radius])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn markers_are_centred_and_about_as_large_as_a_disc() {
        for glyph in SERIES.into_iter().chain([
            Glyph::Zigzag,
            Glyph::Bowtie,
            Glyph::Star,
            Glyph::Cross,
            Glyph::Plus,
            Glyph::Question,
        ]) {
            let mut svg = Svg::new(60.0, 60.0);
            glyph.draw(&mut svg, [30.0, 30.0], 10.0, Colour(0, 114, 178));
            let picture = super::super::raster::pixmap(&svg.finish(), 1.0).expect("a picture");
            let inked = picture.pixels().iter().enumerate().filter(|(_, p)| p.red() < 128);
            let places: Vec<_> = inked.map(|(i, _)| [(i % 60) as f64, (i / 60) as f64]).collect();
            for axis in 0..2 {
                let low = places.iter().fold(60.0, |m: f64, p| m.min(p[axis]));
                let high = places.iter().fold(0.0, |m: f64, p| m.max(p[axis]));
                assert!((low + high + 1.0 - 60.0).abs() < 8.0, "{glyph:?} is off centre: {low} to {high}");
                assert!((8.0..=34.0).contains(&(high - low)), "{glyph:?} has the size {}", high - low);
            }
        }
    }
}
