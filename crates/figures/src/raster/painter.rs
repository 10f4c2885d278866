//! A document onto pixels.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use std::collections::HashMap;
use tiny_skia::{Color, FillRule, FilterQuality, Mask, Paint, Path, PathBuilder, Pattern, Pixmap, Rect};
use tiny_skia::{SpreadMode, Transform};

use super::element::{Element, Piece, number, pieces, refused};
use super::shapes::{colour, path, rect, stroke};
use crate::error::{FigureError, Result};
use crate::fonts::Face;
use crate::letters::Letters;

/// Most pixels of an image: 100 million.
const MOST_PIXELS: f64 = 1e8;

/// The pixels of an SVG as this crate writes it.
///
/// # Errors   no such document, or too many pixels
pub(super) fn paint(svg: &str, scale: f64) -> Result<Pixmap> {
    let mut painter: Option<Painter> = None;
    pieces(svg, |piece| match (&mut painter, piece) {
        (None, Piece::Open(root)) if root.name == "svg" => {
            painter = Some(Painter::new(&root, scale)?);
            Ok(())
        }
        (None, Piece::Open(root)) => Err(refused(format!("<{}> where <svg> should be", root.name))),
        (Some(painter), Piece::Open(element)) => painter.open(&element),
        (Some(painter), Piece::Text(text)) => {
            painter.text(&text);
            Ok(())
        }
        (Some(painter), Piece::Close(name)) => {
            painter.close(&name);
            Ok(())
        }
        _ => Ok(()),
    })?;
    painter.map(|painter| painter.pixmap).ok_or_else(|| refused("there is no <svg>"))
}

struct Painter {
    pixmap: Pixmap,
    transform: Transform,
    clips: HashMap<String, Rect>,
    /// The clip that is being defined.
    defines: Option<String>,
    /// What is seen within the open groups.
    masks: Vec<Mask>,
    line: Option<Line>,
}

/// A line of text on its way.
struct Line {
    letters: Letters,
    place: Transform,
    /// The share of its width that is before its place.
    before: f32,
    size: f32,
    colour: Color,
    /// Face and size of the open run.
    run: Option<(Face, f32)>,
}

fn solid(colour: Color) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color(colour);
    paint
}

impl Painter {
    fn new(root: &Element, scale: f64) -> Result<Self> {
        let sides = [length(root.need("width")?)?, length(root.need("height")?)?];
        let shown = seen(root.need("viewBox")?)?;
        let size = sides.map(|side| (side * scale).ceil());
        let value = size[0] * size[1];
        let pixels = FigureError::OutOfRange { what: "number of pixels", value, min: 1.0, max: MOST_PIXELS };
        let fits = (1.0..=MOST_PIXELS).contains(&value);
        let pixmap = Pixmap::new(size[0] as u32, size[1] as u32).filter(|_| fits);
        let mut pixmap = pixmap.ok_or(pixels)?;
        pixmap.fill(Color::WHITE); // the sheet may end inside the last row and column
        let scale = (scale * (sides[0] / shown[0]).min(sides[1] / shown[1])) as f32;
        let transform = Transform::from_scale(scale, scale);
        Ok(Self { pixmap, transform, clips: HashMap::new(), defines: None, masks: Vec::new(), line: None })
    }

    fn open(&mut self, element: &Element) -> Result<()> {
        match element.name.as_str() {
            "rect" => self.rect(element)?,
            "path" => {
                if let Some(path) = path(element.need("d")?)? {
                    self.shape(element, &path)?;
                }
            }
            "circle" => {
                let [x, y, radius] = element.numbers(["cx", "cy", "r"])?;
                if let Some(path) = PathBuilder::from_circle(x, y, radius) {
                    self.shape(element, &path)?;
                }
            }
            "image" => self.image(element)?,
            "clipPath" => self.defines = Some(element.need("id")?.to_owned()),
            "g" => self.group(element)?,
            "text" => self.line = Some(Line::new(element)?),
            "tspan" => self.line.as_mut().map_or(Ok(()), |line| line.run(element))?,
            "style" => {}
            other => return Err(refused(format!("an element <{other}>"))),
        }
        Ok(())
    }

    fn text(&mut self, text: &str) {
        if let Some(line) = &mut self.line
            && let Some((face, size)) = line.run
        {
            line.letters.set(face, text, f64::from(size));
        }
    }

    fn close(&mut self, name: &str) {
        match name {
            "clipPath" => self.defines = None,
            "g" => drop(self.masks.pop()),
            "tspan" => self.line.iter_mut().for_each(|line| line.run = None),
            "text" => self.write(),
            _ => {}
        }
    }

    fn rect(&mut self, element: &Element) -> Result<()> {
        let Some(rect) = rect(element)? else { return Ok(()) };
        match &self.defines {
            Some(id) => drop(self.clips.insert(id.clone(), rect)),
            None => self.shape(element, &PathBuilder::from_rect(rect))?,
        }
        Ok(())
    }

    fn shape(&mut self, element: &Element, path: &Path) -> Result<()> {
        let mask = self.masks.last();
        if let Some(colour) = colour(element, "fill")? {
            self.pixmap.fill_path(path, &solid(colour), FillRule::Winding, self.transform, mask);
        }
        if let Some(colour) = colour(element, "stroke")? {
            self.pixmap.stroke_path(path, &solid(colour), &stroke(element)?, self.transform, mask);
        }
        Ok(())
    }

    /// A picture stretched over its rectangle, its pixels as sharp boxes.
    fn image(&mut self, element: &Element) -> Result<()> {
        let data = element.need("href")?.strip_prefix("data:image/png;base64,");
        let data = data.and_then(|data| STANDARD.decode(data).ok());
        let picture = data.and_then(|data| Pixmap::decode_png(&data).ok());
        let picture = picture.ok_or_else(|| refused("an image that is not a PNG"))?;
        let Some(place) = rect(element)? else { return Ok(()) };
        let (w, h) = (place.width() / picture.width() as f32, place.height() / picture.height() as f32);
        let stretched = Transform::from_row(w, 0.0, 0.0, h, place.x(), place.y());
        let shader = Pattern::new(picture.as_ref(), SpreadMode::Pad, FilterQuality::Nearest, 1.0, stretched);
        let paint = Paint { shader, ..Paint::default() };
        self.pixmap.fill_rect(place, &paint, self.transform, self.masks.last());
        Ok(())
    }

    /// Begins a group of which only what is in its clip is seen.
    fn group(&mut self, element: &Element) -> Result<()> {
        let name = element.need("clip-path")?.strip_prefix("url(#").and_then(|name| name.strip_suffix(')'));
        let clip = name.and_then(|name| self.clips.get(name));
        let clip = PathBuilder::from_rect(*clip.ok_or_else(|| refused("a group with an unknown clip"))?);
        let mask = match self.masks.last() {
            Some(outer) => {
                let mut mask = outer.clone();
                mask.intersect_path(&clip, FillRule::Winding, true, self.transform);
                mask
            }
            None => {
                let mask = Mask::new(self.pixmap.width(), self.pixmap.height());
                let mut mask = mask.ok_or_else(|| refused("a sheet without pixels"))?;
                mask.fill_path(&clip, FillRule::Winding, true, self.transform);
                mask
            }
        };
        self.masks.push(mask);
        Ok(())
    }

    /// Writes the line that has ended.
    fn write(&mut self) {
        let Some(Line { letters, place, before, colour, .. }) = self.line.take() else { return };
        let place = self.transform.pre_concat(place).pre_translate(-before * letters.width(), 0.0);
        if let Some(path) = letters.finish() {
            self.pixmap.fill_path(&path, &solid(colour), FillRule::Winding, place, self.masks.last());
        }
    }
}

impl Line {
    fn new(element: &Element) -> Result<Self> {
        let place = match element.get("transform") {
            Some(turned) => upward(turned)?,
            None => {
                let [x, y] = element.numbers(["x", "y"])?;
                Transform::from_translate(x, y)
            }
        };
        let before = match element.get("text-anchor") {
            Some("middle") => 0.5,
            Some("end") => 1.0,
            _ => 0.0,
        };
        let [size] = element.numbers(["font-size"])?;
        let colour = colour(element, "fill")?.unwrap_or(Color::BLACK);
        Ok(Self { letters: Letters::default(), place, before, size, colour, run: None })
    }

    /// Begins a run of equal letters.
    fn run(&mut self, element: &Element) -> Result<()> {
        let face = if element.get("font-style") == Some("italic") { Face::Italic } else { Face::Regular };
        self.letters.lower(f64::from(element.number("dy")?.unwrap_or(0.0)));
        self.run = Some((face, element.number("font-size")?.unwrap_or(self.size)));
        Ok(())
    }
}

/// A length in units of SVG, 1/96 inch.
fn length(text: &str) -> Result<f64> {
    Ok(match text.strip_suffix("mm") {
        Some(millimetres) => f64::from(number(millimetres)?) * 96.0 / 25.4,
        None => f64::from(number(text)?),
    })
}

/// Width and height of the part of the plane that a sheet shows: `0 0 WIDTH HEIGHT`.
fn seen(text: &str) -> Result<[f64; 2]> {
    let sides = text.strip_prefix("0 0 ").and_then(|sides| sides.split_once(' '));
    let (width, height) = sides.ok_or_else(|| refused(format!("a sheet that shows {text:?}")))?;
    Ok([f64::from(number(width)?), f64::from(number(height)?)])
}

/// The transform of a line that reads upward: `translate(x y) rotate(-90)`.
fn upward(text: &str) -> Result<Transform> {
    let place = text.strip_prefix("translate(").and_then(|rest| rest.strip_suffix(") rotate(-90)"));
    let (x, y) = place.and_then(|place| place.split_once(' ')).ok_or_else(|| refused("another transform"))?;
    Ok(Transform::from_translate(number(x)?, number(y)?).pre_rotate(-90.0))
}
