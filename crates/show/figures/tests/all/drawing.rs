//! Drawings as text: their words with the room these take, and their colours.

use motiform_figures::{Label, literal};

/// The text of the document without its fonts.
pub(crate) fn drawing(svg: &str) -> &str {
    svg.split_once("</style>").map_or("", |(_, drawing)| drawing)
}

/// Width and height of a sheet in units of its drawing.
pub(crate) fn sides(svg: &str) -> [f64; 2] {
    let view = svg.split("viewBox=\"0 0 ").nth(1).and_then(|rest| rest.split('"').next()).expect("a view");
    let (width, height) = view.split_once(' ').expect("sides");
    [width, height].map(|side| side.parse().expect("a number"))
}

/// The value of an attribute of a tag.
pub(crate) fn attribute<'t>(tag: &'t str, name: &str) -> Option<&'t str> {
    tag.split(&format!(" {name}=\"")).nth(1)?.split('"').next()
}

fn number(tag: &str, name: &str) -> Option<f64> {
    attribute(tag, name)?.parse().ok()
}

/// A line of text on a sheet.
#[derive(Debug)]
pub(crate) struct Words {
    pub(crate) text: String,
    /// Left, top, right and bottom.
    pub(crate) sides: [f64; 4],
    /// Size of its letters and of the smallest of them, in units of the drawing.
    pub(crate) size: f64,
    pub(crate) least: f64,
}

/// All lines of text.
pub(crate) fn words(svg: &str) -> Vec<Words> {
    let elements = svg.split("<text").skip(1).map(|rest| rest.split("</text>").next().unwrap_or(rest));
    elements.map(element).collect()
}

fn element(text: &str) -> Words {
    let (tag, runs) = text.split_once('>').expect("a tag");
    let size = number(tag, "font-size").expect("a size");
    let (mut width, mut least, mut plain) = (0.0, size, String::new());
    for run in runs.split("<tspan").skip(1) {
        let (tag, rest) = run.split_once('>').expect("a tag");
        let characters = unescaped(rest.split("</tspan>").next().unwrap_or(rest));
        let own = number(tag, "font-size").unwrap_or(size);
        let slant = if tag.contains("italic") { "*" } else { "" };
        width += Label::parse(&format!("{slant}{}{slant}", literal(&characters))).width(own);
        least = f64::min(least, own);
        plain += &characters;
    }
    let before = match attribute(tag, "text-anchor") {
        Some("middle") => 0.5 * width,
        Some("end") => width,
        _ => 0.0,
    };
    let (up, down) = (0.72 * size, 0.2 * size);
    let sides = match tag.split("translate(").nth(1).and_then(|rest| rest.split(')').next()) {
        Some(place) => {
            let (x, y) = place.split_once(' ').expect("a place");
            let [x, y]: [f64; 2] = [x, y].map(|side| side.parse().expect("a number"));
            [x - up, y + before - width, x + down, y + before]
        }
        None => {
            let [x, y] = [number(tag, "x").expect("x"), number(tag, "y").expect("y")];
            [x - before, y - up, x - before + width, y + down]
        }
    };
    Words { text: plain, sides, size, least }
}

fn unescaped(text: &str) -> String {
    let marks = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&#39;", "'"), ("&amp;", "&")];
    marks.into_iter().fold(text.to_owned(), |text, (from, to)| text.replace(from, to))
}

impl Words {
    /// The area that both take, more than a unit wide and high.
    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        let [left, top] = [0, 1].map(|i| f64::max(self.sides[i], other.sides[i]));
        let [right, bottom] = [2, 3].map(|i| f64::min(self.sides[i], other.sides[i]));
        right - left > 1.0 && bottom - top > 1.0
    }
}

/// The colours of fills and lines, each once.
pub(crate) fn colours(svg: &str) -> Vec<[u8; 3]> {
    let mut all: Vec<[u8; 3]> = Vec::new();
    for name in ["fill", "stroke"] {
        for rest in svg.split(&format!(" {name}=\"#")).skip(1) {
            let Some(text) = rest.get(..6).filter(|_| rest.get(6..7) == Some("\"")) else { continue };
            let part = |i: usize| u8::from_str_radix(&text[2 * i..2 * i + 2], 16).expect("a colour");
            all.push([part(0), part(1), part(2)]);
        }
    }
    all.sort_unstable();
    all.dedup();
    all
}
