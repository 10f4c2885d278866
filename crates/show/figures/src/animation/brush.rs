//! Strokes, fills and letters on a pixmap.

use tiny_skia::{Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, Transform};

use crate::geometry::Point;
use crate::letters::Letters;
use crate::palette::{Colour, INK};
use crate::text::Label;

/// Strokes a polyline, or a polygon if `closed`; fewer than two points draw nothing.
pub(super) fn stroke(pixmap: &mut Pixmap, points: &[Point], closed: bool, colour: Colour, width: f32) {
    let style = Stroke { width, line_cap: LineCap::Round, line_join: LineJoin::Round, ..Stroke::default() };
    if let Some(path) = path_of(points, closed) {
        pixmap.stroke_path(&path, &paint(colour, 1.0), &style, Transform::identity(), None);
    }
}

/// Fills a closed polygon; fewer than two points draw nothing.
pub(super) fn fill(pixmap: &mut Pixmap, points: &[Point], colour: Colour, opacity: f32) {
    if let Some(path) = path_of(points, true) {
        fill_path(pixmap, &path, colour, opacity);
    }
}

/// Fills a disc.
pub(super) fn disc(pixmap: &mut Pixmap, [x, y]: Point, radius: f32, colour: Colour) {
    if let Some(path) = PathBuilder::from_circle(x as f32, y as f32, radius) {
        fill_path(pixmap, &path, colour, 1.0);
    }
}

/// Writes a label with its baseline starting at `at`.
pub(super) fn write(pixmap: &mut Pixmap, label: &Label, at: Point, size: f64) {
    let place = Transform::from_translate(at[0] as f32, at[1] as f32);
    write_turned(pixmap, label, place, size);
}

/// Writes a label whose baseline starts at the origin of `place`, along its x axis.
pub(super) fn write_turned(pixmap: &mut Pixmap, label: &Label, place: Transform, size: f64) {
    if let Some(path) = letters(label, size) {
        pixmap.fill_path(&path, &paint(INK, 1.0), FillRule::Winding, place, None);
    }
}

/// The outlines of a label, its baseline starting at the origin.
fn letters(label: &Label, size: f64) -> Option<Path> {
    let (mut letters, mut drop) = (Letters::default(), 0.0);
    for run in label.runs() {
        letters.lower(size * (run.script.drop() - drop));
        drop = run.script.drop();
        letters.set(run.face, &run.text, size * run.script.scale());
    }
    letters.finish()
}

fn fill_path(pixmap: &mut Pixmap, path: &Path, colour: Colour, opacity: f32) {
    pixmap.fill_path(path, &paint(colour, opacity), FillRule::Winding, Transform::identity(), None);
}

fn paint(Colour(r, g, b): Colour, opacity: f32) -> Paint<'static> {
    let mut paint = Paint::default();
    let mut colour = Color::from_rgba8(r, g, b, 255);
    colour.set_alpha(opacity);
    paint.set_color(colour);
    paint
}

fn path_of(points: &[Point], closed: bool) -> Option<Path> {
    let (first, rest) = points.split_first()?;
    let mut builder = PathBuilder::new();
    builder.move_to(first[0] as f32, first[1] as f32);
    for [x, y] in rest {
        builder.line_to(*x as f32, *y as f32);
    }
    if closed {
        builder.close();
    }
    builder.finish()
}
