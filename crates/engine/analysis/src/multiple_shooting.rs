//! Periodic orbits that one shot over the period cannot resolve.
//!
//! An orbit that rests near a saddle amplifies small deviations by many powers of ten on the way, and loses them again. The matrix of
//! its period then has entries so large that their errors hide its multipliers, and a shape nearly comes back after any time:
//! `|Phi_T(u) - R [M] u|` says nothing. Over a short part of the period nothing is amplified much.
//!
//! Source: Stoer and Bulirsch, Introduction to Numerical Analysis, section 7.3; the product of reduced maps as in Fairgrieve and
//! Jepson (1991), SIAM J. Numer. Anal. 28, 1446.

use crate::Estimate;
use crate::equilibrium::{Units, along_group_and_flow, matrix_of};
use crate::linear::{add, complement, norm, solve};
use crate::multipliers::errors_of_product;
use crate::periodic::{Flow, PeriodicOrbit, back};
use crate::product::logarithms_of_product;
use crate::symmetry::wrap;
use motiform_dynamics::drive::drive;
use motiform_dynamics::{Equivariant, Request, Tangent, Watch};
use nalgebra::DMatrix;

/// The limits on the parts of a period.
struct Limits {
    /// Deviations grow by less than this over one of them,
    growth: f64,
    /// and shrink to no less than this.
    least: f64,
    /// Most parts.
    parts: usize,
}

/// For Newton's method.
const SOLVING: Limits = Limits { growth: 30.0, least: 0.0, parts: 64 };

/// For the exponents of all directions, those that shrink fast as well: what shrinks by more has lost the digits between this and the
/// accuracy of the flow.
const MEASURING: Limits = Limits { growth: 30.0, least: 1e-2, parts: 1024 };

/// With a singular value below this part of the largest, round-off decides how long an orbit rests. (A deviation of `e^(-lambda T)` that
/// grows to order 1 while the orbit rests for `T` makes one of this size.)
const SINGULAR: f64 = 1e-14;

/// Steps that Newton's method may take.
const STEPS: usize = 12;

/// The period may move by this part on the way.
const NEAR: f64 = 0.2;

/// The result of the flow over one part of the period.
struct Part {
    end: Vec<f64>,
    /// `f` at the end.
    slope: Vec<f64>,
    /// `D Phi`, column by column.
    tangents: Vec<f64>,
}

/// Shapes along the orbit, at equal times: `Phi_(T/m)(u_i) = u_(i+1)`, and the last one's image is `R(angle) [M] u_0`.
struct Nodes<'b> {
    body: &'b dyn Equivariant,
    shapes: Vec<Vec<f64>>,
    time: f64,
    angle: f64,
    mirrored: bool,
}

/// Newton's method on shapes all along the orbit, from one that a single shot found; `None` where it does not converge nearby, or
/// the orbit amplifies deviations beyond every number of parts.
///
/// It has converged where the shapes fit to `tolerance` of their size and the last step moved the period by no more than 30 times
/// that part.
///
/// # Checked by  tests/all/long_runs.rs: periods against long runs of another integrator on the index form
pub(crate) fn refine(
    body: &dyn Equivariant,
    orbit: &PeriodicOrbit,
    flow: &Flow,
    tolerance: f64,
    watch: &dyn Watch,
) -> Option<PeriodicOrbit> {
    let (mut nodes, mut parts) = Nodes::along(body, orbit, &SOLVING, flow, watch)?;
    let size = norm(&orbit.shape);
    let mut moved = f64::INFINITY;
    for _ in 0..STEPS {
        let rest = nodes.misfit(&parts);
        let residual = rest.iter().map(|rest| norm(rest)).fold(0.0, f64::max);
        if residual <= tolerance * size && moved <= 30.0 * tolerance {
            return nodes.describe(&parts, residual, flow.accuracy());
        }
        let before = nodes.time;
        nodes.step(&parts, &rest)?;
        moved = (nodes.time / before - 1.0).abs();
        let away = (nodes.time / orbit.time - 1.0).abs();
        if away.is_nan() || away > NEAR {
            return None;
        }
        parts = nodes.parts(flow, watch)?;
    }
    None
}

impl<'b> Nodes<'b> {
    /// Shapes along an orbit, so close that the parts between them keep within the limits.
    fn along(
        body: &'b dyn Equivariant,
        orbit: &PeriodicOrbit,
        limits: &Limits,
        flow: &Flow,
        watch: &dyn Watch,
    ) -> Option<(Self, Vec<Part>)> {
        let PeriodicOrbit { time, angle, mirrored, .. } = *orbit;
        let mut count = 4;
        while count <= limits.parts {
            let mut nodes = Self { body, shapes: Vec::new(), time, angle, mirrored };
            let mut parts: Vec<Part> = Vec::new();
            // One part that is too long is enough to ask for shorter ones.
            while parts.len() < count && parts.last().is_none_or(|part| part.keeps(limits)) {
                let start = parts.last().map_or(&orbit.shape, |part| &part.end).clone();
                parts.push(part(body, &start, time / count as f64, flow, watch)?);
                nodes.shapes.push(start);
            }
            if parts.iter().all(|part| part.keeps(limits)) {
                return Some((nodes, parts));
            }
            count *= 2;
        }
        None
    }

    fn parts(&self, flow: &Flow, watch: &dyn Watch) -> Option<Vec<Part>> {
        let span = self.time / self.shapes.len() as f64;
        self.shapes.iter().map(|shape| part(self.body, shape, span, flow, watch)).collect()
    }

    fn back(&self, x: &mut [f64]) {
        back(self.body, self.angle, self.mirrored, x);
    }

    /// The ends of all parts, less the shapes that follow them; the last one's is brought back.
    fn misfit(&self, parts: &[Part]) -> Vec<Vec<f64>> {
        let rest = |(i, part): (usize, &Part)| {
            let mut rest = part.end.clone();
            if i + 1 == parts.len() {
                self.back(&mut rest);
            }
            add(&mut rest, -1.0, &self.shapes[(i + 1) % parts.len()]);
            rest
        };
        parts.iter().enumerate().map(rest).collect()
    }

    /// One Newton step.
    fn step(&mut self, parts: &[Part], rest: &[Vec<f64>]) -> Option<()> {
        let (count, dim) = (parts.len(), self.shapes[0].len());
        let fixed = self.fixed(0);
        let rows = count * dim + fixed.len();
        let turns = self.body.symmetry().rotations;
        let [time, angle] = Units::of_shape(self.body, &self.shapes[0]).time_and_angle();
        let mut columns = vec![vec![0.0; rows]; count * dim + 1 + usize::from(turns)];
        for (i, part) in parts.iter().enumerate() {
            let last = i + 1 == count;
            let brought = |x: &[f64]| {
                let mut x = x.to_vec();
                if last {
                    self.back(&mut x);
                }
                x
            };
            for (j, tangent) in part.tangents.chunks_exact(dim).enumerate() {
                add(&mut columns[i * dim + j][i * dim..(i + 1) * dim], 1.0, &brought(tangent));
                columns[(i + 1) % count * dim + j][i * dim + j] -= 1.0;
            }
            add(
                &mut columns[count * dim][i * dim..(i + 1) * dim],
                time / count as f64,
                &brought(&part.slope),
            );
            if last && turns {
                let by_angle = self.body.spun(&part.end);
                add(&mut columns[count * dim + 1][i * dim..(i + 1) * dim], -angle, &brought(&by_angle));
            }
        }
        // The first shape moves neither along the orbit nor along the group.
        for (row, fixed) in (count * dim..).zip(fixed) {
            columns.iter_mut().zip(fixed).for_each(|(column, x)| column[row] = x);
        }
        let mut target: Vec<f64> = rest.iter().flatten().map(|x| -x).collect();
        target.resize(rows, 0.0);
        let solution = solve(&columns, &target, SINGULAR)?;
        for (shape, step) in self.shapes.iter_mut().zip(solution.chunks_exact(dim)) {
            add(shape, 1.0, step);
        }
        self.time += time * solution[count * dim];
        self.angle += angle * solution.get(count * dim + 1).unwrap_or(&0.0);
        (self.time > 0.0).then_some(())
    }

    /// Unit vectors along the group and the flow at a node.
    fn fixed(&self, node: usize) -> Vec<Vec<f64>> {
        along_group_and_flow(self.body, &self.shapes[node])
    }

    /// The maps of the parts, each reduced to the directions across the flow and the group; `None` where a node has other neutral
    /// directions than the next.
    fn reduced(&self, parts: &[Part]) -> Option<Vec<DMatrix<f64>>> {
        let (count, dim) = (parts.len(), self.shapes[0].len());
        let across: Vec<DMatrix<f64>> =
            (0..count).map(|node| matrix_of(&complement(&self.fixed(node), dim))).collect();
        let map = |(i, part): (usize, &Part)| {
            let mut columns: Vec<Vec<f64>> = part.tangents.chunks_exact(dim).map(<[f64]>::to_vec).collect();
            if i + 1 == count {
                columns.iter_mut().for_each(|column| self.back(column));
            }
            across[(i + 1) % count].transpose() * matrix_of(&columns) * &across[i]
        };
        let maps: Vec<DMatrix<f64>> = parts.iter().enumerate().map(map).collect();
        maps.iter().all(DMatrix::is_square).then_some(maps)
    }

    /// The orbit with its multipliers, those of the product of the parts' maps.
    fn describe(&self, parts: &[Part], residual: f64, accuracy: f64) -> Option<PeriodicOrbit> {
        let maps = self.reduced(parts)?;
        let logarithms = logarithms_of_product(&maps)?;
        let relative = errors_of_product(&maps, &logarithms, accuracy);
        let multiplier = |&(log, angle): &(f64, f64)| {
            let (modulus, (sin, cos)) = (libm::exp(log), libm::sincos(angle));
            let real = angle == 0.0 || angle.abs() == std::f64::consts::PI;
            (modulus * cos, if real { 0.0 } else { modulus * sin })
        };
        Some(PeriodicOrbit {
            shape: self.shapes[0].clone(),
            time: self.time,
            angle: wrap(self.angle),
            mirrored: self.mirrored,
            residual,
            multipliers: logarithms.iter().map(multiplier).collect(),
            errors: logarithms
                .iter()
                .zip(&relative)
                .map(|(value, error)| libm::exp(value.0) * error)
                .collect(),
        })
    }
}

impl Part {
    /// Returns `true` if it is short enough.
    fn keeps(&self, limits: &Limits) -> bool {
        let dim = self.end.len();
        norm(&self.tangents) < limits.growth && (limits.least == 0.0 || self.least(dim) > limits.least)
    }

    /// The factor by which the direction that shrinks most has shrunk, up to a factor of order 1: the least entry on the diagonal of R.
    fn least(&self, dim: usize) -> f64 {
        let (_, r) = DMatrix::from_column_slice(dim, dim, &self.tangents).qr().unpack();
        r.diagonal().iter().fold(f64::INFINITY, |least, x| least.min(x.abs()))
    }
}

/// The Floquet exponents of an orbit across the flow and the group, largest first, of directions that shrink fast as well; `None` where the
/// maps of the parts do not give them.
pub(crate) fn all_exponents(
    body: &dyn Equivariant,
    orbit: &PeriodicOrbit,
    flow: &Flow,
    watch: &dyn Watch,
) -> Option<Vec<Estimate>> {
    let (nodes, parts) = Nodes::along(body, orbit, &MEASURING, flow, watch)?;
    let maps = nodes.reduced(&parts)?;
    let logarithms = logarithms_of_product(&maps)?;
    let errors = errors_of_product(&maps, &logarithms, flow.accuracy());
    let exponent = |(value, error): (&(f64, f64), &f64)| Estimate {
        value: value.0 / orbit.time,
        error: error / orbit.time,
    };
    Some(logarithms.iter().zip(&errors).map(exponent).collect())
}

/// The flow and all its tangents over `span`; `None` where the run does not reach its end.
fn part(body: &dyn Equivariant, start: &[f64], span: f64, flow: &Flow, watch: &dyn Watch) -> Option<Part> {
    let dim = start.len();
    let field = Tangent::new(body, dim);
    let mut state = start.to_vec();
    state.extend((0..dim * dim).map(|i| if i / dim == i % dim { 1.0 } else { 0.0 }));
    let mut orbit = flow.method.shape_orbit(&field, flow.control, 0.0, &state).ok()?;
    let request = Request { max_steps: flow.max_steps, watch, ..Request::around(span, start) };
    let outcome = drive(orbit.as_mut(), &request, &mut ()).ok()?;
    if !outcome.is_complete() {
        return None;
    }
    let (end, tangents) = orbit.state().split_at(dim);
    let slope = body.rates(end);
    Some(Part { end: end.to_vec(), slope, tangents: tangents.to_vec() })
}
