//! The Newton-Picard step: Newton's method in the span of the leading tangent vectors, fixed-point iteration in the rest.
//!
//! Source: Lust, Roose, Spence, Champneys (1998), SIAM J. Sci. Comput. 19, 1188.

use crate::equilibrium::{Units, along_group_and_flow, matrix_of};
use crate::linear::{add, basis, dot, least_squares, norm, orthonormalise};
use crate::lyapunov::SplitMix;
use crate::multipliers::{errors, multipliers};
use crate::periodic::{Flow, PeriodicGuess, PeriodicOrbit, back, is_whole};
use crate::symmetry::wrap;
use motiform_dynamics::drive::drive;
use motiform_dynamics::{Equivariant, Request, System, Tangent, VectorField, Watch};

/// Directions that are followed exactly by Newton's method in a large system; the others contract within a period and are iterated.
const DIRECTIONS: usize = 5;

/// The growth of tangent vectors of a large system beyond which the try is given up: they agree to half of
/// their digits, and span no space that Newton's method could solve in.
const PARALLEL: f64 = 1e8;

/// The state of Newton's method.
pub(crate) struct Newton<'b> {
    body: &'b dyn Equivariant,
    pub(crate) shape: Vec<f64>,
    pub(crate) time: f64,
    angle: f64,
    mirrored: bool,
    /// Orthonormal tangent vectors.
    directions: Vec<Vec<f64>>,
    units: Units,
}

/// The result of the flow over T, brought back by the inverse of the symmetry.
pub(crate) struct Image {
    /// `P(u) - u`.
    pub(crate) rest: Vec<f64>,
    /// `DP` applied to the directions.
    pub(crate) directions: Vec<Vec<f64>>,
    /// `dP/dT`.
    by_time: Vec<f64>,
    /// `dP/d(angle)`.
    by_angle: Vec<f64>,
}

impl Image {
    /// The growth of the longest direction.
    pub(crate) fn amplification(&self) -> f64 {
        self.directions.iter().map(|direction| norm(direction)).fold(0.0, f64::max)
    }
}

impl<'b> Newton<'b> {
    pub(crate) fn new(body: &'b dyn Equivariant, guess: &PeriodicGuess<'_>) -> Self {
        let dim = guess.shape.len();
        let count = if is_whole(dim) { dim } else { DIRECTIONS };
        let mut random = SplitMix(2);
        let mut directions: Vec<Vec<f64>> =
            (0..count).map(|_| (0..dim).map(|_| random.next()).collect()).collect();
        // The neutral directions are among the leading ones from the start.
        VectorField::<f64>::eval(body, 0.0, guess.shape, &mut directions[0]);
        if body.symmetry().rotations && count > 1 {
            body.spin(guess.shape, &mut directions[1]);
        }
        let mut newton = Self {
            body,
            shape: guess.shape.to_vec(),
            time: guess.time,
            angle: guess.angle,
            mirrored: guess.mirrored,
            directions,
            units: Units::of_shape(body, guess.shape),
        };
        newton.orthonormalise();
        newton
    }

    /// At an orbit, following nothing yet.
    pub(crate) fn at(body: &'b dyn Equivariant, orbit: &PeriodicOrbit) -> Self {
        let PeriodicOrbit { time, angle, mirrored, .. } = *orbit;
        let units = Units::of_shape(body, &orbit.shape);
        Self { body, shape: orbit.shape.clone(), time, angle, mirrored, directions: Vec::new(), units }
    }

    fn orthonormalise(&mut self) {
        orthonormalise(&mut self.directions.iter_mut().map(Vec::as_mut_slice).collect::<Vec<_>>());
    }

    fn back(&self, x: &mut [f64]) {
        back(self.body, self.angle, self.mirrored, x);
    }

    /// Returns `true` if it is followed in all directions.
    pub(crate) fn is_whole(&self) -> bool {
        self.directions.len() == self.shape.len()
    }

    /// `|P(u) - u|`, by the flow alone: a seventh of the cost of an [`Image`] in a small system.
    pub(crate) fn miss(&self, flow: &Flow, watch: &dyn Watch) -> Option<f64> {
        let mut orbit = flow.method.shape_orbit(self.body, flow.control, 0.0, &self.shape).ok()?;
        let request = Request { max_steps: flow.max_steps, watch, ..Request::around(self.time, &self.shape) };
        if !drive(orbit.as_mut(), &request, &mut ()).ok()?.is_complete() {
            return None;
        }
        let mut rest = orbit.state().to_vec();
        self.back(&mut rest);
        add(&mut rest, -1.0, &self.shape);
        Some(norm(&rest))
    }

    pub(crate) fn image(&self, flow: &Flow, watch: &dyn Watch) -> Option<Image> {
        let dim = self.shape.len();
        let count = self.directions.len();
        let whole = self.is_whole();
        let tangent =
            if whole { Tangent::new(self.body, count) } else { Tangent::following(self.body, count) };
        let start: Vec<f64> = self.shape.iter().chain(self.directions.iter().flatten()).copied().collect();
        let mut orbit = flow.method.shape_orbit(&tangent, flow.control, 0.0, &start).ok()?;
        let bounded = match whole {
            true => Request::around(self.time, &self.shape),
            false => Request { escape_norm: PARALLEL, ..Request::until(self.time, tangent.dim()) },
        };
        let request = Request { max_steps: flow.max_steps, watch, ..bounded };
        let outcome = drive(orbit.as_mut(), &request, &mut ()).ok()?;
        if !outcome.is_complete() {
            return None;
        }
        let (end, vectors) = orbit.state().split_at(dim);
        let mut by_time = self.body.rates(end);
        let mut by_angle = self.body.spun(end);
        by_angle.iter_mut().for_each(|x| *x = -*x);
        let mut rest = end.to_vec();
        let mut directions: Vec<Vec<f64>> = vectors.chunks_exact(dim).map(<[f64]>::to_vec).collect();
        for x in [&mut rest, &mut by_time, &mut by_angle].into_iter().chain(&mut directions) {
            self.back(x);
        }
        add(&mut rest, -1.0, &self.shape);
        Some(Image { rest, directions, by_time, by_angle })
    }

    /// One Newton-Picard step: the smallest one, with time and angle as the lengths that they move shapes by ([`Units`]).
    pub(crate) fn step(&mut self, image: &Image) -> Option<()> {
        let inside = |x: &[f64]| self.directions.iter().map(|q| dot(q, x)).collect::<Vec<f64>>();
        let mut columns: Vec<Vec<f64>> = Vec::new();
        for (k, direction) in image.directions.iter().enumerate() {
            let mut column = inside(direction);
            column[k] -= 1.0;
            columns.push(column);
        }
        let ([time, angle], count) = (self.units.time_and_angle(), columns.len());
        for (by, unit) in [(&image.by_time, time), (&image.by_angle, angle)] {
            columns.push(inside(by).iter().map(|x| unit * x).collect());
        }
        let along = inside(&image.rest);
        let target: Vec<f64> = along.iter().map(|x| -x).collect();
        let solution = least_squares(&columns, &target)?;
        let mut outside = image.rest.clone();
        for (q, r) in self.directions.iter().zip(&along) {
            add(&mut outside, -r, q);
        }
        for (q, y) in self.directions.iter().zip(&solution) {
            add(&mut self.shape, *y, q);
        }
        add(&mut self.shape, 1.0, &outside);
        self.time += time * solution[count];
        self.angle += angle * solution[count + 1];
        if !self.is_whole() {
            self.directions.clone_from(&image.directions);
            self.orthonormalise();
        }
        (self.time > 0.0).then_some(())
    }

    /// The orbit with its multipliers, in a large system with those of the directions that are followed.
    pub(crate) fn described(
        mut self,
        image: &Image,
        residual: f64,
        flow: &Flow,
        watch: &dyn Watch,
    ) -> Option<PeriodicOrbit> {
        if self.is_whole() {
            return self.describe(image, residual, flow.accuracy());
        }
        self.follow(&image.directions, DIRECTIONS);
        let image = self.image(flow, watch)?;
        self.describe(&image, residual, flow.accuracy())
    }

    /// Follows the flow and the group, and at most `count` directions that `directions` span across them.
    pub(crate) fn follow(&mut self, directions: &[Vec<f64>], count: usize) {
        let fixed = along_group_and_flow(self.body, &self.shape);
        let columns: Vec<&[f64]> = fixed.iter().chain(directions).map(Vec::as_slice).collect();
        self.directions = basis(&columns, DEPENDENT);
        self.directions.truncate(fixed.len() + count);
    }

    /// The multipliers of the directions that are followed, across the flow and the group.
    pub(crate) fn describe(&self, image: &Image, residual: f64, accuracy: f64) -> Option<PeriodicOrbit> {
        let fixed = along_group_and_flow(self.body, &self.shape);
        // Neutral directions first: the rest of the span is what remains of the others.
        let columns: Vec<&[f64]> = fixed.iter().chain(&self.directions).map(Vec::as_slice).collect();
        let all = basis(&columns, 1e-5);
        let free = &all[fixed.len()..];
        let act = |x: &[f64]| {
            let mut out = vec![0.0; x.len()];
            for (q, w) in self.directions.iter().zip(&image.directions) {
                add(&mut out, dot(q, x), w);
            }
            out
        };
        let outside = |x: &Vec<f64>| {
            let mut rest = act(x);
            all.iter().for_each(|q| {
                let along = dot(q, &rest);
                add(&mut rest, -along, q);
            });
            norm(&rest)
        };
        let outside = free.iter().map(outside).fold(0.0, f64::max);
        let map = crate::linear::restrict(free, act);
        let multipliers = multipliers(&map)?;
        let errors = errors(&matrix_of(&map), &multipliers, accuracy + outside);
        Some(PeriodicOrbit {
            shape: self.shape.clone(),
            time: self.time,
            angle: wrap(self.angle),
            mirrored: self.mirrored,
            residual,
            multipliers,
            errors,
        })
    }
}

/// Directions that keep less than this part of their length across the others depend on them.
const DEPENDENT: f64 = 1e-9;
