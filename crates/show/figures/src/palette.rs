//! Colours that can be distinguished with colour blindness, in grey printing and on white paper.
//!
//! Categories: Okabe & Ito (2008), *Color Universal Design*. Time: viridis (Smith & van der Walt 2015, CC0),
//! cut at 0.88 because its yellow end vanishes on white. Signed values: our own ramp, see [`signed_colour`].

use std::fmt;

use super::geometry::Range;

/// An opaque sRGB colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Colour(
    /// Red.
    pub u8,
    /// Green.
    pub u8,
    /// Blue.
    pub u8,
);

impl fmt::Display for Colour {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{:02x}{:02x}{:02x}", self.0, self.1, self.2)
    }
}

/// Okabe-Ito black.
pub const BLACK: Colour = Colour(0, 0, 0);
/// Paper white.
pub const WHITE: Colour = Colour(255, 255, 255);
/// Frames, ticks and text.
pub const INK: Colour = Colour(34, 34, 34);
/// Secondary lines: diagonals, guides.
pub const GREY: Colour = Colour(136, 136, 136);
/// Shading behind a curve.
pub const PALE: Colour = Colour(238, 238, 238);
/// Okabe-Ito blue.
pub const BLUE: Colour = Colour(0, 114, 178);
/// Okabe-Ito vermilion.
pub const VERMILION: Colour = Colour(213, 94, 0);
/// Okabe-Ito bluish green.
pub const GREEN: Colour = Colour(0, 158, 115);
/// Okabe-Ito reddish purple.
pub const PURPLE: Colour = Colour(204, 121, 167);
/// Okabe-Ito orange.
pub const ORANGE: Colour = Colour(230, 159, 0);
/// Okabe-Ito sky blue.
pub const SKY: Colour = Colour(86, 180, 233);
/// Okabe-Ito yellow: for areas, too pale for lines.
pub const YELLOW: Colour = Colour(240, 228, 66);

/// Between black and purple, for areas: at least 95 from each colour above and from white in sRGB, for every kind of colour blindness.
pub const DEEP_PURPLE: Colour = Colour(80, 20, 100);

/// The order in which curves take their colours.
pub const CATEGORIES: [Colour; 6] = [BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY];

/// Viridis at 0, 0.11, 0.22, ..., 0.88.
const TIME: [Colour; 9] = [
    Colour(68, 1, 84),
    Colour(72, 36, 117),
    Colour(64, 67, 135),
    Colour(52, 94, 141),
    Colour(41, 120, 142),
    Colour(32, 144, 140),
    Colour(35, 169, 131),
    Colour(68, 191, 112),
    Colour(122, 209, 81),
];

/// Colours of negative values, from 0 outwards: CIELAB lightness 97, 88, 77, 65, 53, 41, 29 at the hue of [`BLUE`].
const NEGATIVE: [Colour; 7] = [
    Colour(246, 246, 246),
    Colour(206, 222, 245),
    Colour(155, 193, 239),
    Colour(93, 163, 229),
    Colour(3, 132, 205),
    Colour(2, 101, 159),
    Colour(1, 72, 115),
];

/// Colours of positive values: the same lightness at the hue of [`VERMILION`].
const POSITIVE: [Colour; 7] = [
    Colour(246, 246, 246),
    Colour(243, 215, 201),
    Colour(232, 179, 150),
    Colour(212, 141, 100),
    Colour(189, 105, 53),
    Colour(153, 75, 24),
    Colour(111, 52, 12),
];

impl Colour {
    /// The colour at `fraction` (0 to 1, clamped) of the way to `other`.
    #[must_use]
    pub fn mix(self, other: Self, fraction: f64) -> Self {
        let f = fraction.clamp(0.0, 1.0);
        let mix = |a: u8, b: u8| (f64::from(a) + f * (f64::from(b) - f64::from(a))).round() as u8;
        Self(mix(self.0, other.0), mix(self.1, other.1), mix(self.2, other.2))
    }
}

/// Colour of time: `fraction` 0 is the start (dark violet), 1 the end (light green). Clamped.
pub fn time_colour(fraction: f64) -> Colour {
    along(&TIME, fraction)
}

/// Colour of a signed value: -1 dark blue, 0 nearly white, 1 dark orange. Clamped.
///
/// Sign is hue, magnitude is lightness, equal for both signs; blue and orange stay apart for every kind of colour
/// blindness (Okabe & Ito 2008).
pub fn signed_colour(value: f64) -> Colour {
    along(if value < 0.0 { &NEGATIVE } else { &POSITIVE }, value.abs())
}

/// The colour at `fraction` (0 to 1, clamped) of a ramp of equal steps.
fn along(ramp: &[Colour], fraction: f64) -> Colour {
    let position = fraction.clamp(0.0, 1.0) * (ramp.len() - 1) as f64;
    let i = (position as usize).min(ramp.len() - 2);
    ramp[i].mix(ramp[i + 1], position - i as f64)
}

/// Colour of time `t` within `range`; the start colour if the range is empty.
pub fn time_colour_in(t: f64, range: Range) -> Colour {
    time_colour(if range.span() > 0.0 { (t - range.min) / range.span() } else { 0.0 })
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    fn luminance(c: Colour) -> f64 {
        0.2126 * f64::from(c.0) + 0.7152 * f64::from(c.1) + 0.0722 * f64::from(c.2)
    }

    #[test]
    fn time_brightens_monotonically_and_stays_darker_than_paper() {
        let all: Vec<_> = (0..=50).map(|i| luminance(time_colour(f64::from(i) / 50.0))).collect();
        assert!(all.windows(2).all(|w| w[0] < w[1]));
        assert!(all[50] < 0.75 * luminance(WHITE));
    }

    /// As a deuteranope sees it. Source: Machado, Oliveira & Fernandes (2009), IEEE TVCG 15, 1291, severity 1.0
    /// (matrix applied to sRGB values, which is sufficient to distinguish colours).
    pub(crate) fn deuteranope(colour: Colour) -> [f64; 3] {
        seen(colour, [[0.367, 0.861, -0.228], [0.280, 0.673, 0.047], [-0.012, 0.043, 0.969]])
    }

    /// As a protanope sees it, from the same source.
    pub(crate) fn protanope(colour: Colour) -> [f64; 3] {
        seen(colour, [[0.152, 1.053, -0.205], [0.115, 0.786, 0.099], [-0.004, -0.048, 1.052]])
    }

    /// As a tritanope sees it, from the same source.
    pub(crate) fn tritanope(colour: Colour) -> [f64; 3] {
        seen(colour, [[1.256, -0.077, -0.179], [-0.078, 0.931, 0.148], [0.005, 0.691, 0.304]])
    }

    /// The perception of a colour by an eye.
    type Sight = fn(Colour) -> [f64; 3];

    /// The distance of two colours in sRGB for each kind of sight, with the least distance that it needs:
    /// normal, deuteranope, protanope, and tritanope, one in ten thousand, for whom blue and bluish green of
    /// Okabe and Ito are close.
    pub(crate) fn distances(a: Colour, b: Colour) -> [(f64, f64); 4] {
        let plain = |c: Colour| [c.0, c.1, c.2].map(f64::from);
        let kinds: [(Sight, f64); 4] =
            [(plain, 48.0), (deuteranope, 48.0), (protanope, 48.0), (tritanope, 30.0)];
        kinds.map(|(seen, least)| {
            let [a, b] = [seen(a), seen(b)].map(|c| c.map(|part| part.clamp(0.0, 255.0)));
            (a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt(), least)
        })
    }

    #[test]
    fn curves_stay_apart_for_colour_blind_readers() {
        for (i, a) in CATEGORIES.into_iter().enumerate() {
            for b in CATEGORIES.into_iter().skip(i + 1).chain([WHITE, INK]) {
                assert!(
                    distances(a, b).iter().all(|(apart, least)| apart > least),
                    "{a}, {b}: {:?}",
                    distances(a, b)
                );
            }
        }
    }

    #[test]
    fn time_runs_one_way_for_colour_blind_readers() {
        for seen in [deuteranope, protanope, tritanope] {
            let all: Vec<f64> = (0..=20)
                .map(|i| seen(time_colour(f64::from(i) / 20.0)))
                .map(|[r, g, b]| 0.2126 * r + 0.7152 * g + 0.0722 * b)
                .collect();
            assert!(all.windows(2).all(|w| w[0] < w[1]) && all[20] - all[0] > 100.0, "{all:?}");
        }
    }

    fn seen(Colour(r, g, b): Colour, rows: [[f64; 3]; 3]) -> [f64; 3] {
        rows.map(|m: [f64; 3]| m[0] * f64::from(r) + m[1] * f64::from(g) + m[2] * f64::from(b))
    }

    #[test]
    fn signed_values_darken_alike_and_keep_their_sign_apart() {
        let of = |i: i32| signed_colour(f64::from(i) / 20.0);
        for i in 1..=20 {
            assert!(luminance(of(i)) < luminance(of(i - 1)) && luminance(of(-i)) < luminance(of(1 - i)));
            assert!((luminance(of(i)) - luminance(of(-i))).abs() < 12.0, "{i}");
        }
        for i in 4..=20 {
            let distances = distances(of(i), of(-i));
            assert!(distances.iter().all(|(apart, _)| *apart > 30.0), "{i}: {distances:?}");
        }
        assert_eq!((of(0), of(-99)), (Colour(246, 246, 246), of(-20)));
    }
}
