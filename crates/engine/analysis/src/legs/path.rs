//! A sampled path: checked, continued over its period, and evaluated between samples.

use crate::{Error, Result, checks};
use std::f64::consts::{PI, TAU};

/// A sample of a path: place and velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PathSample {
    /// Time.
    pub t: f64,
    /// Position.
    pub x: f64,
    /// Position.
    pub y: f64,
    /// Velocity.
    pub vx: f64,
    /// Velocity.
    pub vy: f64,
}

/// The kind of a path: a stretch or a period.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ends {
    /// A stretch: what is cut by its ends is left out.
    Open,
    /// One period: the last sample is the first one a period later, turned by `rotation` (rad, counter-clockwise) and
    /// moved. The path goes on accordingly.
    Periodic {
        /// Net rotation per period.
        rotation: f64,
    },
}

impl PathSample {
    pub(super) fn speed(&self) -> f64 {
        libm::hypot(self.vx, self.vy)
    }

    pub(super) fn heading(&self) -> f64 {
        libm::atan2(self.vy, self.vx)
    }

    /// This sample turned about `pivot` by the rotation with cosine and sine `(c, s)`, put to `place`, `period` later.
    fn moved(&self, pivot: &Self, place: &Self, (c, s): (f64, f64), period: f64) -> Self {
        let (dx, dy) = (self.x - pivot.x, self.y - pivot.y);
        Self {
            t: self.t + period,
            x: place.x + c * dx - s * dy,
            y: place.y + s * dx + c * dy,
            vx: c * self.vx - s * self.vy,
            vy: s * self.vx + c * self.vy,
        }
    }
}

/// `copies` periods of a path, one after the other.
pub(super) fn continued(path: &[PathSample], rotation: f64, copies: usize) -> Vec<PathSample> {
    let mut all = path.to_vec();
    let (sin, cos) = libm::sincos(rotation);
    let period = path[path.len() - 1].t - path[0].t;
    for _ in 1..copies {
        let (pivot, place) = (all[all.len() - path.len()], all[all.len() - 1]);
        let next = all.len() - path.len() + 1;
        for index in next..next + path.len() - 1 {
            all.push(all[index].moved(&pivot, &place, (cos, sin), period));
        }
    }
    all
}

/// The place at time `t` by cubic Hermite interpolation.
pub(super) fn place(path: &[PathSample], t: f64) -> [f64; 2] {
    let after = path.partition_point(|sample| sample.t <= t).clamp(1, path.len() - 1);
    let (a, b) = (&path[after - 1], &path[after]);
    let (h, u) = (b.t - a.t, (t - a.t) / (b.t - a.t));
    let along = |x0: f64, v0: f64, x1: f64, v1: f64| {
        let bend = (1.0 - u) * (h * v0 - (x1 - x0)) + u * ((x1 - x0) - h * v1);
        x0 + u * (x1 - x0) + u * (1.0 - u) * bend
    };
    [along(a.x, a.vx, b.x, b.vx), along(a.y, a.vy, b.y, b.vy)]
}

/// `angle` brought into (-pi, pi].
pub(super) fn wrapped(angle: f64) -> f64 {
    let turned = angle - TAU * libm::round(angle / TAU);
    if turned <= -PI { turned + TAU } else { turned }
}

pub(super) fn check(path: &[PathSample], ends: Ends) -> Result<()> {
    checks::at_least("a list of legs, in samples,", 8, path.len())?;
    let times: Vec<f64> = path.iter().map(|sample| sample.t).collect();
    checks::growing(&times)?;
    for (index, sample) in path.iter().enumerate() {
        let values = [sample.x, sample.y, sample.vx, sample.vy, sample.speed()];
        if let Some(value) = values.into_iter().find(|x| !x.is_finite()) {
            return Err(Error::NotFinite { index, value });
        }
    }
    if let Ends::Periodic { rotation } = ends {
        checks::argument("the rotation", rotation, true, "that is finite")?;
    }
    if path.iter().all(|sample| sample.speed() == 0.0) { Err(Error::AtRest) } else { Ok(()) }
}
