//! One marker and one colour for each kind of motion, in every figure and report.
//!
//! Colours: Okabe & Ito (2008), *Color Universal Design*. The regimes can also be distinguished by shape alone.

use super::geometry::Point;
use super::glyph::Glyph;
use super::palette::{
    BLACK, BLUE, Colour, DEEP_PURPLE, GREEN, GREY, ORANGE, PURPLE, SKY, VERMILION, WHITE, YELLOW,
};
use super::svg::Svg;

/// The appearance of a regime.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RegimeMark {
    /// Its name.
    pub name: &'static str,
    /// Shape of its marker.
    pub glyph: Glyph,
    /// Colour of its marker.
    pub colour: Colour,
    /// Colour of an area without markers.
    pub area: Colour,
}

/// All regimes, in the order of legends and stacked bars; the last one represents all other names.
pub const REGIMES: [RegimeMark; 11] = [
    RegimeMark { area: Colour(205, 205, 205), ..mark("motionless", Glyph::Ring, Colour(90, 90, 90)) },
    mark("straight", Glyph::Triangle, BLUE),
    mark("pulsating-straight", Glyph::DownTriangle, YELLOW),
    mark("circular", Glyph::Disc, ORANGE),
    mark("spinning", Glyph::Plus, DEEP_PURPLE),
    mark("rectangular", Glyph::Square, SKY),
    mark("quasi-periodic", Glyph::Diamond, PURPLE),
    mark("zigzag", Glyph::Zigzag, GREEN),
    mark("chaotic", Glyph::Star, VERMILION),
    mark("blow-up", Glyph::Cross, BLACK),
    RegimeMark { area: WHITE, ..UNDETERMINED },
];

const UNDETERMINED: RegimeMark = mark("undetermined", Glyph::Question, GREY);

const fn mark(name: &'static str, glyph: Glyph, colour: Colour) -> RegimeMark {
    RegimeMark { name, glyph, colour, area: colour }
}

/// The mark of a regime; an unknown name gets that of "undetermined".
#[must_use]
pub fn regime_mark(name: &str) -> RegimeMark {
    REGIMES[rank(name)]
}

/// Place of a regime in [`REGIMES`]; that of "undetermined" for an unknown name.
pub(crate) fn rank(name: &str) -> usize {
    REGIMES.iter().position(|m| m.name == name).unwrap_or(REGIMES.len() - 1)
}

impl RegimeMark {
    /// Colour of the ground behind a marker: pale.
    #[must_use]
    pub fn tint(&self) -> Colour {
        WHITE.mix(self.area, 0.28)
    }

    /// Returns `true` if the regime is not known; its areas are hatched.
    #[must_use]
    pub fn is_undetermined(&self) -> bool {
        self.glyph == Glyph::Question
    }

    /// Draws the marker about `at`, as large as a disc of the given radius in pixels.
    pub fn draw(&self, svg: &mut Svg, at: Point, radius: f64) {
        self.glyph.draw(svg, at, radius, self.colour);
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
        for (a, b) in pairs() {
            let found = distances(a.area, b.area);
            assert!(found.iter().all(|(apart, least)| apart > least), "{} and {}: {found:?}", a.name, b.name);
        }
    }

    #[test]
    fn every_regime_has_its_own_shape() {
        assert_eq!(REGIMES.iter().map(|m| m.glyph).collect::<HashSet<_>>().len(), REGIMES.len());
    }

    #[test]
    fn a_name_finds_its_mark_and_an_unknown_one_is_undetermined() {
        for mark in REGIMES {
            assert_eq!(regime_mark(mark.name), mark);
        }
        assert!(regime_mark("breathing").is_undetermined() && !regime_mark("chaotic").is_undetermined());
    }
}
