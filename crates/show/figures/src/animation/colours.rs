//! The 8-bit colours of a film: its few inks and their blends.

use crate::palette::{BLUE, Colour, INK, PALE, SKY, WHITE};

/// Body of the domain.
pub(super) const BODY: Colour = SKY;
/// Edge of the domain.
pub(super) const EDGE: Colour = Colour(0, 80, 125);
/// Trail of the centre.
pub(super) const TRAIL: Colour = BLUE;

/// Steps of a blend between two inks.
const STEPS: u32 = 8;

/// Index that leaves a pixel as it was.
pub(super) const KEEP: u8 = 0;

/// Colours by index, and the nearest index of any colour.
pub(super) struct Palette {
    colours: Vec<Colour>,
    /// By the upper five bits of red, green, blue.
    nearest: Vec<u8>,
}

impl Palette {
    /// The palette of all films.
    pub(super) fn new() -> Self {
        let tint = WHITE.mix(BODY, 0.75);
        let inks = [WHITE, PALE, INK, TRAIL, EDGE, tint, TRAIL.mix(BODY, 0.75)];
        let mut colours = vec![WHITE]; // KEEP: transparent, so its colour is never seen
        for (i, ink) in inks.iter().enumerate() {
            colours.push(*ink);
            for other in &inks[i + 1..] {
                colours.extend((1..STEPS).map(|k| ink.mix(*other, f64::from(k) / f64::from(STEPS))));
            }
        }
        let nearest = (0..1 << 15).map(|code| nearest(&colours, code)).collect();
        Self { colours, nearest }
    }

    /// Red, green, blue of all indices in turn.
    pub(super) fn rgb(&self) -> Vec<u8> {
        self.colours.iter().flat_map(|c| [c.0, c.1, c.2]).collect()
    }

    /// Index of an opaque pixel, never [`KEEP`].
    #[inline]
    pub(super) fn index(&self, rgba: [u8; 4]) -> u8 {
        let [r, g, b] = [rgba[0], rgba[1], rgba[2]].map(|v| usize::from(v >> 3));
        self.nearest[r << 10 | g << 5 | b]
    }
}

fn nearest(colours: &[Colour], code: i32) -> u8 {
    let wanted = [code >> 10, code >> 5, code].map(|v| (v & 31) * 255 / 31);
    let off = |c: &Colour| {
        let d = [i32::from(c.0) - wanted[0], i32::from(c.1) - wanted[1], i32::from(c.2) - wanted[2]];
        2 * d[0] * d[0] + 4 * d[1] * d[1] + d[2] * d[2] // the eye weighs green most
    };
    let best = colours.iter().enumerate().skip(1).min_by_key(|(_, c)| off(c));
    best.map_or(1, |(i, _)| i as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn palette_fits_a_byte_and_keeps_white() {
        let palette = Palette::new();
        assert!(palette.colours.len() <= 256);
        let white = palette.index([255; 4]);
        assert!(white != KEEP && palette.colours[usize::from(white)] == WHITE);
    }
}
