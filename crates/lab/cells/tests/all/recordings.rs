//! A generator of recordings: cells of any motion and form, seen with drift, jitter, gaps and stage jumps.

use motiform_dynamics::Normal;
use motiform_tracks::synthetic::{Synthetic, blur};
use motiform_tracks::{Cell, Outline, Tracks};
use std::f64::consts::{FRAC_PI_2, PI};

/// The relation of a walker's shape to its motion.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Shape {
    /// A circle.
    Round,
    /// z2 and z3 fluctuate by themselves.
    Passive,
    /// z2 is along the velocity, in proportion to it.
    Polar,
    /// A rod along the velocity, eight times as long as wide: no modes of the radius.
    Rod,
}

/// A persistent random walk.
#[derive(Clone, Copy)]
pub(crate) struct Walker {
    /// Root mean square speed.
    pub(crate) speed: f64,
    /// Persistence time.
    pub(crate) persistence: f64,
    /// Form.
    pub(crate) shape: Shape,
    /// Frames, one in each unit of time.
    pub(crate) frames: usize,
    /// Noise of a vertex, of a radius of 2.
    pub(crate) noise: f64,
}

const RADIUS: f64 = 2.0;
const VERTICES: usize = 48;
/// Steps of the walk between frames; each is the exact transition of the velocity, and the place moves by the mean of its ends.
const STEPS: usize = 50;
/// Correlation time and standard deviation of shapes that fluctuate by themselves.
const FLUCTUATION: (f64, f64) = (6.0, 0.12);

impl Walker {
    /// Its outlines.
    pub(crate) fn outlines(self, seed: u64) -> Vec<Outline> {
        let mut random = Normal::new(seed, 7);
        let spread = self.speed / 2.0_f64.sqrt();
        let (dt, keep) = (1.0 / STEPS as f64, libm::exp(-1.0 / (STEPS as f64 * self.persistence)));
        let fade = libm::exp(-1.0 / FLUCTUATION.0);
        let (mut x, mut v) = ([0.0; 2], [spread * random.next(), spread * random.next()]);
        let mut z = [0.0; 4].map(|_: f64| FLUCTUATION.1 * random.next());
        let mut outlines = Vec::with_capacity(self.frames);
        for frame in 0..self.frames {
            let mut points = self.outline(x, v, z);
            blur(&mut points, self.noise * RADIUS, || random.next());
            outlines.push(Outline {
                frame: i64::try_from(frame).expect("small"),
                t: frame as f64,
                points,
                missing: 0,
            });
            for _ in 0..STEPS {
                for k in 0..2 {
                    let new = keep * v[k] + spread * (1.0 - keep * keep).sqrt() * random.next();
                    x[k] += 0.5 * dt * (v[k] + new);
                    v[k] = new;
                }
            }
            z.iter_mut()
                .for_each(|z| *z = fade * *z + FLUCTUATION.1 * (1.0 - fade * fade).sqrt() * random.next());
        }
        outlines
    }

    fn outline(self, centre: [f64; 2], v: [f64; 2], z: [f64; 4]) -> Vec<[f64; 2]> {
        let modes = match self.shape {
            Shape::Round => vec![],
            Shape::Passive => vec![[z[0], z[1]], [z[2], z[3]]],
            // z2 turns by -2 angle
            Shape::Polar => {
                let [a, b] = v.map(|v| 0.35 * v / self.speed);
                vec![[a * a - b * b, -2.0 * a * b]]
            }
            Shape::Rod => return rod(centre, libm::atan2(v[1], v[0])),
        };
        Synthetic { centre, r0: RADIUS, z: modes }.vertices(VERTICES, 0.0)
    }
}

/// A rectangle with two half discs as ends, 8 long and 1 wide, turned.
fn rod(centre: [f64; 2], turn: f64) -> Vec<[f64; 2]> {
    let (sin, cos) = libm::sincos(turn);
    let cap = |end: f64, from: f64| {
        (0..=12).map(move |k| {
            let (s, c) = libm::sincos(from + PI * f64::from(k) / 12.0);
            [end + 0.5 * c, 0.5 * s]
        })
    };
    let along = cap(3.5, -FRAC_PI_2).chain(cap(-3.5, FRAC_PI_2));
    along.map(|[x, y]| [centre[0] + cos * x - sin * y, centre[1] + sin * x + cos * y]).collect()
}

/// Cells as they are read, in um and s.
pub(crate) fn tracks(cells: Vec<Vec<Outline>>) -> Tracks {
    let named = cells.into_iter().enumerate();
    Tracks {
        cells: named.map(|(k, frames)| Cell { name: format!("{}", k + 1), frames }).collect(),
        length_unit: "um".to_owned(),
        time_unit: "s".to_owned(),
        y_down: None,
        image: None,
        files: Vec::new(),
        notes: Vec::new(),
    }
}

/// Effects of the microscope.
pub(crate) trait Seen {
    /// The stage drifts by this much in a unit of time.
    fn drifting(self, velocity: [f64; 2]) -> Self;
    /// Cells are placed far apart, and the images turn at this rate.
    fn turning(self, rate: f64) -> Self;
    /// All outlines of a frame are displaced together, by this standard deviation.
    fn jittering(self, deviation: f64, seed: u64) -> Self;
    /// Frames are missing with this probability, cell by cell; neither the first nor the last.
    fn with_gaps(self, share: f64, seed: u64) -> Self;
    /// The stage jumps at this frame.
    fn jumping(self, frame: i64, by: [f64; 2]) -> Self;
}

impl Seen for Tracks {
    fn drifting(mut self, velocity: [f64; 2]) -> Self {
        for outline in self.cells.iter_mut().flat_map(|cell| &mut cell.frames) {
            shift(outline, velocity.map(|v| v * outline.t));
        }
        self
    }

    fn turning(mut self, rate: f64) -> Self {
        for (k, cell) in self.cells.iter_mut().enumerate() {
            let (s, c) = libm::sincos(2.4 * k as f64);
            let far = 40.0 * libm::sqrt(1.0 + k as f64);
            for outline in &mut cell.frames {
                shift(outline, [far * c, far * s]);
                let (s, c) = libm::sincos(rate * outline.t);
                outline.points.iter_mut().for_each(|p| *p = [c * p[0] - s * p[1], s * p[0] + c * p[1]]);
            }
        }
        self
    }

    fn jittering(mut self, deviation: f64, seed: u64) -> Self {
        for outline in self.cells.iter_mut().flat_map(|cell| &mut cell.frames) {
            let mut random = Normal::new(seed, outline.frame.unsigned_abs());
            shift(outline, [deviation * random.next(), deviation * random.next()]);
        }
        self
    }

    fn with_gaps(mut self, share: f64, seed: u64) -> Self {
        for (number, cell) in self.cells.iter_mut().enumerate() {
            let mut random = Normal::new(seed, number as u64);
            let last = cell.frames.len().saturating_sub(1);
            let mut k = 0;
            cell.frames.retain(|_| {
                let keep = random.uniform() >= share || k == 0 || k == last;
                k += 1;
                keep
            });
        }
        self
    }

    fn jumping(mut self, frame: i64, by: [f64; 2]) -> Self {
        let later = self.cells.iter_mut().flat_map(|cell| &mut cell.frames).filter(|one| one.frame >= frame);
        later.for_each(|outline| shift(outline, by));
        self
    }
}

fn shift(outline: &mut Outline, by: [f64; 2]) {
    outline.points.iter_mut().for_each(|point| *point = [point[0] + by[0], point[1] + by[1]]);
}

/// Mean speed of the centroid of the first cell, from frame to frame.
pub(crate) fn mean_speed(tracks: &Tracks) -> f64 {
    let frames = &tracks.cells[0].frames;
    let rate = |pair: &[Outline]| {
        let [a, b] = [0, 1].map(|k| motiform_tracks::centroid(&pair[k].points));
        libm::hypot(b[0] - a[0], b[1] - a[1]) / (pair[1].t - pair[0].t)
    };
    frames.windows(2).map(rate).sum::<f64>() / (frames.len() - 1) as f64
}
