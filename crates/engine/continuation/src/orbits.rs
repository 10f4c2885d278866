//! The equations of relative periodic orbits along a parameter.

mod problem;

use super::classes::Classes;
use super::equilibria::{GROWN, linearisation};
use super::family::{Bodies, Neighbours};
use super::problem::{Border, Equations, Failure, Linear};
use super::settings::Settings;
use super::shooting::{Segment, segments};
use super::vicinity::{Vicinity, spread};
use motiform_analysis::RelativeEquilibrium;
use motiform_analysis::equilibrium::neutral_direction;
use motiform_analysis::linear::{add, apply, basis, dot, eigenvalues, norm, restrict};
use motiform_analysis::lyapunov::left_alone;
use motiform_analysis::periodic::{Flow, back};
use motiform_dynamics::{Equivariant, VectorField, Watch};
use nalgebra::DMatrix;

/// Part of the size of shapes below which a coordinate is known as well as a branch is.
const STILL: f64 = 1e-6;

/// `Phi_(T/m)(u_i) = u_(i+1)`, and the last one's image is `R(angle) [M] u_0`; unknowns `(u_0 .. u_(m-1), T, [angle], p)`. The nodes
/// move normal to the flow and to the group. There is an angle where it is a neutral direction too: without the mirror, in a
/// body with symmetry.
pub(super) struct Orbits<'f> {
    pub(super) bodies: Bodies<'f>,
    pub(super) flow: Flow,
    pub(super) classes: Classes,
    pub(super) dim: usize,
    /// Number of nodes.
    pub(super) parts: usize,
    pub(super) mirrored: bool,
    /// `true` if the angle is an unknown.
    pub(super) turns: bool,
    pub(super) size: f64,
    /// The unit of shapes that the equations have.
    pub(super) length: f64,
    pub(super) widths: Vec<f64>,
    /// A family of orbits through each of a branch.
    pub(super) family: Vec<Border>,
    /// The round-off of the equations, in the units of size and rate.
    pub(super) round_off: f64,
    /// Factor by which an offset makes an orbit less exact, and what the round-off over its time adds.
    pub(super) offset: f64,
    pub(super) drift: f64,
}

/// The equations at one place.
pub(super) struct Local {
    pub(super) body: Box<dyn Equivariant>,
    pub(super) linear: Linear,
    pub(super) segments: Vec<Segment>,
    /// `f` and `Gu` at the nodes.
    pub(super) rates: Vec<Vec<f64>>,
    pub(super) spins: Vec<Vec<f64>>,
}

impl<'f> Orbits<'f> {
    /// The equations of an orbit of this time and angle, mirrored or not, with these nodes, and its unknowns.
    pub(super) fn near(
        bodies: Bodies<'f>,
        classes: (&dyn Equivariant, Classes),
        (nodes, (time, angle, mirrored)): (&[Vec<f64>], (f64, f64, bool)),
        along: (&[f64], &[f64]),
        settings: &Settings,
    ) -> (Self, Vec<f64>) {
        let shapes: Vec<&[f64]> = nodes.iter().map(Vec::as_slice).collect();
        let problem = Self::through(bodies, classes, (&shapes, (time, mirrored)), along, settings);
        let mut x = nodes.concat();
        x.push(time);
        x.extend(problem.turns.then_some(angle));
        x.extend_from_slice(along.0);
        (problem, x)
    }

    fn through(
        bodies: Bodies<'f>,
        (body, classes): (&dyn Equivariant, Classes),
        (shapes, (time, mirrored)): (&[&[f64]], (f64, bool)),
        (parameters, widths): (&[f64], &[f64]),
        settings: &Settings,
    ) -> Self {
        let Vicinity { size, units, round_off, .. } = bodies.vicinity(body, (parameters, widths), shapes);
        let largest = shapes.iter().map(|shape| norm(shape)).fold(0.0, f64::max);
        Self {
            bodies,
            flow: units.flow(settings.flow).above(round_off * size),
            classes,
            dim: body.dim(),
            parts: shapes.len(),
            mirrored,
            turns: body.symmetry().rotations && !mirrored,
            size,
            length: units.length,
            widths: widths.to_vec(),
            family: Vec::new(),
            round_off,
            offset: (largest / size).max(1.0),
            drift: round_off * units.rate * time,
        }
    }
}

impl Orbits<'_> {
    /// Number of unknowns.
    pub(super) fn unknowns(&self) -> usize {
        self.parts * self.dim + 1 + usize::from(self.turns) + self.bodies.count()
    }

    /// The size of the shapes, or, beside an offset, that of their changes along the orbit.
    pub(super) fn extent(&self, x: &[f64]) -> f64 {
        let nodes = || (0..self.parts).map(|i| self.node(x, i));
        if self.offset > 1.0 { spread(nodes()).1 } else { nodes().map(norm).fold(0.0, f64::max) }
    }

    /// The unit of the shapes.
    fn unit(&self, x: &[f64]) -> f64 {
        self.size.max(GROWN * self.extent(x))
    }

    pub(super) fn node<'x>(&self, x: &'x [f64], i: usize) -> &'x [f64] {
        &x[i * self.dim..(i + 1) * self.dim]
    }

    pub(super) fn span(&self, x: &[f64]) -> f64 {
        x[self.parts * self.dim] / self.parts as f64
    }

    pub(super) fn angle(&self, x: &[f64]) -> f64 {
        if self.turns { x[self.parts * self.dim + 1] } else { 0.0 }
    }

    /// The eigenvalues of a relative equilibrium in the directions that keep the mirror axis of the orbit's shapes, without those of
    /// coordinates in which the orbit rests; none where the shapes have rotations.
    pub(super) fn kept_rates<'x>(
        &self,
        body: &dyn Equivariant,
        at: &RelativeEquilibrium,
        shapes: impl Iterator<Item = &'x [f64]>,
    ) -> Vec<(f64, f64)> {
        if self.classes.folds > 1 || self.classes.circle {
            return Vec::new();
        }
        let matrix = linearisation(body, &at.shape, at.turning_rate);
        let rests = self.rests(&matrix, &at.shape, shapes);
        if self.classes.axis.is_none() && !rests.contains(&true) {
            return at.eigenvalues.clone();
        }
        let classes = self.classes.without(&neutral_direction(body, &at.shape));
        let columns = classes.into_iter().next().map(|mut within| {
            for vector in &mut within {
                vector.iter_mut().zip(&rests).filter(|(_, rests)| **rests).for_each(|(x, _)| *x = 0.0);
            }
            let kept = basis(&within.iter().map(Vec::as_slice).collect::<Vec<_>>(), STILL);
            restrict(&kept, |v| apply(&matrix, v))
        });
        columns.and_then(|columns| eigenvalues(&columns)).unwrap_or_default()
    }

    /// For each coordinate, whether the orbit rests in it at its value in an equilibrium, and the others do not act on it there: how its
    /// deviations decay says nothing about the orbit.
    fn rests<'x>(&self, matrix: &[f64], at: &[f64], shapes: impl Iterator<Item = &'x [f64]>) -> Vec<bool> {
        let mut rests = vec![true; self.dim];
        for shape in shapes {
            for (rests, (x, at)) in rests.iter_mut().zip(shape.iter().zip(at)) {
                *rests &= (x - at).abs() <= STILL * self.size;
            }
        }
        let largest = matrix.iter().fold(0.0_f64, |most, entry| most.max(entry.abs()));
        left_alone(&mut rests, |i, j| matrix[j * self.dim + i].abs() > STILL * largest);
        if rests.contains(&false) { rests } else { vec![false; self.dim] }
    }

    /// The node where the reduced shape changes most slowly.
    fn slowest(&self, local: &Local) -> Option<usize> {
        let speeds: Vec<f64> = reduced_rates(local).iter().map(|rate| norm(rate)).collect();
        (0..self.parts).min_by(|&a, &b| speeds[a].total_cmp(&speeds[b]))
    }

    fn fill(&self, x: &[f64], local: &Local) -> Linear {
        let unknowns = self.unknowns();
        let rows = unknowns - self.bodies.count();
        let matrix = DMatrix::zeros(rows, unknowns);
        let mut linear = Linear { residual: vec![0.0; rows], matrix, family: self.family.clone() };
        for (i, segment) in local.segments.iter().enumerate() {
            self.fill_part(x, local.body.as_ref(), (i, segment), &mut linear);
        }
        for (row, direction) in self.neutral(local).iter().enumerate() {
            for (j, value) in direction.iter().enumerate() {
                linear.matrix[(self.parts * self.dim + row, j)] = *value;
            }
        }
        linear
    }

    /// The equations of one part.
    fn fill_part(
        &self,
        x: &[f64],
        body: &dyn Equivariant,
        (i, segment): (usize, &Segment),
        linear: &mut Linear,
    ) {
        let (dim, time, rows) = (self.dim, self.parts * self.dim, i * self.dim);
        let (last, next) = (i + 1 == self.parts, (i + 1) % self.parts);
        let brought = |v: &[f64]| {
            let mut v = v.to_vec();
            if last {
                back(body, self.angle(x), self.mirrored, &mut v);
            }
            v
        };
        let mut put = |column: usize, factor: f64, v: &[f64]| {
            for (k, value) in v.iter().enumerate() {
                linear.matrix[(rows + k, column)] += factor * value;
            }
        };
        for j in 0..dim {
            put(i * dim + j, 1.0, &brought(&self.classes.kept(body, &segment.tangents, j, 0.0)));
        }
        put(time, 1.0 / self.parts as f64, &brought(&segment.slope));
        if last && self.turns {
            let spin = body.spun(&segment.end);
            put(time + 1, -1.0, &brought(&spin));
        }
        for (j, slope) in segment.by_parameter.chunks_exact(dim).enumerate() {
            put(self.unknowns() - self.bodies.count() + j, 1.0, &brought(slope));
        }
        for k in 0..dim {
            linear.matrix[(rows + k, next * dim + k)] -= 1.0;
        }
        let mut rest = brought(&segment.end);
        add(&mut rest, -1.0, self.node(x, next));
        linear.residual[rows..rows + dim].copy_from_slice(&rest);
    }

    /// The neutral directions of all nodes together, orthonormal: the rotation, then time.
    fn neutral(&self, local: &Local) -> Vec<Vec<f64>> {
        let mut out: Vec<Vec<f64>> = Vec::new();
        if self.turns {
            out.push(local.spins.concat());
        }
        out.push(local.rates.concat());
        motiform_analysis::linear::orthonormalise(
            &mut out.iter_mut().map(Vec::as_mut_slice).collect::<Vec<_>>(),
        );
        out
    }
}

impl Equations for Orbits<'_> {
    type Local = Local;

    fn local(&self, x: &[f64], watch: &dyn Watch) -> Result<Local, Failure> {
        let neighbours = Neighbours::of(self.bodies, x, &self.widths, (self.length, self.round_off))?;
        let span = self.span(x);
        let nodes = || (0..self.parts).map(|i| self.node(x, i));
        let segments = segments(&neighbours, nodes(), span, &self.flow, watch)?;
        if let Some(allowance) = self.bodies.allowance() {
            allowance.spend(segments.iter().map(|segment| segment.steps).sum());
        }
        let body = neighbours.body;
        let mut out = vec![0.0; self.dim];
        let mut along = |write: &dyn Fn(&[f64], &mut [f64])| -> Vec<Vec<f64>> {
            let each = |node| {
                write(node, &mut out);
                out.clone()
            };
            nodes().map(each).collect()
        };
        let rates = along(&|u, du| VectorField::<f64>::eval(body.as_ref(), 0.0, u, du));
        let spins = along(&|u, du| body.spin(u, du));
        let linear = Linear { residual: Vec::new(), matrix: DMatrix::zeros(0, 0), family: Vec::new() };
        let mut local = Local { body, linear, segments, rates, spins };
        local.linear = self.fill(x, &local);
        Ok(local)
    }

    fn linear<'l>(&self, local: &'l Local) -> &'l Linear {
        &local.linear
    }

    fn weights(&self, x: &[f64]) -> Vec<f64> {
        let nodes = self.parts * self.dim;
        let size = self.unit(x);
        let mut weights = vec![1.0 / (self.parts as f64 * size * size); nodes];
        weights.push(1.0 / (x[nodes] * x[nodes]));
        if self.turns {
            weights.push(1.0);
        }
        weights.extend(self.widths.iter().map(|width| 1.0 / (width * width)));
        weights
    }

    fn residual(&self, x: &[f64], local: &Local) -> f64 {
        norm(&local.linear.residual) / self.unit(x)
    }

    fn resolution(&self) -> f64 {
        self.drift
    }

    fn is_sound(&self, x: &[f64]) -> bool {
        x.iter().all(|value| value.is_finite()) && x[self.parts * self.dim] > 0.0
    }

    fn tidy(&self, x: &mut [f64]) {
        let Ok(body) = self.bodies.at(x) else { return };
        for node in x[..self.parts * self.dim].chunks_exact_mut(self.dim) {
            self.classes.tidy(body.as_ref(), node);
        }
    }
}

/// The rates at the nodes without the rotation.
fn reduced_rates(local: &Local) -> Vec<Vec<f64>> {
    local.rates.iter().zip(&local.spins).map(|(rate, spin)| reduced(rate, spin)).collect()
}

/// The rate of a shape without the rotation.
pub(super) fn reduced(rate: &[f64], spin: &[f64]) -> Vec<f64> {
    let size = dot(spin, spin);
    let mut rest = rate.to_vec();
    if size > 0.0 {
        add(&mut rest, -dot(rate, spin) / size, spin);
    }
    rest
}
