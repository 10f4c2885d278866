//! SVG to PDF: vectors, and text that can be selected and searched, with the two fonts inside.

mod file;
mod font;
mod page;

use super::error::Result;
use super::raster::painter::paint;
use page::Page;

/// As [`crate::pdf()`].
pub(crate) fn pdf(svg: &str) -> Result<Vec<u8>> {
    Ok(paint(svg, |sheet| Ok(Page::new(sheet)))?.finish())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Rect;
    use crate::paint::Paint;
    use crate::palette::BLACK;
    use crate::svg::{Anchor, Svg};
    use crate::text::Label;
    use flate2::read::ZlibDecoder;
    use std::io::Read;

    fn find(bytes: &[u8], what: &str) -> Option<usize> {
        bytes.windows(what.len()).position(|window| window == what.as_bytes())
    }

    /// The drawing of the page: its first stream.
    fn content(file: &[u8]) -> String {
        let from = find(file, "stream\n").expect("a stream") + "stream\n".len();
        let mut text = String::new();
        ZlibDecoder::new(&file[from..]).read_to_string(&mut text).expect("a deflated stream");
        text
    }

    fn sheet() -> String {
        let mut svg = Svg::new(400.0, 300.0);
        let frame = Rect { x: 10.0, y: 20.0, w: 100.0, h: 50.0 };
        svg.clipped(frame, |svg| svg.rect(frame, &Paint::fill(BLACK).opacity(0.5)));
        svg.line([0.0, 0.0], [100.0, 100.0], &Paint::stroke(BLACK, 1.0).dashed("3 2"));
        svg.text([50.0, 60.0], 12.0, Anchor::Start, &Label::parse("*κ*_2 = -0.5"));
        svg.finish()
    }

    /// Every object lies where the table at the end says.
    #[test]
    fn the_table_of_objects_leads_to_each() {
        let file = pdf(&sheet()).expect("a file");
        assert!(file.starts_with(b"%PDF-1.") && file.ends_with(b"%%EOF\n"));
        let at = find(&file, "startxref\n").expect("a table") + "startxref\n".len();
        let tail = String::from_utf8_lossy(&file[at..]).into_owned();
        let table: usize = tail.lines().next().and_then(|line| line.parse().ok()).expect("a place");
        let text = String::from_utf8_lossy(&file[table..]).into_owned();
        let places: Vec<usize> = text
            .lines()
            .filter(|line| line.ends_with(" 00000 n "))
            .map(|line| line[..10].parse().expect("a place"))
            .collect();
        assert!(places.len() > 8, "{text}");
        for (number, place) in (1..).zip(places) {
            assert!(file[place..].starts_with(format!("{number} 0 obj\n").as_bytes()), "{number}");
        }
    }

    #[test]
    fn a_page_has_the_size_of_the_sheet_in_points() {
        let file = pdf(&sheet()).expect("a file");
        assert!(find(&file, "/MediaBox [0 0 300 225]").is_some());
        let wide = sheet().replacen("width=\"400\" height=\"300\"", "width=\"86mm\" height=\"64.5mm\"", 1);
        // 86 mm are 243.78 pt
        assert!(find(&pdf(&wide).expect("a file"), "/MediaBox [0 0 243.7795 182.8346]").is_some());
    }

    #[test]
    fn shapes_and_letters_are_drawn_where_they_are() {
        let file = pdf(&sheet()).expect("a file");
        let page = content(&file);
        assert!(page.starts_with("0.75 0 0 -0.75 0 225 cm\n"), "{page}");
        assert!(page.contains("q 10 20 100 50 re W n"), "{page}");
        assert!(
            page.contains("/A128 gs") && find(&file, "/A128 << /ca 0.502 /CA 0.502 >>").is_some(),
            "{page}"
        );
        assert!(page.contains("[3 2] 0 d") && page.contains("0 0 m\n100 100 l\n"), "{page}");
        // the baseline of the first letter, upright though y points down
        assert!(page.contains("/F1 12 Tf\n1 0 0 -1 50 60 Tm"), "{page}");
        assert!(find(&file, "/ToUnicode").is_some() && find(&file, "/FontFile2").is_some());
    }

    #[test]
    fn what_is_no_figure_is_refused() {
        assert!(pdf("no svg").is_err());
        let picture = "<svg width=\"9\" height=\"9\" viewBox=\"0 0 9 9\"><image x=\"0\" y=\"0\" width=\"1\" height=\"1\" \
                       href=\"data:image/png;base64,AAAA\"/></svg>";
        assert!(pdf(picture).expect_err("no picture").to_string().contains("PNG"));
    }
}
