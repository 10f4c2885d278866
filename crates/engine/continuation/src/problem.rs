//! The equations of a branch, as its tracer sees them.

use super::correct::TIGHT;
use super::homoclinic::Saddle;
use super::levels::Level;
use super::normal_form::{NormalForm, Order};
use super::passages::Passages;
use super::point::{Motion, Obstruction};
use super::special::{Broken, Special};
use motiform_analysis::Error;
use motiform_analysis::linear::norm;
use motiform_dynamics::{Equivariant, Watch};
use nalgebra::DMatrix;

/// Why there is no solution here.
#[derive(Clone, Debug)]
pub(super) enum Failure {
    /// The watch stopped the computation.
    Stopped,
    /// The mathematics.
    Obstructed(Obstruction),
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self::Obstructed(Obstruction::NoBody { why: error.to_string() })
    }
}

/// The equations at one place: `equations(x + dx) = residual + matrix dx`.
pub(super) struct Linear {
    /// The residual of the equations; zeros in the rows that fix the neutral directions.
    pub(super) residual: Vec<f64>,
    /// Their derivatives: one row fewer than unknowns (two fewer over two parameters).
    pub(super) matrix: DMatrix<f64>,
    /// The borders that hold the directions along a family of solutions, one for each of its dimensions.
    pub(super) family: Vec<Border>,
}

/// A direction along which solutions form a family: one row more, `row . dx = 0`, and one unknown more, a multiple of the combination
/// `left` of the equations, which depend on each other there. At solutions that unknown is 0.
///
/// Source: Munoz-Almaraz, Freire, Galan, Doedel and Vanderbauwhede (2003), Physica D 181, 1 (there of conserved quantities).
#[derive(Clone, Debug)]
pub(super) struct Border {
    /// A combination of the equations.
    pub(super) left: Vec<f64>,
    /// The row.
    pub(super) row: Vec<f64>,
}

/// Equations with fewer of them than unknowns. The parameters are the last unknowns.
pub(super) trait Equations {
    /// Results computed along with the equations at one place.
    type Local;

    /// The equations at `x`.
    fn local(&self, x: &[f64], watch: &dyn Watch) -> Result<Self::Local, Failure>;

    /// Their linear part.
    fn linear<'l>(&self, local: &'l Self::Local) -> &'l Linear;

    /// The unknowns' units, squared and inverted: `|dx|^2 = sum_i weight_i dx_i^2`.
    fn weights(&self, x: &[f64]) -> Vec<f64>;

    /// The size of the residual at a place, in the units of the unknowns.
    fn residual(&self, _x: &[f64], local: &Self::Local) -> f64 {
        norm(&self.linear(local).residual)
    }

    /// The size of steps that round-off of the equations leaves where these are regular, in the units of the unknowns.
    fn resolution(&self) -> f64 {
        0.0
    }

    /// Restores what symmetry makes exact.
    fn tidy(&self, _x: &mut [f64]) {}

    /// Returns `true` if `x` is a solution that makes sense.
    fn is_sound(&self, x: &[f64]) -> bool {
        x.iter().all(|value| value.is_finite())
    }
}

/// The equations of a motion along one parameter, or over two.
pub(super) trait Problem: Equations {
    /// Growth of the reduced deviations, class by class, largest first; without those along a family of solutions.
    fn levels(&self, x: &[f64], local: &Self::Local) -> Option<Vec<Vec<Level>>>;

    /// The directions along a family of solutions in which the branch does not move.
    fn family(&self) -> &[Border];

    /// Sets them.
    fn set_family(&mut self, borders: Vec<Border>);

    /// The error of solutions, in the units of [`Equations::weights`]: what the equations themselves are exact to, not what Newton's method
    /// leaves.
    fn accuracy(&self) -> f64;

    /// The same for the shapes in the model's units.
    fn solved(&self, x: &[f64]) -> f64 {
        self.accuracy() / self.weights(x).first().map_or(f64::NAN, |weight| weight.sqrt())
    }

    /// Sets of unknowns that rotations mix, as masks of a shape; none for orbits.
    fn modes(&self, _local: &Self::Local) -> Vec<Vec<bool>> {
        Vec::new()
    }

    /// The error of the levels that are closest to 0.
    fn noise(&self, levels: &[Vec<Level>]) -> f64;

    /// Below this the growth of a level is within the error of a solution that is known to `tolerance`.
    fn unclear(&self, levels: &[Vec<Level>], tolerance: f64) -> f64 {
        self.noise(levels) * (tolerance / TIGHT).max(1.0)
    }

    /// The kind of special point where a level of class `class` vanishes, and the branch does not turn back.
    fn classify(&self, x: &[f64], critical: Level, class: usize) -> Special;

    /// Number of directions, or pairs, that the symmetry of the motion at `x` makes critical at once.
    fn alike(&self, _x: &[f64], _local: &Self::Local) -> usize {
        1
    }

    /// The motion, as the caller receives it.
    fn motion(&self, x: &[f64], local: &Self::Local, levels: &[Vec<Level>]) -> Motion;

    /// The body at `x`.
    fn body<'l>(&self, local: &'l Self::Local) -> &'l dyn Equivariant;

    /// The same solution in other unknowns, where these have become too few.
    fn refine(&mut self, _x: &[f64], _local: &Self::Local, _watch: &dyn Watch) -> Option<Vec<f64>> {
        None
    }

    /// Takes back what [`Problem::refine`] changed.
    fn coarsen(&mut self) {}

    /// The size of the largest shape.
    fn size(&self, x: &[f64]) -> f64;

    /// The unit of levels.
    fn rate(&self) -> f64 {
        1.0
    }

    /// Returns `true` if the work that may be done is done.
    fn is_spent(&self) -> bool {
        false
    }

    /// The place of the time among the unknowns, for orbits.
    fn time(&self) -> Option<usize> {
        None
    }

    /// The symmetry that the motion at `x` has up to the part `same` of its size and the branch has not, and the same unknowns with that
    /// symmetry of the shapes exact. There the parameter turns back, and the branch goes on with its own images.
    fn gains(&self, _x: &[f64], _local: &Self::Local, _same: f64) -> Option<(Broken, Vec<f64>)> {
        None
    }

    /// The special point at which the motion at `x` gains a symmetry, with the unknowns that have it.
    fn met(&self, _x: &[f64], _symmetric: &[f64], gains: Broken) -> Special {
        gains.special()
    }

    /// The rate of change of the reduced shapes of an orbit, all nodes together: it changes its sign where an orbit shrinks to nothing and
    /// the branch goes on with the same orbits, half a period later.
    fn swing(&self, _local: &Self::Local) -> Option<Vec<f64>> {
        None
    }

    /// The relative equilibrium that an orbit passes closest by, at this value of the parameter.
    fn saddle(&self, _x: &[f64], _local: &Self::Local, _parameter: f64) -> Option<Saddle> {
        None
    }

    /// The equilibria that an orbit passes on its way.
    fn passages(&self, _x: &[f64], _local: &Self::Local) -> Option<Passages> {
        None
    }

    /// The leading coefficient of the normal form at a special point; `doubled` where that of orbits of twice the time is meant.
    fn normal_form(&self, x: &[f64], order: Order, doubled: bool) -> NormalForm;
}
