//! Animation of the domain: an animated PNG of the deforming outline and the trail of its centre.

mod apng;
mod brush;
mod camera;
mod canvas;
mod colours;
mod ground;

use super::error::{FigureError, Result, check_finite, check_range};
use super::geometry::{Point, Range, distance};
use super::path::PathPoint;

/// One picture of an animation: the body at a time.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Time.
    pub t: f64,
    /// Position of the centre.
    pub centre: Point,
    /// Vertices of the outline in the plane of the path, in order; empty where there is no outline.
    pub outline: Vec<Point>,
}

/// The part of the plane that is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Camera {
    /// [`Camera::Fixed`], or [`Camera::Follow`] where the body would be smaller than 1/14 of the picture.
    #[default]
    Auto,
    /// The whole path, with axes.
    Fixed,
    /// The body in the middle, over a grid that stays with the plane, with a scale bar.
    Follow,
}

/// A film of the domain.
///
/// # Units   model length and time; texts are markup (see [`super::Label`])
#[derive(Debug, Clone, PartialEq)]
pub struct Animation {
    /// Pictures, in order of time.
    pub frames: Vec<Frame>,
    /// A finer path for the trail; if empty, the trail joins the centres of the frames.
    pub path: Vec<PathPoint>,
    /// Longest side in pixels, 160 to 2048.
    pub size: u32,
    /// Frames per second, 1 to 100.
    pub fps: f64,
    /// The part of the plane that is shown.
    pub camera: Camera,
    /// Label of the x axis.
    pub x_label: String,
    /// Label of the y axis.
    pub y_label: String,
    /// Unit behind the number at the scale bar.
    pub unit: String,
    /// A short note above the frame on the right, such as the scale of the body.
    pub note: String,
}

impl Default for Animation {
    fn default() -> Self {
        Self {
            frames: Vec::new(),
            path: Vec::new(),
            size: 480,
            fps: 25.0,
            camera: Camera::Auto,
            x_label: "*x*".to_owned(),
            y_label: "*y*".to_owned(),
            unit: "model length".to_owned(),
            note: String::new(),
        }
    }
}

impl Animation {
    /// Draws the film as an animated PNG that repeats without end.
    ///
    /// # Errors   no frame, a number that is not finite, times that decrease, or a setting out of range
    pub fn apng(&self) -> Result<Vec<u8>> {
        self.check()?;
        let mut stage = canvas::Stage::new(self)?;
        let mut out = Vec::new();
        let mut film = apng::Film::new(&mut out, stage.size(), self.frames.len(), self.fps)?;
        for frame in &self.frames {
            film.push(stage.show(frame))?;
        }
        film.finish()?;
        Ok(out)
    }

    /// The points of the trail with their times.
    fn trail(&self) -> Vec<PathPoint> {
        if self.path.is_empty() {
            self.frames.iter().map(|f| PathPoint { t: f.t, x: f.centre[0], y: f.centre[1] }).collect()
        } else {
            self.path.clone()
        }
    }

    /// Largest distance of an outline from its centre; 0 without outlines.
    fn body_radius(&self) -> f64 {
        let radius = |f: &Frame| f.outline.iter().map(|p| distance(*p, f.centre)).fold(0.0, f64::max);
        self.frames.iter().map(radius).fold(0.0, f64::max)
    }

    /// Time of the shortest step between frames, for the decimals of the time label; 1 if there is none.
    fn time_step(&self) -> f64 {
        let steps = self.frames.windows(2).map(|w| w[1].t - w[0].t).filter(|step| *step > 0.0);
        Range::of(steps).map_or(1.0, |steps| steps.min)
    }

    fn check(&self) -> Result<()> {
        check_range("size of the animation in pixels", f64::from(self.size), 160.0, 2048.0)?;
        check_range("frames per second", self.fps, 1.0, 100.0)?;
        if self.frames.is_empty() {
            return Err(FigureError::Empty { what: "list of frames" });
        }
        check_finite(
            "frame value (t, x, y in turn)",
            self.frames.iter().flat_map(|f| [f.t, f.centre[0], f.centre[1]]),
        )?;
        check_finite(
            "outline coordinate",
            self.frames.iter().flat_map(|f| f.outline.iter().flatten().copied()),
        )?;
        check_finite("path value (t, x, y in turn)", self.path.iter().flat_map(|p| [p.t, p.x, p.y]))?;
        sorted("frame time", self.frames.iter().map(|f| f.t))?;
        sorted("path time", self.path.iter().map(|p| p.t))
    }
}

fn sorted(what: &'static str, times: impl Iterator<Item = f64>) -> Result<()> {
    let mut before = f64::NEG_INFINITY;
    for (index, t) in times.enumerate() {
        if t < before {
            return Err(FigureError::Unsorted { what, index });
        }
        before = t;
    }
    Ok(())
}
