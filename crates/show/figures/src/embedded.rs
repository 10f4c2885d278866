//! Figures as parts of an HTML page, which has the fonts once.

use super::fonts;
use super::svg::escape;

/// The `@font-face` rules that a page with [`embedded`] figures needs, once: WOFF2 data within.
pub fn font_rules() -> &'static str {
    fonts::css()
}

/// The figure as an element of an HTML page: without its fonts ([`font_rules`] has them), with `prefix`
/// before each of its names, so that none clashes with that of another figure, and with `label`, plain text,
/// for those who cannot see it.
///
/// `svg` is a document as the figures of this crate make it.
pub fn embedded(svg: &str, prefix: &str, label: &str) -> String {
    let style = format!("<style>{}</style>\n", fonts::css());
    let prefix = escape(prefix);
    svg.replacen(&style, "", 1)
        .replacen(
            "<svg xmlns=\"http://www.w3.org/2000/svg\"",
            &format!("<svg role=\"img\" aria-label=\"{}\"", escape(label)),
            1,
        )
        .replace("<clipPath id=\"", &format!("<clipPath id=\"{prefix}-"))
        .replace("clip-path=\"url(#", &format!("clip-path=\"url(#{prefix}-"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Rect;
    use crate::svg::{Anchor, Svg};
    use crate::text::Label;

    #[test]
    fn an_embedded_figure_has_no_fonts_and_names_of_its_own() {
        let mut sheet = Svg::new(10.0, 10.0);
        let rect = Rect { x: 0.0, y: 0.0, w: 5.0, h: 5.0 };
        sheet.clipped(rect, |sheet| {
            sheet.text([1.0, 2.0], 10.0, Anchor::Start, &Label::parse("url(#i1) id=\"i1\""));
        });
        let alone = sheet.finish();
        let part = embedded(&alone, "f1-2", "a \"plot\"");
        assert!(alone.contains(font_rules()) && !part.contains("font-face") && !part.contains("<style"));
        assert!(part.starts_with("<svg role=\"img\" aria-label=\"a &quot;plot&quot;\" width="), "{part}");
        assert!(part.contains("<clipPath id=\"f1-2-i1\">") && part.contains("clip-path=\"url(#f1-2-i1)\""));
        assert!(part.contains(">url(#i1) id=&quot;i1&quot;<"), "words stay as they are");
    }
}
