//! A small writer of SVG: shapes and labels in pixels, rounded to 0.01, always the same bytes.

use std::fmt::{self, Display, Write as _};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD as BASE64;

use super::fonts::{self, Face};
use super::geometry::{Point, Rect};
use super::paint::Paint;
use super::palette::INK;
use super::room::Room;
use super::text::Label;

/// A number rounded to 0.01, without trailing zeros and without "-0".
#[derive(Debug, Clone, Copy)]
pub struct Num(pub f64);

impl Display for Num {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let cents = (self.0 * 100.0).round() as i64; // saturates; figures refuse what is not finite
        let (whole, cents, sign) = (cents.abs() / 100, cents.abs() % 100, if cents < 0 { "-" } else { "" });
        match cents {
            0 => write!(f, "{sign}{whole}"),
            c if c % 10 == 0 => write!(f, "{sign}{whole}.{}", c / 10),
            c => write!(f, "{sign}{whole}.{c:02}"),
        }
    }
}

/// `text` with the characters that XML reserves replaced; control characters are dropped.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => {}
            c => out.push(c),
        }
    }
    out
}

/// The point of a label that is put at the given place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// Its left end.
    Start,
    /// Its middle.
    Middle,
    /// Its right end.
    End,
}

/// An SVG document under construction; y points down, the unit is the pixel.
#[derive(Debug)]
pub struct Svg {
    width: f64,
    height: f64,
    /// The place of its upper left corner on a larger sheet.
    corner: Point,
    /// The box around the frames of its axes.
    frame: Option<Rect>,
    body: String,
    ids: u32,
}

// `write!` into a String cannot fail, so its result is dropped below.
impl Svg {
    /// An empty white sheet.
    pub fn new(width: f64, height: f64) -> Self {
        Self::in_room(Room::OWN, width, height)
    }

    /// An empty sheet that lies where its room does.
    pub(crate) fn in_room(room: Room, width: f64, height: f64) -> Self {
        Self { width, height, corner: room.corner(), frame: None, body: String::new(), ids: room.ids() }
    }

    /// Width and height.
    pub(crate) fn size(&self) -> [f64; 2] {
        [self.width, self.height]
    }

    /// Remembers the frame of axes.
    pub(crate) fn frame(&mut self, own: Rect) {
        self.frame = Some(self.frame.map_or(own, |other| {
            let (x, y) = (own.x.min(other.x), own.y.min(other.y));
            let (right, bottom) = (own.right().max(other.right()), own.bottom().max(other.bottom()));
            Rect { x, y, w: right - x, h: bottom - y }
        }));
    }

    /// The box around the frames of all axes; the whole sheet if there are none.
    pub(crate) fn framed(&self) -> Rect {
        self.frame.unwrap_or(Rect { x: 0.0, y: 0.0, w: self.width, h: self.height })
    }

    /// Puts another sheet onto this one, where its room said.
    pub(crate) fn include(&mut self, other: &Self) {
        self.body += &other.body;
    }

    fn place(&self, at: Point) -> [Num; 2] {
        [Num(at[0] + self.corner[0]), Num(at[1] + self.corner[1])]
    }

    fn boxed(&self, Rect { x, y, w, h }: Rect) -> Box {
        Box(Rect { x: x + self.corner[0], y: y + self.corner[1], w, h })
    }

    /// A polyline, or a polygon if `closed`. Fewer than two points draw nothing.
    pub fn polyline(&mut self, points: &[Point], closed: bool, paint: &Paint) {
        if points.len() < 2 {
            return;
        }
        self.body.push_str("<path d=\"");
        for (i, p) in points.iter().enumerate() {
            let command = if i == 0 { 'M' } else { 'L' };
            let [x, y] = self.place(*p);
            let _ = write!(self.body, "{command}{x} {y}");
        }
        let _ = writeln!(self.body, "{}\"{paint}/>", if closed { "Z" } else { "" });
    }

    /// A straight line.
    pub fn line(&mut self, from: Point, to: Point, paint: &Paint) {
        self.polyline(&[from, to], false, paint);
    }

    /// Several separate straight lines as one shape.
    pub fn lines(&mut self, lines: &[[Point; 2]], paint: &Paint) {
        if lines.is_empty() {
            return;
        }
        self.body.push_str("<path d=\"");
        for [a, b] in lines {
            let ([x, y], [u, v]) = (self.place(*a), self.place(*b));
            let _ = write!(self.body, "M{x} {y}L{u} {v}");
        }
        let _ = writeln!(self.body, "\"{paint}/>");
    }

    /// A disc or circle.
    pub fn circle(&mut self, centre: Point, radius: f64, paint: &Paint) {
        let [x, y] = self.place(centre);
        let _ = writeln!(self.body, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{}\"{paint}/>", Num(radius));
    }

    /// An upright rectangle.
    pub fn rect(&mut self, rect: Rect, paint: &Paint) {
        let place = self.boxed(rect);
        let _ = writeln!(self.body, "<rect {place}{paint}/>");
    }

    /// A PNG picture stretched over a rectangle, its pixels as sharp boxes.
    pub fn image(&mut self, rect: Rect, png: &[u8]) {
        let (data, place) = (BASE64.encode(png), self.boxed(rect));
        let _ = writeln!(
            self.body,
            "<image {place} preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" \
             href=\"data:image/png;base64,{data}\"/>"
        );
    }

    /// Draws with everything outside `rect` cut off.
    pub fn clipped(&mut self, rect: Rect, draw: impl FnOnce(&mut Self)) {
        let (id, place) = (self.id(), self.boxed(rect));
        let _ = write!(self.body, "<clipPath id=\"i{id}\"><rect {place}/></clipPath>");
        let _ = writeln!(self.body, "<g clip-path=\"url(#i{id})\">");
        draw(self);
        self.body.push_str("</g>\n");
    }

    /// A label with its baseline at `at`; `size` in pixels.
    pub fn text(&mut self, at: Point, size: f64, anchor: Anchor, label: &Label) {
        let [x, y] = self.place(at);
        self.write_text(&format!("x=\"{x}\" y=\"{y}\""), size, anchor, label);
    }

    /// A label that reads upward, baseline at `at`.
    pub fn upward_text(&mut self, at: Point, size: f64, anchor: Anchor, label: &Label) {
        let [x, y] = self.place(at);
        self.write_text(&format!("transform=\"translate({x} {y}) rotate(-90)\""), size, anchor, label);
    }

    fn write_text(&mut self, place: &str, size: f64, anchor: Anchor, label: &Label) {
        let anchor = match anchor {
            Anchor::Start => "",
            Anchor::Middle => " text-anchor=\"middle\"",
            Anchor::End => " text-anchor=\"end\"",
        };
        let _ = write!(self.body, "<text {place} font-size=\"{}\"{anchor} fill=\"{INK}\">", Num(size));
        let mut drop = 0.0;
        for run in label.runs() {
            self.body.push_str("<tspan");
            if run.face == Face::Italic {
                self.body.push_str(" font-style=\"italic\"");
            }
            if run.script.scale() < 1.0 {
                let _ = write!(self.body, " font-size=\"{}\"", Num(size * run.script.scale()));
            }
            if run.script.drop() != drop {
                let _ = write!(self.body, " dy=\"{}\"", Num(size * (run.script.drop() - drop)));
                drop = run.script.drop();
            }
            let _ = write!(self.body, ">{}</tspan>", escape(&run.text));
        }
        self.body.push_str("</text>\n");
    }

    fn id(&mut self) -> u32 {
        self.ids += 1;
        self.ids
    }

    /// The document. It stands alone: the fonts are inside.
    pub fn finish(self) -> String {
        let (w, h) = (Num(self.width), Num(self.height));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" viewBox=\"0 0 {w} {h}\" \
             font-family=\"{}\" xml:space=\"preserve\">\n<style>{}</style>\n\
             <rect width=\"{w}\" height=\"{h}\" fill=\"#fff\"/>\n{}</svg>\n",
            fonts::FAMILY,
            fonts::css(),
            self.body
        )
    }
}

/// A rectangle as attributes.
struct Box(Rect);

impl Display for Box {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Rect { x, y, w, h } = self.0;
        write!(f, "x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"", Num(x), Num(y), Num(w), Num(h))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let all = [0.0, -0.001, 1.5, -2.25, 3.999, 12.0, -0.05].map(|x| Num(x).to_string());
        assert_eq!(all, ["0", "0", "1.5", "-2.25", "4", "12", "-0.05"]);
    }

    #[test]
    fn reserved_characters_are_escaped() {
        assert_eq!(escape("a<b & \"c\" > 'd'\u{1}"), "a&lt;b &amp; &quot;c&quot; &gt; &#39;d&#39;");
    }
}
