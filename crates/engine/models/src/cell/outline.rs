//! The boundary as a curve: integrated from its normals, measured, and checked for crossing itself.

use super::Cell;
use super::circle::Circle;
use std::f64::consts::TAU;

/// A closed boundary with its centroid (of the area) at the origin.
#[derive(Clone, Debug, PartialEq)]
pub struct Boundary {
    /// Points at equal arc length, anticlockwise, the first (at s = 0) not repeated.
    pub points: Vec<[f64; 2]>,
    /// Length of the curve, from its own tangents; equal to the parameter `length` up to the closure residual.
    pub length: f64,
    /// Enclosed area (negative parts of a curve that crosses itself count negative).
    pub area: f64,
    /// The residual `|int n ds| / L` of the closure.
    pub closure_residual: f64,
    /// Root mean square of the error function in angles, `k_1 eps` (rad): how far the free solution was from closed.
    pub correction: f64,
    /// Newton steps of the closure.
    pub steps: usize,
    /// The first self-intersection of the curve, if any.
    pub crossing: Option<[f64; 2]>,
}

/// The curve in complex Fourier modes: `X = sum_m X_m exp(i k_m s)`, `x + i y`; entry `m + half`.
struct Curve {
    half: usize,
    modes: Vec<[f64; 2]>,
}

impl Cell {
    /// The boundary of a shape, with `points` points.
    ///
    /// `dX/ds = t = -i n`: the paper's n points inwards (`dt/ds = kappa n`, kappa > 0 on a circle run anticlockwise).
    ///
    /// # Errors
    /// The residual of (CLOSE), if the boundary could not be closed.
    pub fn boundary(&self, shape: &[f64], points: usize) -> Result<Boundary, f64> {
        let closed = self.close(shape)?;
        let curve =
            Curve::new(&self.circle, &closed.normals.cos, &closed.normals.sin, self.parameters.length);
        let k = self.parameters.wavenumber();
        let area = 0.5 * self.parameters.length * curve.sum(|m, [x, y]| m * k * (x * x + y * y));
        let fine = curve.points(2 * self.circle.points());
        let centre = centroid(&fine);
        let speeds = curve.tangents(k, self.parameters.length, fine.len());
        let length = speeds.sum::<f64>() * self.parameters.length / fine.len() as f64;
        let drawn: Vec<[f64; 2]> =
            curve.points(points).iter().map(|p| [p[0] - centre[0], p[1] - centre[1]]).collect();
        Ok(Boundary {
            crossing: first_crossing(&drawn),
            points: drawn,
            length,
            area,
            closure_residual: closed.residual,
            correction: closed.correction,
            steps: closed.steps,
        })
    }
}

impl Curve {
    /// `X_m = -n_m / k_m` for `m != 0`, from the modes of `n` at the points.
    fn new(circle: &Circle, cos: &[f64], sin: &[f64], length: f64) -> Self {
        let points = circle.points();
        let half = points / 2 - 1;
        let waves: Vec<(f64, f64)> =
            (0..points).map(|i| libm::sincos(-TAU * i as f64 / points as f64)).collect();
        let mode = |index: usize| {
            if index == half {
                return [0.0; 2];
            }
            let mut sum = [0.0; 2];
            let m = (index + points - half) % points; // m modulo the number of points
            for j in 0..points {
                let (s, c) = waves[(m * j) % points];
                sum[0] += cos[j] * c - sin[j] * s;
                sum[1] += cos[j] * s + sin[j] * c;
            }
            let scale = -length / (TAU * (index as f64 - half as f64) * points as f64);
            sum.map(|x| x * scale)
        };
        Self { half, modes: (0..=2 * half).map(mode).collect() }
    }

    /// The sum over modes of `term(m, X_m)`.
    fn sum(&self, term: impl Fn(f64, [f64; 2]) -> f64) -> f64 {
        self.modes.iter().enumerate().map(|(i, &x)| term(i as f64 - self.half as f64, x)).sum()
    }

    /// `points` points at equal arc length.
    fn points(&self, points: usize) -> Vec<[f64; 2]> {
        self.at((0..points).map(|j| TAU * j as f64 / points as f64), |_| 1.0)
    }

    /// `sum_m factor(m) X_m exp(i m angle)` at each of the angles. They advance together from mode to mode: a
    /// sum never waits for another one.
    fn at(&self, angles: impl Iterator<Item = f64>, factor: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
        let mut waves: Vec<Wave> = angles.map(|angle| Wave::new(angle, self.half)).collect();
        for (i, &[x, y]) in self.modes.iter().enumerate() {
            let f = factor(i as f64 - self.half as f64);
            waves.iter_mut().for_each(|wave| wave.add(f, x, y));
        }
        waves.iter().map(|wave| wave.sum).collect()
    }

    /// `|dX/ds|` at `points` points at equal arc length.
    fn tangents(&self, k: f64, length: f64, points: usize) -> impl Iterator<Item = f64> {
        let angles = (0..points).map(|j| k * (length * j as f64 / points as f64));
        self.at(angles, |m| k * m).into_iter().map(|[x, y]| libm::hypot(x, y))
    }
}

/// The sum over modes at one angle, up to a mode.
struct Wave {
    /// `exp(i angle)`, real part first.
    turn: [f64; 2],
    /// `exp(i m angle)` of the next mode.
    phase: [f64; 2],
    sum: [f64; 2],
}

impl Wave {
    /// Before the mode `-half`.
    fn new(angle: f64, half: usize) -> Self {
        let wave = |angle| {
            let (sin, cos) = libm::sincos(angle);
            [cos, sin]
        };
        Self { turn: wave(angle), phase: wave(-angle * half as f64), sum: [0.0; 2] }
    }

    /// Adds `f (x + i y) exp(i m angle)`, and goes on to the next mode.
    #[inline(always)]
    fn add(&mut self, f: f64, x: f64, y: f64) {
        let ([cos, sin], [c, s]) = (self.turn, self.phase);
        self.sum[0] += f * (x * c - y * s);
        self.sum[1] += f * (x * s + y * c);
        self.phase = [c * cos - s * sin, s * cos + c * sin];
    }
}

/// Centroid of the area inside a polygon.
fn centroid(points: &[[f64; 2]]) -> [f64; 2] {
    let next = points.iter().cycle().skip(1);
    let (mut area, mut x, mut y) = (0.0, 0.0, 0.0);
    for (p, q) in points.iter().zip(next) {
        let cross = p[0] * q[1] - p[1] * q[0];
        area += cross;
        x += cross * (p[0] + q[0]);
        y += cross * (p[1] + q[1]);
    }
    [x / (3.0 * area), y / (3.0 * area)]
}

/// The first self-intersection of a closed polygon, starting from its first point.
pub fn first_crossing(points: &[[f64; 2]]) -> Option<[f64; 2]> {
    let n = points.len();
    let edge = |i: usize| (points[i], points[(i + 1) % n]);
    (0..n)
        .flat_map(|i| (i + 2..n).filter(move |&j| (j + 1) % n != i).map(move |j| (i, j)))
        .find_map(|(i, j)| crossing(edge(i), edge(j)))
}

/// The intersection of two segments, if any.
fn crossing((a, b): ([f64; 2], [f64; 2]), (c, d): ([f64; 2], [f64; 2])) -> Option<[f64; 2]> {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [d[0] - c[0], d[1] - c[1]]);
    let w = [c[0] - a[0], c[1] - a[1]];
    let cross = |p: [f64; 2], q: [f64; 2]| p[0] * q[1] - p[1] * q[0];
    let denominator = cross(u, v);
    let (along, across) = (cross(w, v) / denominator, cross(w, u) / denominator);
    let inside = |x: f64| (0.0..=1.0).contains(&x);
    (inside(along) && inside(across)).then(|| [a[0] + along * u[0], a[1] + along * u[1]])
}
