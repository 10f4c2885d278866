//! The two faces used in all figures, and their advance widths.

use std::sync::OnceLock;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use ttf_parser as ttf;

/// CSS list of families: ours first, then what an editor without `@font-face` may have.
pub(crate) const FAMILY: &str = "Motiform Sans, Noto Sans, sans-serif";

/// The name inside our font files.
pub(crate) const OWN_FAMILY: &str = "Motiform Sans";

static REGULAR: &[u8] = include_bytes!("../assets/fonts/MotiformSans-Regular.ttf");
static ITALIC: &[u8] = include_bytes!("../assets/fonts/MotiformSans-Italic.ttf");
static REGULAR_WOFF2: &[u8] = include_bytes!("../assets/fonts/MotiformSans-Regular.woff2");
static ITALIC_WOFF2: &[u8] = include_bytes!("../assets/fonts/MotiformSans-Italic.woff2");

/// A face of the family.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Face {
    /// Upright: words, digits, units.
    Regular,
    /// Italic: symbols of physical quantities.
    Italic,
}

impl Face {
    /// The TrueType file.
    pub(crate) fn bytes(self) -> &'static [u8] {
        match self {
            Self::Regular => REGULAR,
            Self::Italic => ITALIC,
        }
    }

    /// The parsed face; `None` only if the file in the repository is broken (a test looks).
    pub(crate) fn font(self) -> Option<&'static ttf::Face<'static>> {
        static FACES: [OnceLock<Option<ttf::Face<'static>>>; 2] = [OnceLock::new(), OnceLock::new()];
        FACES[self as usize].get_or_init(|| ttf::Face::parse(self.bytes(), 0).ok()).as_ref()
    }
}

/// Advance width of a character, in units of the font size.
///
/// Exact, since the fonts have no kerning. A character without glyph counts as 0.6.
pub(crate) fn advance(face: Face, character: char) -> f64 {
    let width = face.font().and_then(|font| {
        let units = font.glyph_hor_advance(font.glyph_index(character)?)?;
        Some(f64::from(units) / f64::from(font.units_per_em()))
    });
    width.unwrap_or(0.6)
}

/// Returns `true` if the fonts can draw a character.
#[cfg(test)]
pub(crate) fn has_glyph(character: char) -> bool {
    [Face::Regular, Face::Italic]
        .iter()
        .all(|face| face.font().is_some_and(|font| font.glyph_index(character).is_some()))
}

/// `@font-face` rules that make an SVG self-contained.
pub(crate) fn css() -> &'static str {
    static CSS: OnceLock<String> = OnceLock::new();
    CSS.get_or_init(|| {
        let rule = |style: &str, data: &[u8]| {
            let data = STANDARD.encode(data);
            format!(
                "@font-face{{font-family:'{OWN_FAMILY}';font-style:{style};\
                 src:url(data:font/woff2;base64,{data}) format('woff2')}}"
            )
        };
        rule("normal", REGULAR_WOFF2) + &rule("italic", ITALIC_WOFF2)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_parse_and_hold_what_labels_need() {
        for c in "azAZ09\u{2212}\u{b7}\u{d7}\u{b0}\u{2013}κγαβδφθωΔΩ→↔≈≤≥⟨⟩|′²₂∞∝√∂".chars()
        {
            assert!(has_glyph(c), "{c:?}");
        }
    }

    #[test]
    fn digits_and_minus_have_one_width() {
        for c in "0123456789\u{2212}+".chars() {
            assert_eq!(advance(Face::Regular, c), advance(Face::Regular, '0'), "{c:?}");
        }
    }
}
