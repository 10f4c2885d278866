//! A document, element by element, onto a canvas.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use std::collections::HashMap;
use tiny_skia::{Color, Path, PathBuilder, Rect, Transform};

use super::element::{Element, Piece, number, pieces, refused};
use super::shapes::{Pen, colour, path, pen, rect};
use crate::error::Result;
use crate::fonts::Face;

/// The surface that a document is drawn on: pixels, or the page of a file.
pub(crate) trait Canvas {
    /// Fills a path.
    fn fill(&mut self, path: &Path, colour: Color);

    /// Draws a path as a line.
    fn stroke(&mut self, path: &Path, pen: &Pen, colour: Color);

    /// A picture stretched over a rectangle, its pixels as sharp boxes.
    fn image(&mut self, png: &[u8], place: Rect) -> Result<()>;

    /// From now on only what is in a rectangle is seen, too.
    fn clip(&mut self, rect: Rect) -> Result<()>;

    /// Undoes the last clip.
    fn unclip(&mut self);

    /// A line of text.
    fn write(&mut self, line: &Line);
}

/// The size of a document in units of SVG (1/96 inch), and the part of the plane that it shows.
pub(crate) struct Sheet {
    pub(crate) sides: [f64; 2],
    pub(crate) shown: [f64; 2],
}

/// A line of text.
pub(crate) struct Line {
    /// The place of its anchor, and its rotation.
    pub(crate) place: Transform,
    /// The share of its width that is before its place.
    pub(crate) before: f32,
    /// Its colour.
    pub(crate) colour: Color,
    /// Its letters.
    pub(crate) runs: Vec<Run>,
    size: f32,
    open: bool,
}

/// Letters of a line that are set alike.
pub(crate) struct Run {
    pub(crate) face: Face,
    pub(crate) size: f32,
    /// The displacement of the baseline below that of the run before.
    pub(crate) lower: f64,
    pub(crate) text: String,
}

/// Draws an SVG, as this crate writes it, on the canvas that `begin` gives for its size.
///
/// # Errors   no such document, and those of the canvas
pub(crate) fn paint<C: Canvas>(svg: &str, begin: impl Fn(&Sheet) -> Result<C>) -> Result<C> {
    let mut painter: Option<Painter<C>> = None;
    pieces(svg, |piece| match (&mut painter, piece) {
        (None, Piece::Open(root)) if root.name == "svg" => {
            let sides = [length(root.need("width")?)?, length(root.need("height")?)?];
            let canvas = begin(&Sheet { sides, shown: seen(root.need("viewBox")?)? })?;
            painter = Some(Painter { canvas, clips: HashMap::new(), defines: None, line: None });
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
    painter.map(|painter| painter.canvas).ok_or_else(|| refused("there is no <svg>"))
}

struct Painter<C> {
    canvas: C,
    clips: HashMap<String, Rect>,
    /// The clip that is being defined.
    defines: Option<String>,
    line: Option<Line>,
}

impl<C: Canvas> Painter<C> {
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
        if let Some(line) = self.line.as_mut().filter(|line| line.open)
            && let Some(run) = line.runs.last_mut()
        {
            run.text += text;
        }
    }

    fn close(&mut self, name: &str) {
        match name {
            "clipPath" => self.defines = None,
            "g" => self.canvas.unclip(),
            "tspan" => self.line.iter_mut().for_each(|line| line.open = false),
            "text" => self.line.take().iter().for_each(|line| self.canvas.write(line)),
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
        if let Some(colour) = colour(element, "fill")? {
            self.canvas.fill(path, colour);
        }
        if let Some(colour) = colour(element, "stroke")? {
            self.canvas.stroke(path, &pen(element)?, colour);
        }
        Ok(())
    }

    fn image(&mut self, element: &Element) -> Result<()> {
        let data = element.need("href")?.strip_prefix("data:image/png;base64,");
        let data = data.and_then(|data| STANDARD.decode(data).ok());
        let png = data.ok_or_else(|| refused("an image that is not a PNG"))?;
        rect(element)?.map_or(Ok(()), |place| self.canvas.image(&png, place))
    }

    /// Begins a group of which only what is in its clip is seen.
    fn group(&mut self, element: &Element) -> Result<()> {
        let name = element.need("clip-path")?.strip_prefix("url(#").and_then(|name| name.strip_suffix(')'));
        let clip = name.and_then(|name| self.clips.get(name));
        self.canvas.clip(*clip.ok_or_else(|| refused("a group with an unknown clip"))?)
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
        Ok(Self { place, before, colour, runs: Vec::new(), size, open: false })
    }

    /// Begins a run of equal letters.
    fn run(&mut self, element: &Element) -> Result<()> {
        let face = if element.get("font-style") == Some("italic") { Face::Italic } else { Face::Regular };
        let lower = f64::from(element.number("dy")?.unwrap_or(0.0));
        let size = element.number("font-size")?.unwrap_or(self.size);
        self.runs.push(Run { face, size, lower, text: String::new() });
        self.open = true;
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
