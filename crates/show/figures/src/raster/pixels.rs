//! A sheet of pixels.

use tiny_skia::{Color, FillRule, FilterQuality, Mask, Paint, Path, PathBuilder, Pattern, Pixmap, Rect};
use tiny_skia::{LineCap, LineJoin, SpreadMode, Stroke, StrokeDash, Transform};

use super::element::refused;
use super::painter::{Canvas, Line, Sheet};
use super::shapes::Pen;
use crate::error::{FigureError, Result};
use crate::letters::Letters;

/// Most pixels of an image: 100 million.
const MOST_PIXELS: f64 = 1e8;

pub(super) struct Pixels {
    pub(super) pixmap: Pixmap,
    transform: Transform,
    /// The visible part within the open groups.
    masks: Vec<Mask>,
}

fn solid(colour: Color) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color(colour);
    paint
}

impl Pixels {
    /// A white sheet of `scale` pixels per unit.
    ///
    /// # Errors   too many pixels
    pub(super) fn new(sheet: &Sheet, scale: f64) -> Result<Self> {
        let Sheet { sides, shown } = sheet;
        let size = sides.map(|side| (side * scale).ceil());
        let value = size[0] * size[1];
        let pixels = FigureError::OutOfRange { what: "number of pixels", value, min: 1.0, max: MOST_PIXELS };
        let fits = (1.0..=MOST_PIXELS).contains(&value);
        let pixmap = Pixmap::new(size[0] as u32, size[1] as u32).filter(|_| fits);
        let mut pixmap = pixmap.ok_or(pixels)?;
        pixmap.fill(Color::WHITE); // the sheet may end inside the last row and column
        let scale = (scale * (sides[0] / shown[0]).min(sides[1] / shown[1])) as f32;
        Ok(Self { pixmap, transform: Transform::from_scale(scale, scale), masks: Vec::new() })
    }
}

impl Canvas for Pixels {
    fn fill(&mut self, path: &Path, colour: Color) {
        self.pixmap.fill_path(path, &solid(colour), FillRule::Winding, self.transform, self.masks.last());
    }

    fn stroke(&mut self, path: &Path, pen: &Pen, colour: Color) {
        let stroke = Stroke {
            width: pen.width,
            line_cap: if pen.round { LineCap::Round } else { LineCap::Butt },
            line_join: LineJoin::Round,
            dash: StrokeDash::new(pen.dash.clone(), pen.dash_from),
            ..Stroke::default()
        };
        self.pixmap.stroke_path(path, &solid(colour), &stroke, self.transform, self.masks.last());
    }

    fn image(&mut self, png: &[u8], place: Rect) -> Result<()> {
        let picture = Pixmap::decode_png(png).map_err(|_| refused("an image that is not a PNG"))?;
        let (w, h) = (place.width() / picture.width() as f32, place.height() / picture.height() as f32);
        let stretched = Transform::from_row(w, 0.0, 0.0, h, place.x(), place.y());
        let shader = Pattern::new(picture.as_ref(), SpreadMode::Pad, FilterQuality::Nearest, 1.0, stretched);
        let paint = Paint { shader, ..Paint::default() };
        self.pixmap.fill_rect(place, &paint, self.transform, self.masks.last());
        Ok(())
    }

    fn clip(&mut self, rect: Rect) -> Result<()> {
        let clip = PathBuilder::from_rect(rect);
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

    fn unclip(&mut self) {
        self.masks.pop();
    }

    fn write(&mut self, line: &Line) {
        let mut letters = Letters::default();
        for run in &line.runs {
            letters.lower(run.lower);
            letters.set(run.face, &run.text, f64::from(run.size));
        }
        let place = self.transform.pre_concat(line.place).pre_translate(-line.before * letters.width(), 0.0);
        if let Some(path) = letters.finish() {
            self.pixmap.fill_path(&path, &solid(line.colour), FillRule::Winding, place, self.masks.last());
        }
    }
}
