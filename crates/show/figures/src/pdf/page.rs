//! One page: what it draws, and what it needs for that.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use tiny_skia::{Color, Path, PathSegment, Pixmap, Point, Rect, Transform};

use super::file::{File, short};
use super::font::Used;
use crate::error::Result;
use crate::fonts::{Face, advance};
use crate::raster::element::refused;
use crate::raster::painter::{Canvas, Line, Sheet};
use crate::raster::shapes::Pen;

/// Points in a unit of SVG, 1/96 inch.
const POINTS: f64 = 0.75;

/// The faces, by their names in the page.
const FACES: [(Face, &str); 2] = [(Face::Regular, "F0"), (Face::Italic, "F1")];

pub(super) struct Page {
    /// Width and height in points.
    size: [f64; 2],
    content: String,
    fonts: [Used; 2],
    /// The opacities in use, in 255ths.
    opacities: BTreeSet<u8>,
    /// The pictures: columns, rows, and colours row by row.
    pictures: Vec<(u32, u32, Vec<u8>)>,
}

// `write!` into a String cannot fail, so its result is dropped below.
impl Page {
    /// An empty page, whose y points down from its upper edge.
    pub(super) fn new(sheet: &Sheet) -> Self {
        let Sheet { sides, shown } = sheet;
        let size = sides.map(|side| side * POINTS);
        let scale = (size[0] / shown[0]).min(size[1] / shown[1]);
        let content = format!("{0} 0 0 -{0} 0 {1} cm\n", short(scale), short(size[1]));
        Self { size, content, fonts: Default::default(), opacities: BTreeSet::new(), pictures: Vec::new() }
    }

    /// The file.
    pub(super) fn finish(self) -> Vec<u8> {
        let mut file = File::new();
        let content = file.stream("", self.content.as_bytes());
        let mut fonts = String::new();
        for ((face, name), used) in FACES.iter().zip(&self.fonts).filter(|(_, used)| !used.is_empty()) {
            let number = used.write(*face, &mut file);
            let _ = write!(fonts, "/{name} {number} 0 R ");
        }
        let mut pictures = String::new();
        for (place, (columns, rows, colours)) in self.pictures.iter().enumerate() {
            let entries = format!(
                "/Type /XObject /Subtype /Image /Width {columns} /Height {rows} /ColorSpace /DeviceRGB /BitsPerComponent 8 "
            );
            let number = file.stream(&entries, colours);
            let _ = write!(pictures, "/I{place} {number} 0 R ");
        }
        let opacity = |part: &u8| {
            let value = short((f64::from(*part) / 255.0 * 1000.0).round() / 1000.0);
            format!("/A{part} << /ca {value} /CA {value} >> ")
        };
        let opacities: String = self.opacities.iter().map(opacity).collect();
        let [w, h] = self.size.map(short);
        let pages = file.next() + 1;
        let page = file.object(&format!(
            "<< /Type /Page /Parent {pages} 0 R /MediaBox [0 0 {w} {h}] /Contents {content} 0 R /Resources << /Font << {fonts}>> \
             /XObject << {pictures}>> /ExtGState << {opacities}>> >> >>"
        ));
        let pages = file.object(&format!("<< /Type /Pages /Kids [{page} 0 R] /Count 1 >>"));
        let catalogue = file.object(&format!("<< /Type /Catalog /Pages {pages} 0 R >>"));
        file.finish(catalogue)
    }

    /// Draws with an opacity and a colour, which `paint` is the operator of.
    fn painted(&mut self, colour: Color, operator: &str, draw: impl FnOnce(&mut String)) {
        let part = colour.to_color_u8().alpha();
        let see_through = part < 255;
        if see_through {
            self.opacities.insert(part);
            let _ = writeln!(self.content, "q /A{part} gs");
        }
        let [red, green, blue] =
            [colour.red(), colour.green(), colour.blue()].map(|one| short(f64::from(one)));
        let _ = writeln!(self.content, "{red} {green} {blue} {operator}");
        draw(&mut self.content);
        if see_through {
            self.content.push_str("Q\n");
        }
    }
}

impl Canvas for Page {
    fn fill(&mut self, path: &Path, colour: Color) {
        self.painted(colour, "rg", |out| {
            outline(out, path);
            out.push_str("f\n");
        });
    }

    fn stroke(&mut self, path: &Path, pen: &Pen, colour: Color) {
        self.painted(colour, "RG", |out| {
            let dash: Vec<String> = pen.dash.iter().map(|length| short(f64::from(*length))).collect();
            let (width, cap) = (short(f64::from(pen.width)), u8::from(pen.round));
            let _ = writeln!(
                out,
                "{width} w {cap} J 1 j [{}] {} d",
                dash.join(" "),
                short(f64::from(pen.dash_from))
            );
            outline(out, path);
            out.push_str("S\n");
        });
    }

    fn image(&mut self, png: &[u8], place: Rect) -> Result<()> {
        let picture = Pixmap::decode_png(png).map_err(|_| refused("an image that is not a PNG"))?;
        // pictures of figures are opaque
        let colours = picture.pixels().iter().flat_map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]);
        let number = self.pictures.len();
        self.pictures.push((picture.width(), picture.height(), colours.collect()));
        let [x, y, w, h] =
            [place.x(), place.bottom(), place.width(), place.height()].map(|one| short(f64::from(one)));
        let _ = writeln!(self.content, "q {w} 0 0 -{h} {x} {y} cm /I{number} Do Q");
        Ok(())
    }

    fn clip(&mut self, rect: Rect) -> Result<()> {
        let [x, y, w, h] = [rect.x(), rect.y(), rect.width(), rect.height()].map(|one| short(f64::from(one)));
        let _ = writeln!(self.content, "q {x} {y} {w} {h} re W n");
        Ok(())
    }

    fn unclip(&mut self) {
        self.content.push_str("Q\n");
    }

    fn write(&mut self, line: &Line) {
        let wide = |face: Face, size: f32, text: &str| -> f64 {
            text.chars().map(|one| f64::from(size) * advance(face, one)).sum()
        };
        let width: f64 = line.runs.iter().map(|run| wide(run.face, run.size, &run.text)).sum();
        let (mut x, mut y) = (-f64::from(line.before) * width, 0.0);
        let mut text = String::from("BT\n");
        for run in &line.runs {
            y += run.lower;
            let place = usize::from(run.face == Face::Italic);
            let letters = self.fonts[place].letters(run.face, &run.text);
            let _ = writeln!(text, "/{} {} Tf", FACES[place].1, short(f64::from(run.size)));
            let _ =
                writeln!(text, "{} Tm {letters} TJ", matrix(line.place.pre_translate(x as f32, y as f32)));
            x += wide(run.face, run.size, &run.text);
        }
        text.push_str("ET\n");
        self.painted(line.colour, "rg", |out| out.push_str(&text));
    }
}

/// The matrix of letters, which stand upright where y points down.
fn matrix(place: Transform) -> String {
    let Transform { sx, kx, ky, sy, tx, ty } = place;
    [sx, ky, -kx, -sy, tx, ty].map(|one| short(f64::from(one))).join(" ")
}

/// A path.
fn outline(out: &mut String, path: &Path) {
    let mut at = Point::zero();
    for segment in path.segments() {
        let points: &[Point] = match &segment {
            PathSegment::MoveTo(to) | PathSegment::LineTo(to) => &[*to],
            PathSegment::QuadTo(by, to) => {
                // the same curve as a cubic one
                let third = |end: Point| {
                    Point::from_xy(end.x + (by.x - end.x) * 2.0 / 3.0, end.y + (by.y - end.y) * 2.0 / 3.0)
                };
                &[third(at), third(*to), *to]
            }
            PathSegment::CubicTo(a, b, to) => &[*a, *b, *to],
            PathSegment::Close => &[],
        };
        let numbers = points.iter().flat_map(|point| [point.x, point.y]).map(|one| short(f64::from(one)));
        let numbers: Vec<String> = numbers.collect();
        let operator = match segment {
            PathSegment::MoveTo(_) => "m",
            PathSegment::LineTo(_) => "l",
            PathSegment::QuadTo(..) | PathSegment::CubicTo(..) => "c",
            PathSegment::Close => "h",
        };
        let _ = writeln!(out, "{}{}{operator}", numbers.join(" "), if points.is_empty() { "" } else { " " });
        at = points.last().copied().unwrap_or(at);
    }
}
