//! One marker and one colour for each kind of motion, in every figure and report.
//!
//! Colours: Okabe & Ito (2008), *Color Universal Design*. The regimes can also be distinguished by shape alone.

use super::geometry::Point;
use super::glyph::Glyph;
use super::paint::Paint;
use super::palette::{
    BLACK, BLUE, Colour, DEEP_PURPLE, GREEN, GREY, ORANGE, PURPLE, SKY, VERMILION, WHITE, YELLOW,
};
use super::svg::Svg;
use std::f64::consts::PI;

/// The sense in which a body turns, where left and right differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Hand {
    /// Left.
    Anticlockwise,
    /// Right.
    Clockwise,
}

/// The appearance of a regime.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RegimeMark {
    /// Its name.
    pub name: &'static str,
    /// Its name in legends.
    pub words: &'static str,
    /// Shape of its marker.
    pub glyph: Glyph,
    /// The arrow about its marker.
    pub hand: Option<Hand>,
    /// Colour of its marker.
    pub colour: Colour,
    /// Colour of an area without markers; that of a clockwise motion is hatched.
    pub area: Colour,
}

/// All regimes, in the order of legends and stacked bars; the last one represents all other names. After a regime whose bodies turn come
/// its two senses, of models that tell them apart.
pub const REGIMES: [RegimeMark; 17] = [
    RegimeMark { area: Colour(205, 205, 205), ..mark("motionless", Glyph::Ring, Colour(90, 90, 90)) },
    mark("straight", Glyph::Triangle, BLUE),
    RegimeMark { words: "pulsating straight", ..mark("pulsating-straight", Glyph::DownTriangle, YELLOW) },
    CIRCULAR,
    turning(CIRCULAR, "circular, anticlockwise", Hand::Anticlockwise),
    turning(CIRCULAR, "circular, clockwise", Hand::Clockwise),
    SPINNING,
    turning(SPINNING, "spinning, anticlockwise", Hand::Anticlockwise),
    turning(SPINNING, "spinning, clockwise", Hand::Clockwise),
    mark("rectangular", Glyph::Square, SKY),
    QUASI_PERIODIC,
    turning(QUASI_PERIODIC, "quasi-periodic, anticlockwise", Hand::Anticlockwise),
    turning(QUASI_PERIODIC, "quasi-periodic, clockwise", Hand::Clockwise),
    mark("zigzag", Glyph::Zigzag, GREEN),
    mark("chaotic", Glyph::Star, VERMILION),
    mark("blow-up", Glyph::Cross, BLACK),
    RegimeMark { area: WHITE, ..UNDETERMINED },
];

const CIRCULAR: RegimeMark = mark("circular", Glyph::Disc, ORANGE);
const SPINNING: RegimeMark = mark("spinning", Glyph::Plus, DEEP_PURPLE);
const QUASI_PERIODIC: RegimeMark = mark("quasi-periodic", Glyph::Diamond, PURPLE);
const UNDETERMINED: RegimeMark = mark("undetermined", Glyph::Question, GREY);

const fn mark(name: &'static str, glyph: Glyph, colour: Colour) -> RegimeMark {
    RegimeMark { name, words: name, glyph, hand: None, colour, area: colour }
}

const fn turning(of: RegimeMark, name: &'static str, hand: Hand) -> RegimeMark {
    RegimeMark { name, words: name, hand: Some(hand), ..of }
}

/// The mark of a regime; an unknown name gets that of "undetermined".
pub fn regime_mark(name: &str) -> RegimeMark {
    REGIMES[rank(name)]
}

/// The mark of a regime whose bodies turn in this sense; that of the regime where it has none by sense.
pub fn turning_mark(name: &str, hand: Option<Hand>) -> RegimeMark {
    let known = regime_mark(name);
    let same = |mark: &RegimeMark| mark.glyph == known.glyph && mark.hand == hand;
    REGIMES.into_iter().find(same).unwrap_or(known)
}

/// Place of a regime in [`REGIMES`]; that of "undetermined" for an unknown name.
pub(crate) fn rank(name: &str) -> usize {
    REGIMES.iter().position(|m| m.name == name).unwrap_or(REGIMES.len() - 1)
}

/// Size of the marker within its arrow, and radius of the arrow, of the marker's radius alone.
const WITHIN: f64 = 0.62;
const AROUND: f64 = 1.25;

impl RegimeMark {
    /// Colour of the ground behind a marker: pale.
    pub fn tint(&self) -> Colour {
        WHITE.mix(self.area, 0.28)
    }

    /// Returns `true` if the regime is not known; its areas are hatched.
    pub fn is_undetermined(&self) -> bool {
        self.glyph == Glyph::Question
    }

    /// Returns `true` if its areas have white falling lines.
    pub fn is_clockwise(&self) -> bool {
        self.hand == Some(Hand::Clockwise)
    }

    /// Draws the marker about `at`, as large as a disc of the given radius in pixels, within an arrow where it has a sense.
    pub fn draw(&self, svg: &mut Svg, at: Point, radius: f64) {
        let Some(hand) = self.hand else { return self.glyph.draw(svg, at, radius, self.colour) };
        self.glyph.draw(svg, at, WITHIN * radius, self.colour);
        let dark = self.colour.mix(BLACK, 0.35);
        let side = if hand == Hand::Clockwise { 1.0 } else { -1.0 }; // mirror images
        let place = |angle: f64, radius: f64| {
            let (sin, cos) = angle.sin_cos();
            [at[0] + side * radius * cos, at[1] + radius * sin] // y points down
        };
        let (from, to) = (-0.5 * PI, 0.8 * PI);
        let arc: Vec<Point> =
            (0..=18).map(|k| place(from + (to - from) * f64::from(k) / 18.0, AROUND * radius)).collect();
        svg.polyline(&arc, false, &Paint::stroke(dark, (0.24 * radius).clamp(0.7, 1.6)));
        let tip = place(to + 0.55, AROUND * radius);
        let head = [tip, place(to, (AROUND + 0.5) * radius), place(to, (AROUND - 0.5) * radius)];
        svg.polyline(&head, true, &Paint::fill(dark));
    }
}

#[cfg(test)]
mod tests {
    use super::super::palette::tests::distances;
    use super::*;
    use std::collections::HashSet;

    fn pairs() -> impl Iterator<Item = (RegimeMark, RegimeMark)> {
        REGIMES
            .into_iter()
            .enumerate()
            .flat_map(|(i, a)| REGIMES.into_iter().skip(i + 1).map(move |b| (a, b)))
    }

    #[test]
    fn areas_stay_apart_for_colour_blind_readers() {
        for (a, b) in pairs().filter(|(a, b)| a.glyph != b.glyph) {
            let found = distances(a.area, b.area);
            assert!(found.iter().all(|(apart, least)| apart > least), "{} and {}: {found:?}", a.name, b.name);
        }
    }

    #[test]
    fn every_regime_has_its_own_shape() {
        assert_eq!(REGIMES.iter().map(|m| (m.glyph, m.hand)).collect::<HashSet<_>>().len(), REGIMES.len());
    }

    #[test]
    fn a_name_finds_its_mark_and_an_unknown_one_is_undetermined() {
        for mark in REGIMES {
            assert_eq!(regime_mark(mark.name), mark);
        }
        for (name, hand) in [("spinning", Some(Hand::Clockwise)), ("circular", Some(Hand::Anticlockwise))] {
            let mark = turning_mark(name, hand);
            assert!(mark.name.starts_with(name) && mark.hand == hand && mark.area == regime_mark(name).area);
        }
        assert_eq!(turning_mark("zigzag", Some(Hand::Clockwise)), regime_mark("zigzag"));
        assert_eq!(turning_mark("circular", None), regime_mark("circular"));
        assert!(regime_mark("breathing").is_undetermined() && !regime_mark("chaotic").is_undetermined());
    }

    /// Drawn pixels of the two senses are mirror images of each other, and differ.
    #[test]
    fn senses_are_mirror_images() {
        let pixels = |hand: Hand| {
            let mut svg = Svg::new(60.0, 60.0);
            turning_mark("circular", Some(hand)).draw(&mut svg, [30.0, 30.0], 14.0);
            let picture = super::super::raster::pixmap(&svg.finish(), 1.0).expect("a picture");
            picture.pixels().iter().map(|p| u32::from(p.blue())).collect::<Vec<u32>>()
        };
        let [left, right] = [Hand::Anticlockwise, Hand::Clockwise].map(pixels);
        let off =
            |of: &dyn Fn(usize) -> usize| (0..3600).filter(|&k| left[k].abs_diff(right[of(k)]) > 60).count();
        assert!(off(&|k| 60 * (k / 60) + 59 - k % 60) < 12 && off(&|k| k) > 60);
    }
}
