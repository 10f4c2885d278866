//! The branches that meet where several directions are critical, or where terms of higher order decide.

use super::correct::{count_unseen, product, scaled, seen};
use super::equilibria::Equilibria;
use super::problem::Equations;
use super::switch::Departure;
use motiform_analysis::linear::{add, dot, norm};
use motiform_analysis::symmetry::align;
use motiform_dynamics::Watch;
use motiform_dynamics::sample::sort_by_number;
use nalgebra::{DMatrix, DVector};

/// Radius of the sphere, in the units of the unknowns.
const RADIUS: f64 = 0.005;

/// Steps of Newton's method, and the last of them as a part of the radius. Towards branches that touch each other it converges slowly.
const STEPS: usize = 60;
const CONVERGED: f64 = 1e-8;

/// Part of the radius by which a solution may lie off the directions that the equations do not see.
const ASIDE: f64 = 0.3;

/// Solutions on one branch, at the radius and at half of it, lie in directions with at least this cosine.
const STRAIGHT: f64 = 0.9;

/// Solutions closer than this part of the radius are one.
const SAME: f64 = 1e-2;

/// Directions from which Newton's method begins: those of all corners and edges of a cube, as far as so many dimensions, and others.
const CUBE: usize = 5;
const OTHERS: usize = 48;

/// The directions in which branches of equilibria leave the point `x`, each of length 1, images under the symmetry left out: the
/// solutions on a small sphere about it, from many directions that the equations do not see to first order. The point's own
/// branch is among them.
///
/// # Checked by  tests/all/meeting.rs: all branches of decoupled pitchforks, of a square's symmetry, and of cubic forms
pub(super) fn rays(from: Departure<'_, '_>, problem: &Equilibria<'_>, x: &[f64]) -> Vec<Vec<f64>> {
    let Departure { family, point, watch, .. } = from;
    let weights = problem.weights(x);
    let units: Vec<f64> = weights.iter().map(|weight| 1.0 / weight.sqrt()).collect();
    let Ok(local) = problem.local(x, watch) else { return Vec::new() };
    let all = seen(problem.linear(&local), &weights);
    let count = count_unseen(&all, problem.resolution()).max(point.critical + 1);
    let plane: Vec<Vec<f64>> = all
        .into_iter()
        .take(count)
        .map(|(_, v)| v.iter().zip(&units).map(|(v, u)| v / u).collect())
        .collect();
    let sphere = Sphere { problem, x, units: &units, plane, watch };
    let body = family.at(point.parameter).ok();
    let mut found: Vec<Vec<f64>> = Vec::new();
    for start in starts(count) {
        if watch.stopped() {
            break;
        }
        let Some(ray) = sphere.ray(&start) else { continue };
        let is_image = |other: &Vec<f64>| {
            let parts =
                |y: &[f64]| y.iter().zip(&units).zip(x).map(|((y, u), x)| x + u * y).collect::<Vec<f64>>();
            let (a, b) = (parts(other), parts(&ray));
            let (dim, size) = (problem.dim, SAME * RADIUS);
            let last = a.len() - 1;
            body.as_ref().is_some_and(|body| {
                [false, true].iter().any(|&mirrored| {
                    (!mirrored || body.symmetry().mirror)
                        && align(body.as_ref(), &a[..dim], &b[..dim], mirrored).distance < size * units[0]
                })
            }) && (a[last] - b[last]).abs() < size * units[last]
        };
        if !found.iter().any(is_image) {
            found.push(ray);
        }
    }
    let full = |y: Vec<f64>| scaled(y.iter().zip(&units).map(|(y, u)| y * u).collect(), &weights);
    found.into_iter().filter_map(full).collect()
}

/// Rays with their opposites, where there are such, the most opposite ones first: the two legs of a branch.
pub(super) fn paired(rays: &[Vec<f64>], weights: &[f64]) -> Vec<Vec<Vec<f64>>> {
    let mut pairs: Vec<(f64, usize, usize)> = (0..rays.len())
        .flat_map(|a| (0..a).map(move |b| (a, b)))
        .map(|(a, b)| (product(weights, &rays[a], &rays[b]), a, b))
        .filter(|pair| pair.0 < -STRAIGHT)
        .collect();
    sort_by_number(&mut pairs, |a| a.0);
    let mut partner = vec![None; rays.len()];
    for (_, a, b) in pairs {
        if partner[a].is_none() && partner[b].is_none() {
            (partner[a], partner[b]) = (Some(b), Some(a));
        }
    }
    let first = (0..rays.len()).filter(|&a| partner[a].is_none_or(|b| a < b));
    first.map(|a| std::iter::once(a).chain(partner[a]).map(|k| rays[k].clone()).collect()).collect()
}

/// The equations on a sphere about a point; unknowns are distances from it, in their units.
struct Sphere<'s, 'f> {
    problem: &'s Equilibria<'f>,
    x: &'s [f64],
    units: &'s [f64],
    /// An orthonormal basis of the directions that are not seen to first order.
    plane: Vec<Vec<f64>>,
    watch: &'s dyn Watch,
}

impl Sphere<'_, '_> {
    /// The solution of radius [`RADIUS`] that Newton's method finds from a direction in the plane, if it is on a branch through the point.
    fn ray(&self, start: &[f64]) -> Option<Vec<f64>> {
        let mut y = vec![0.0; self.x.len()];
        self.plane.iter().zip(start).for_each(|(v, part)| add(&mut y, RADIUS * part, v));
        let y = self.solved(y, RADIUS)?;
        let half = self.solved(y.iter().map(|y| 0.5 * y).collect(), 0.5 * RADIUS)?;
        let aside = self.plane.iter().fold(y.clone(), |mut rest, v| {
            let part = dot(v, &y);
            add(&mut rest, -part, v);
            rest
        });
        let cosine = dot(&y, &half) / (norm(&y) * norm(&half));
        (norm(&aside) < ASIDE * RADIUS && cosine > STRAIGHT).then_some(y)
    }

    fn solved(&self, mut y: Vec<f64>, radius: f64) -> Option<Vec<f64>> {
        let dim = y.len();
        for _ in 0..STEPS {
            let place: Vec<f64> =
                self.x.iter().zip(&y).zip(self.units).map(|((x, y), u)| x + u * y).collect();
            let local = self.problem.local(&place, self.watch).ok()?;
            let linear = self.problem.linear(&local);
            let rows = linear.matrix.nrows();
            let mut all = DMatrix::zeros(dim, dim);
            all.view_mut((0, 0), (rows, dim)).copy_from(&linear.matrix);
            self.units.iter().enumerate().for_each(|(j, unit)| all.column_mut(j).scale_mut(*unit));
            y.iter().enumerate().for_each(|(j, y)| all[(rows, j)] = 2.0 * y);
            let mut right = DVector::zeros(dim);
            linear.residual.iter().enumerate().for_each(|(i, value)| right[i] = -value);
            right[rows] = radius * radius - dot(&y, &y);
            let step = all.lu().solve(&right)?;
            let length = step.norm();
            let part = (0.5 * radius / length).min(1.0);
            y.iter_mut().zip(step.iter()).for_each(|(y, step)| *y += part * step);
            if length < CONVERGED * radius {
                return Some(y);
            }
            if !length.is_finite() {
                return None;
            }
        }
        None
    }
}

/// Directions of length 1 in a space of `count` dimensions.
fn starts(count: usize) -> Vec<Vec<f64>> {
    let corners = if count <= CUBE { 3_usize.pow(count as u32) } else { 0 };
    let corner =
        |k: usize| (0..count).map(|i| [0.0, 1.0, -1.0][k / 3_usize.pow(i as u32) % 3]).collect::<Vec<f64>>();
    let mut state = 1_u64;
    let mut number = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    let mut all: Vec<Vec<f64>> = (1..corners).map(corner).collect();
    all.extend((0..OTHERS * count).map(|_| (0..count).map(|_| number()).collect()));
    all.iter_mut().for_each(|v| {
        let length = norm(v);
        v.iter_mut().for_each(|value| *value /= length);
    });
    all
}
