//! The equations of relative equilibria along a parameter.

use super::classes::{Classes, GAINED};
use super::correct::{TIGHT, correct, normal, scaled};
use super::family::{Bodies, Neighbours, Sides};
use super::hopf::first_lyapunov;
use super::levels::{ALONG_FAMILY, Level, across_family};
use super::normal_form::{NormalForm, Order};
use super::normal_forms::of_equilibrium;
use super::oscillation::Oscillation;
use super::point::Motion;
use super::problem::{Border, Equations, Failure, Linear, Problem};
use super::special::{Broken, Hopf, Special};
use super::vicinity::Vicinity;
use motiform_analysis::equilibrium::Units;
use motiform_analysis::equilibrium::{modes, neutral_direction, rounding};
use motiform_analysis::linear::{add, apply, eigenvalues, norm, restrict, sort_leading};
use motiform_analysis::singular::svd;
use motiform_analysis::{Isotropy, RelativeEquilibrium};
use motiform_dynamics::sample::ascending;
use motiform_dynamics::tangent::jacobian;
use motiform_dynamics::{Equivariant, Watch, model};
use nalgebra::DMatrix;

/// The unit of the shape is at least this part of its own size: a branch that begins small keeps the steps of its beginning until it has
/// grown to four times that.
pub(super) const GROWN: f64 = 0.25;

/// A shape that vanishes at a rate of turning above this part of the rate of the equations is a wave.
const TURNS: f64 = 1e-4;

/// Distances at which members of a family with one value of the parameter are looked for, in sizes of the shape, and the residual of the
/// equations with that value, in errors of solutions, below which they are members.
const FAMILY: [f64; 2] = [0.05, 0.1];
const SOLVED: f64 = 10.0;

/// `f(u, p) - omega G u = 0` and `Gu . du = 0`; unknowns `(u, omega, p)`. Without a neutral direction (a circle, a system without
/// symmetry) omega means nothing and is held instead.
pub(super) struct Equilibria<'f> {
    pub(super) bodies: Bodies<'f>,
    pub(super) classes: Classes,
    /// Length of the state.
    pub(super) dim: usize,
    /// The scale of the shapes; the unit of one that changes by far more is a part of its change.
    pub(super) vicinity: Vicinity,
    /// Units of the parameters.
    pub(super) widths: Vec<f64>,
    /// A family of equilibria through each of a branch.
    pub(super) family: Vec<Border>,
}

/// The equations at one place.
pub(super) struct Local {
    pub(super) body: Box<dyn Equivariant>,
    pub(super) linear: Linear,
    /// `Df - omega G`, column by column.
    pub(super) matrix: Vec<f64>,
    pub(super) neutral: Vec<Vec<f64>>,
}

impl<'f> Equilibria<'f> {
    /// The equations near a relative equilibrium, whose symmetry the branch keeps.
    pub(super) fn near(
        bodies: Bodies<'f>,
        parameters: &[f64],
        shape: &[f64],
        widths: &[f64],
    ) -> Result<Self, motiform_analysis::Error> {
        let body = bodies.at(parameters)?;
        let classes = Classes::of(body.as_ref(), &[shape]);
        let vicinity = bodies.vicinity(body.as_ref(), (parameters, widths), &[shape]);
        let (dim, widths) = (shape.len(), widths.to_vec());
        Ok(Self { bodies, classes, dim, vicinity, widths, family: Vec::new() })
    }
}

/// The columns of `Df - omega G`.
pub(super) fn linearisation(body: &dyn Equivariant, shape: &[f64], omega: f64) -> Vec<f64> {
    let mut matrix = jacobian(body, shape);
    let dim = shape.len();
    let (mut unit, mut spin) = (vec![0.0; dim], vec![0.0; dim]);
    for (j, column) in matrix.chunks_exact_mut(dim).enumerate() {
        unit[j] = 1.0;
        body.spin(&unit, &mut spin); // the action is linear
        unit[j] = 0.0;
        add(column, -omega, &spin);
    }
    matrix
}

impl Equations for Equilibria<'_> {
    type Local = Local;

    fn local(&self, x: &[f64], _watch: &dyn Watch) -> Result<Local, Failure> {
        let (shape, omega) = (&x[..self.dim], x[self.dim]);
        let &Vicinity { units, round_off, .. } = &self.vicinity;
        let Neighbours { body, sides, .. } =
            Neighbours::of(self.bodies, x, &self.widths, (units.length, round_off))?;
        let matrix = linearisation(body.as_ref(), shape, omega);
        let neutral = neutral_direction(body.as_ref(), shape);
        let linear = Linear { residual: Vec::new(), matrix: DMatrix::zeros(0, 0), family: Vec::new() };
        let mut local = Local { body, linear, matrix, neutral };
        local.linear = self.fill(shape, omega, &sides, &local);
        Ok(local)
    }

    fn linear<'l>(&self, local: &'l Local) -> &'l Linear {
        &local.linear
    }

    fn weights(&self, x: &[f64]) -> Vec<f64> {
        let rate = self.vicinity.units.rate;
        let mut weights: Vec<f64> = self.sizes(x).iter().map(|size| 1.0 / (size * size)).collect();
        weights.push(1.0 / (rate * rate));
        weights.extend(self.widths.iter().map(|width| 1.0 / (width * width)));
        weights
    }

    fn resolution(&self) -> f64 {
        self.vicinity.round_off
    }

    fn tidy(&self, x: &mut [f64]) {
        let Ok(body) = self.bodies.at(x) else { return };
        self.classes.tidy(body.as_ref(), &mut x[..self.dim]);
        if self.classes.axis.is_some() {
            x[self.dim] = 0.0;
        }
    }
}

impl Problem for Equilibria<'_> {
    fn levels(&self, _x: &[f64], local: &Local) -> Option<Vec<Vec<Level>>> {
        let classes = self.classes.without(&local.neutral);
        let of = |class: &Vec<Vec<f64>>| {
            eigenvalues(&restrict(class, |v| apply(&local.matrix, v))).map(|v| Level::of_pairs(&v))
        };
        let all: Option<Vec<Vec<Level>>> = classes.iter().map(of).collect();
        all.map(|levels| across_family(levels, self.family.len()))
    }

    fn family(&self) -> &[Border] {
        &self.family
    }

    fn set_family(&mut self, borders: Vec<Border>) {
        self.family = borders;
    }

    fn accuracy(&self) -> f64 {
        TIGHT.max(self.vicinity.round_off)
    }

    fn noise(&self, levels: &[Vec<Level>]) -> f64 {
        // that of the solutions, as rates change by their own size over a shape's; fast modes have no part in the slow ones: of the slow
        // half
        let mut sizes: Vec<f64> =
            levels.iter().flatten().map(|level| level.growth.hypot(level.angle)).collect();
        ascending(&mut sizes);
        let slow = sizes.get(sizes.len() / 2).copied().unwrap_or(1.0);
        TIGHT * slow + self.vicinity.round_off * self.vicinity.units.rate
    }

    fn unclear(&self, _levels: &[Vec<Level>], _tolerance: f64) -> f64 {
        // slow rates change by the unit of rates over the size of a shape; fast modes, whose rates are millions of it, have no part in them
        self.accuracy() * self.vicinity.units.rate
    }

    fn classify(&self, x: &[f64], critical: Level, class: usize) -> Special {
        let Ok(local) = self.local(x, &()) else { return Special::BranchPoint };
        if critical.angle != 0.0 {
            let (body, shape, frequency) = (local.body.as_ref(), &x[..self.dim], critical.angle.abs());
            let part = Oscillation::all(body, shape, frequency).first().map_or(1.0, Oscillation::period_part);
            let scale = (self.extent(x), self.vicinity.units.length);
            let first_lyapunov = first_lyapunov(body, shape, frequency, self.solved(x), scale);
            return Special::Hopf(Hopf { frequency, part, first_lyapunov });
        }
        let body = local.body.as_ref();
        let vector = self.critical_vector(&local, class);
        match vector {
            Some(v) if self.is_one_of_a_family(x, &v) => Special::Continuum,
            Some(v) if self.classes.breaks_rotations(body, &v) => {
                Special::Pitchfork { breaks: Broken::Rotations }
            }
            _ if class == 1 => Special::Pitchfork { breaks: Broken::Mirror },
            _ => Special::BranchPoint,
        }
    }

    fn alike(&self, x: &[f64], local: &Local) -> usize {
        let body = local.body.as_ref();
        let found = Isotropy::of(body, &x[..self.dim], GAINED);
        let mixes = body.symmetry().rotations && (found.circle || found.folds > 2);
        if mixes { 2 } else { 1 }
    }

    fn motion(&self, x: &[f64], local: &Local, levels: &[Vec<Level>]) -> Motion {
        let shape = x[..self.dim].to_vec();
        let along = std::iter::repeat_n(&ALONG_FAMILY, self.family.len());
        let mut eigenvalues: Vec<(f64, f64)> =
            levels.iter().flatten().chain(along).map(|level| (level.growth, level.angle)).collect();
        sort_leading(&mut eigenvalues);
        let neutral = local.neutral.len();
        let scale = local.matrix.iter().fold(0.0, |m: f64, a| m.max(a.abs()));
        let units = self.vicinity.units;
        Motion::Equilibrium(RelativeEquilibrium {
            velocity: model::velocity(local.body.as_ref(), &shape),
            turning_rate: if neutral == 0 { 0.0 } else { x[self.dim] },
            residual: norm(&local.linear.residual) * units.length * units.rate,
            errors: vec![rounding(self.dim, scale); eigenvalues.len()],
            eigenvalues,
            neutral,
            scale,
            shape,
        })
    }

    fn gains(&self, x: &[f64], local: &Local, same: f64) -> Option<(Broken, Vec<f64>)> {
        let (body, shape) = (local.body.as_ref(), &x[..self.dim]);
        if self.classes.circle {
            return None;
        }
        let mut symmetric = x.to_vec();
        let vanishes = norm(shape) < same * self.vicinity.size;
        if vanishes && body.symmetry().rotations {
            symmetric[..=self.dim].fill(0.0);
            return Some((Broken::Rotations, symmetric));
        }
        // a shape that is as good as nothing has the mirror axis of nothing, whatever is left of it
        let nothing = vec![0.0; self.dim];
        let found = Classes::within(body, &[if vanishes { &nothing } else { shape }], same);
        found.tidy(body, &mut symmetric[..self.dim]);
        if found.circle || found.folds > self.classes.folds {
            return Some((Broken::Rotations, symmetric));
        }
        symmetric[self.dim] = 0.0;
        (found.axis.is_some() && self.classes.axis.is_none()).then_some((Broken::Mirror, symmetric))
    }

    /// A shape that turns while it vanishes is a wave of the motion with more symmetry, which oscillates there.
    fn met(&self, x: &[f64], symmetric: &[f64], gains: Broken) -> Special {
        let (pitchfork, turns) = (gains.special(), |rate: f64| rate.abs() > TURNS * self.vicinity.units.rate);
        let Ok(local) = self.local(symmetric, &()) else { return pitchfork };
        let columns: Vec<Vec<f64>> = local.matrix.chunks(self.dim).map(<[f64]>::to_vec).collect();
        let all = Level::of_pairs(&eigenvalues(&columns).unwrap_or_default());
        let critical = all.iter().min_by(|a, b| a.growth.abs().total_cmp(&b.growth.abs()));
        match critical {
            Some(level) if gains == Broken::Rotations && turns(x[self.dim]) && turns(level.angle) => {
                self.classify(symmetric, Level { growth: 0.0, angle: level.angle }, 0)
            }
            _ => pitchfork,
        }
    }

    fn normal_form(&self, x: &[f64], order: Order, _doubled: bool) -> NormalForm {
        of_equilibrium(self, x, order)
    }

    fn modes(&self, local: &Local) -> Vec<Vec<bool>> {
        modes(local.body.as_ref(), self.dim)
    }

    fn body<'l>(&self, local: &'l Local) -> &'l dyn Equivariant {
        local.body.as_ref()
    }

    fn size(&self, x: &[f64]) -> f64 {
        norm(&x[..self.dim])
    }

    fn rate(&self) -> f64 {
        self.vicinity.units.rate
    }
}

impl Equilibria<'_> {
    /// The units of the entries of the shape. A branch that begins small may grow by powers of ten: its steps grow with it. Beside an
    /// offset each entry is one of its own: one that changes by powers of ten says nothing about the others.
    fn sizes(&self, x: &[f64]) -> Vec<f64> {
        let Vicinity { centre, size, .. } = &self.vicinity;
        let shape = &x[..self.dim];
        if self.vicinity.is_offset() {
            return shape.iter().zip(centre).map(|(u, c)| size.max(GROWN * (u - c).abs())).collect();
        }
        vec![size.max(GROWN * norm(shape)); self.dim]
    }

    /// The size of the shape, or beside an offset that of its changes.
    pub(super) fn extent(&self, x: &[f64]) -> f64 {
        if self.vicinity.is_offset() { self.vicinity.size } else { norm(&x[..self.dim]) }
    }

    /// The equations, in their units. What breaks the symmetry of the shape is left to itself, `du = 0`: where such a deviation is critical
    /// the equations of the motion itself stay regular.
    fn fill(&self, shape: &[f64], omega: f64, sides: &[Sides], local: &Local) -> Linear {
        let (dim, body) = (self.dim, local.body.as_ref());
        let spin = body.spun(shape);
        let mut residual = body.rates(shape);
        add(&mut residual, -omega, &spin);
        residual.push(0.0);
        let mut all = DMatrix::zeros(dim + 1, dim + 1 + sides.len());
        let Units { length, rate: pace } = self.vicinity.units;
        let unit = length * pace;
        residual.iter_mut().for_each(|value| *value /= unit);
        let mut put = |column: usize, values: &[f64]| {
            values.iter().enumerate().for_each(|(i, value)| all[(i, column)] = *value / unit);
        };
        for j in 0..dim {
            put(j, &self.classes.kept(body, &local.matrix, j, -pace));
        }
        put(dim, &spin.iter().map(|g| -g).collect::<Vec<f64>>());
        for (j, Sides { above, below, width }) in sides.iter().enumerate() {
            let mut slope = above.rates(shape);
            add(&mut slope, -1.0, &below.rates(shape));
            slope.iter_mut().for_each(|value| *value /= width);
            put(dim + 1 + j, &slope);
        }
        match local.neutral.first() {
            Some(direction) => direction.iter().enumerate().for_each(|(j, g)| all[(dim, j)] = *g / length),
            None => all[(dim, dim)] = 1.0 / pace,
        }
        Linear { residual, matrix: all, family: self.family.clone() }
    }

    /// The equations of all motions nearby, whatever their symmetry.
    pub(super) fn free(&self, x: &[f64]) -> Option<Self> {
        let classes = Classes::of(self.bodies.at(x).ok()?.as_ref(), &[]);
        let widths = self.widths.clone();
        let (bodies, dim, vicinity, family) = (self.bodies, self.dim, self.vicinity.clone(), Vec::new());
        Some(Self { bodies, classes, dim, vicinity, widths, family })
    }

    /// Returns `true` if motions in the direction `vector` exist for the same parameter, at two distances: beside a pitchfork the parameter
    /// changes as the square of the distance.
    fn is_one_of_a_family(&self, x: &[f64], vector: &[f64]) -> bool {
        let Some(free) = self.free(x) else { return false };
        let weights = free.weights(x);
        let mut direction = vector.to_vec();
        direction.resize(x.len(), 0.0);
        let Some(direction) = scaled(direction, &weights) else { return false };
        let row = normal(&direction, &weights);
        let last = x.len() - 1;
        // close to nothing a part of the shape is too short to see the parameter change
        let longer = (FAMILY[0] * self.vicinity.units.length / norm(&direction[..self.dim])).max(1.0);
        // the unit beside an offset is a part of what it is elsewhere
        let longer = if self.vicinity.is_offset() { longer / GROWN } else { longer };
        FAMILY.iter().all(|distance| {
            let guess = x.iter().zip(&direction).map(|(x, d)| x + distance * longer * d).collect();
            let Ok(mut found) = correct(&free, guess, &row, TIGHT, &()) else { return false };
            found.x[last] = x[last];
            let residual = free.local(&found.x, &()).map(|local| free.residual(&found.x, &local));
            residual.is_ok_and(|residual| residual < SOLVED * self.accuracy())
        })
    }

    /// The direction of class `class` that neither grows nor decays at a steady bifurcation.
    fn critical_vector(&self, local: &Local, class: usize) -> Option<Vec<f64>> {
        let bases = self.classes.without(&local.neutral);
        let basis = bases.get(class)?;
        let columns = restrict(basis, |v| apply(&local.matrix, v));
        let dim = columns.len();
        let svd = svd(DMatrix::from_fn(dim, dim, |i, j| columns[j][i]))?;
        let (place, _) = svd.singular_values.argmin();
        let mut out = vec![0.0; self.dim];
        for (direction, &part) in basis.iter().zip(svd.v_t?.row(place).iter()) {
            add(&mut out, part, direction);
        }
        Some(out)
    }
}
