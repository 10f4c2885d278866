//! Paints the pictures of a film.

use tiny_skia::Pixmap;

use super::brush::{disc, fill, stroke, write};
use super::camera::{HEAD, View};
use super::colours::{BODY, EDGE, TRAIL};
use super::{Animation, Frame};
use crate::error::Result;
use crate::geometry::Point;
use crate::palette::{INK, PALE};
use crate::path::PathPoint;
use crate::simplify::simplify;
use crate::text::Label;

/// Font size of the time, in pixels.
const TIME_SIZE: f64 = 15.0;

/// Font size of the note, in pixels.
const NOTE_SIZE: f64 = 12.0;

/// The canvas between two pictures.
pub(super) struct Stage {
    view: View,
    /// Ground, with the trail so far if the camera is fixed.
    ground: Pixmap,
    screen: Pixmap,
    trail: Vec<PathPoint>,
    /// Trail points already passed.
    passed: usize,
    decimals: usize,
}

impl Stage {
    /// Sets the stage.
    pub(super) fn new(film: &Animation) -> Result<Self> {
        let view = View::of(film)?;
        let mut ground = view.ground.clone();
        let note = Label::parse(&film.note);
        let start = view.scale.frame.right() - note.width(NOTE_SIZE);
        write(&mut ground, &note, [start, HEAD - 10.0], NOTE_SIZE);
        let decimals = (-film.time_step().log10()).ceil().clamp(0.0, 4.0) as usize;
        Ok(Self { view, screen: ground.clone(), ground, trail: film.trail(), passed: 0, decimals })
    }

    /// Width and height in pixels.
    pub(super) fn size(&self) -> (u32, u32) {
        (self.ground.width(), self.ground.height())
    }

    /// Paints a picture; frames must come in order of time.
    pub(super) fn show(&mut self, frame: &Frame) -> &Pixmap {
        let before = self.passed;
        self.passed += self.trail[before..].iter().take_while(|p| p.t <= frame.t).count();
        if self.view.follow {
            self.show_moving(frame);
        } else {
            let new = &self.trail[before.saturating_sub(1)..self.passed];
            let points: Vec<_> = new.iter().map(|p| self.view.scale.map([p.x, p.y])).collect();
            stroke(&mut self.ground, &simplify(&points, 0.1), false, TRAIL, 1.3);
            self.screen.data_mut().copy_from_slice(self.ground.data());
            let scale = self.view.scale;
            self.draw_body(frame, |p| scale.map(p));
        }
        let label = Label::parse(&format!("*t* = {:.*}", self.decimals, frame.t + 0.0));
        write(&mut self.screen, &label, [self.view.scale.frame.x, HEAD - 10.0], TIME_SIZE);
        &self.screen
    }

    /// A picture with the body in the middle: grid and trail are shifted by whole pixels, which keeps them crisp.
    fn show_moving(&mut self, frame: &Frame) {
        let scale = self.view.scale;
        let unit = scale.frame.w / scale.x.span();
        let shift = [(frame.centre[0] * unit).round(), -(frame.centre[1] * unit).round()];
        let place = |p: Point| {
            let [x, y] = scale.map(p);
            [x - shift[0], y - shift[1]]
        };
        self.screen.data_mut().copy_from_slice(self.ground.data());
        draw_grid(&mut self.screen, &self.view, shift);
        for piece in visible(&self.trail[..self.passed], place, &self.view) {
            stroke(&mut self.screen, &piece, false, TRAIL, 1.3);
        }
        self.draw_body(frame, place);
        self.repair_margin();
    }

    /// Puts the ground back where the trail has left the frame.
    fn repair_margin(&mut self) {
        let frame = self.view.scale.frame;
        let (width, stride) = (self.ground.width() as usize, 4 * self.ground.width() as usize);
        let (left, right) = (frame.x.ceil() as usize, (frame.right().floor() as usize).min(width));
        let inside = frame.y.ceil() as usize..frame.bottom().floor() as usize;
        let rows =
            self.screen.data_mut().chunks_exact_mut(stride).zip(self.ground.data().chunks_exact(stride));
        for (y, (screen, ground)) in rows.enumerate() {
            let (from, to) = if inside.contains(&y) { (4 * left, 4 * right) } else { (stride, stride) };
            screen[..from].copy_from_slice(&ground[..from]);
            screen[to..].copy_from_slice(&ground[to..]);
        }
    }

    fn draw_body(&mut self, frame: &Frame, place: impl Fn(Point) -> Point) {
        let outline: Vec<_> = frame.outline.iter().map(|p| place(*p)).collect();
        fill(&mut self.screen, &outline, BODY, 0.75);
        stroke(&mut self.screen, &outline, true, EDGE, 1.8);
        disc(&mut self.screen, place(frame.centre), 2.2, INK);
    }
}

/// Grid lines of the plane, shifted.
fn draw_grid(screen: &mut Pixmap, view: &View, shift: Point) {
    let frame = view.scale.frame;
    let step = view.grid / view.scale.x.span() * frame.w;
    let centre = view.scale.map([0.0, 0.0]);
    let start = |i: usize, from: f64| from + (centre[i] - shift[i] - from).rem_euclid(step);
    let along =
        |from: f64, to: f64| (0..).map(move |k| from + step * f64::from(k)).take_while(move |v| *v < to);
    for x in along(start(0, frame.x), frame.right()) {
        let x = x.floor() + 0.5;
        stroke(screen, &[[x, frame.y], [x, frame.bottom()]], false, PALE, 1.0);
    }
    for y in along(start(1, frame.y), frame.bottom()) {
        let y = y.floor() + 0.5;
        stroke(screen, &[[frame.x, y], [frame.right(), y]], false, PALE, 1.0);
    }
}

/// The pieces of the trail in or near the frame, in pixels.
fn visible(trail: &[PathPoint], place: impl Fn(Point) -> Point, view: &View) -> Vec<Vec<Point>> {
    let frame = view.scale.frame;
    let outside = |[x, y]: Point| {
        let code = |v: f64, low: f64, high: f64| u8::from(v < low) | u8::from(v > high) << 1;
        code(x, frame.x, frame.right()) | code(y, frame.y, frame.bottom()) << 2
    };
    let mut pieces: Vec<Vec<Point>> = vec![Vec::new()];
    for step in trail.windows(2) {
        let (from, to) = (place([step[0].x, step[0].y]), place([step[1].x, step[1].y]));
        let piece = pieces.len() - 1;
        if outside(from) & outside(to) != 0 {
            pieces.push(Vec::new()); // both ends beyond one side
        } else if pieces[piece].is_empty() {
            pieces[piece].extend([from, to]);
        } else {
            pieces[piece].push(to);
        }
    }
    pieces.iter().filter(|piece| !piece.is_empty()).map(|piece| simplify(piece, 0.1)).collect()
}
