//! Changes of a record, and what is wrong with it afterwards.

use super::laws::Law;
use crate::recordings::{Seen, tracks};
use motiform_dynamics::Normal;
use motiform_tracks::synthetic::{Synthetic, blur, pixelated};
use motiform_tracks::{Outline, Tracks};

/// Vertices of an outline.
const VERTICES: usize = 48;
/// Standard deviation of a vertex, as a part of the radius.
const BLUR: f64 = 0.01;

/// A misspecification.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Change {
    /// As the model has it.
    None,
    /// A drift of the stage, as a part of the root-mean-square speed.
    Drift(f64),
    /// All points of a frame displaced together: standard deviation as a part of the radius.
    Jitter(f64),
    /// Process noise with this correlation time.
    Coloured(f64),
    /// This share of the frames is missing.
    Gaps(f64),
    /// This share of the frames shows the outline of the frame before.
    Stale(f64),
    /// z4 of this size relative to z2^2/R0.
    Fourth(f64),
    /// The linear rate of z2 changes by this part from the beginning to the end.
    Ramp(f64),
    /// The linear rate of the velocity oscillates by this part, five times.
    Rhythm(f64),
    /// The second half is that of another law.
    Glued,
    /// y is multiplied by this.
    Stretched(f64),
    /// The path (not the outline) is narrower in y by this factor: a channel.
    Channel(f64),
    /// Every so-many-th frame alone.
    Coarse(usize),
    /// Outlines follow pixels of this part of the radius.
    Pixels(f64),
    /// Errors of the vertices of a twentieth of the frames are ten times as large.
    Outliers,
    /// The stage jumps by ten radii in the middle.
    Jump,
    /// A quarter of the frames.
    Short,
}

pub(super) const ALL: [Change; 20] = [
    Change::None,
    Change::Drift(0.02),
    Change::Drift(0.1),
    Change::Jitter(0.005),
    Change::Jitter(0.01),
    Change::Coloured(0.5),
    Change::Coloured(2.0),
    Change::Gaps(0.1),
    Change::Gaps(0.3),
    Change::Stale(0.1),
    Change::Fourth(0.5),
    Change::Ramp(0.2),
    Change::Glued,
    Change::Stretched(0.97),
    Change::Channel(0.7),
    Change::Coarse(4),
    Change::Pixels(0.1),
    Change::Outliers,
    Change::Jump,
    Change::Short,
];

impl Change {
    /// `true` if the record still follows the law, so that its coefficients are true.
    pub(super) fn keeps_the_law(self) -> bool {
        !matches!(
            self,
            Self::Coloured(_)
                | Self::Fourth(_)
                | Self::Ramp(_)
                | Self::Rhythm(_)
                | Self::Glued
                | Self::Stretched(_)
                | Self::Channel(_)
        )
    }

    /// The record of a cell of this law; `other`: what it is glued to.
    pub(super) fn record(self, law: &Law, other: &Law, sampling: (f64, usize), seed: u64) -> Option<Tracks> {
        let mut law = law.clone();
        match self {
            Self::Coloured(memory) => law.memory = memory,
            Self::Fourth(size) => law.fourth = size,
            Self::Ramp(part) => law.ramp = part,
            Self::Rhythm(part) => law.rhythm = part,
            _ => {}
        }
        let (dt, frames) = sampling;
        let frames = if self == Self::Short { frames / 4 } else { frames };
        let mut bodies = law.bodies((dt, frames), seed)?;
        if self == Self::Glued {
            glue(&mut bodies, other.bodies((dt, frames), seed)?);
        }
        Some(self.seen(bodies, law.radius, dt, seed))
    }

    /// The outlines of bodies that a microscope shows.
    pub(super) fn seen(self, mut bodies: Vec<Synthetic>, radius: f64, dt: f64, seed: u64) -> Tracks {
        let speed = speed(&bodies) / dt;
        if let Self::Channel(width) = self {
            bodies.iter_mut().for_each(|body| body.centre[1] *= width);
        }
        let mut random = Normal::new(seed, 12);
        let mut outlines: Vec<Outline> = Vec::with_capacity(bodies.len());
        for (frame, body) in bodies.iter().enumerate() {
            let mut points = self.outline(body, radius, &mut random);
            if let (Self::Stale(share), Some(last)) = (self, outlines.last())
                && random.uniform() < share
            {
                points.clone_from(&last.points);
            }
            let t = frame as f64 * dt;
            outlines.push(Outline { frame: i64::try_from(frame).expect("small"), t, points, missing: 0 });
        }
        if let Self::Coarse(every) = self {
            outlines.retain(|outline| outline.frame % i64::try_from(every).expect("small") == 0);
        }
        let middle = i64::try_from(bodies.len() / 2).expect("small");
        let seen = tracks(vec![outlines]);
        match self {
            Self::Drift(part) => seen.drifting([part * speed, 0.0]),
            Self::Jitter(part) => seen.jittering(part * radius, seed),
            Self::Gaps(share) => seen.with_gaps(share, seed),
            Self::Jump => seen.jumping(middle, [10.0 * radius, 0.0]),
            _ => seen,
        }
    }

    fn outline(self, body: &Synthetic, radius: f64, random: &mut Normal) -> Vec<[f64; 2]> {
        let mut points = body.vertices(VERTICES, 0.0);
        let bad = self == Self::Outliers && random.uniform() < 0.05;
        match self {
            Self::Pixels(part) => points = pixelated(&body.vertices(4 * VERTICES, 0.0), part * radius),
            _ => blur(&mut points, BLUR * radius * if bad { 10.0 } else { 1.0 }, || random.next()),
        }
        if let Self::Stretched(part) = self {
            points.iter_mut().for_each(|point| point[1] *= part);
        }
        points
    }
}

/// Root mean square displacement from frame to frame.
fn speed(bodies: &[Synthetic]) -> f64 {
    let squares = bodies.windows(2).map(|pair| {
        let [x, y] = [0, 1].map(|k| pair[1].centre[k] - pair[0].centre[k]);
        x * x + y * y
    });
    (squares.sum::<f64>() / (bodies.len() - 1).max(1) as f64).sqrt()
}

/// Replaces the second half by the bodies of another record, from where the first half ends.
fn glue(bodies: &mut Vec<Synthetic>, other: Vec<Synthetic>) {
    let half = bodies.len() / 2;
    bodies.truncate(half);
    let shift = [0, 1].map(|k| bodies[half - 1].centre[k] - other[half].centre[k]);
    bodies.extend(other.into_iter().skip(half + 1).map(|mut body| {
        (0..2).for_each(|k| body.centre[k] += shift[k]);
        body
    }));
}
