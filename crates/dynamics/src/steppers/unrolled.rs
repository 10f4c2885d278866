//! One step of an explicit Runge-Kutta method on states of fixed length, in lanes.
//!
//! The same sums in the same order as [`super::runge_kutta`], so the same bits. The terms of a sum are written out by the
//! compiler, which knows the table; the loops over stages and components are not: a step of DOP853 written out is 15 kB of
//! instructions, which the processor fetches more slowly than it computes them (docs/lanes.md).

use super::tableau::{ErrorEstimate, Tableau, Term};
use super::{DOP853, DOPRI5, RK4};
use crate::control::Tolerance;
use crate::{Bundle, VectorField};

/// A method, as a type.
pub trait Method: Copy + Send + Sync + 'static {
    /// Its table.
    const TABLEAU: &'static Tableau;
}

/// [`RK4`] as a type.
#[derive(Clone, Copy, Debug)]
pub struct Rk4;
impl Method for Rk4 {
    const TABLEAU: &'static Tableau = &RK4;
}

/// [`DOPRI5`] as a type.
#[derive(Clone, Copy, Debug)]
pub struct Dopri5;
impl Method for Dopri5 {
    const TABLEAU: &'static Tableau = &DOPRI5;
}

/// [`DOP853`] as a type.
#[derive(Clone, Copy, Debug)]
pub struct Dop853;
impl Method for Dop853 {
    const TABLEAU: &'static Tableau = &DOP853;
}

/// Most slopes that a step may hold.
const SLOPES: usize = 16;

/// The slopes of a step. Slope `stages()` is the one at its end.
#[derive(Clone, Copy, Debug)]
pub struct StepSlopes<B, const D: usize> {
    /// The slopes.
    pub k: [[B; D]; SLOPES],
    /// `D`, kept from the compiler so that it leaves loops over components as they are.
    dim: usize,
}

/// Rows of coefficients: the stages come first, then these.
const WEIGHTS: usize = 16;
const ERROR: usize = 17;
const THIRD: usize = 18;
const EXTRA: usize = 20;
const DENSE: usize = 24;

/// A row of coefficients; nothing, where the method does not have it (such a row is never used).
const fn row(tableau: &'static Tableau, row: usize) -> &'static [Term] {
    match row {
        WEIGHTS => tableau.weights,
        ERROR => match tableau.error {
            ErrorEstimate::None => &[],
            ErrorEstimate::Embedded { weights, .. } => weights,
            ErrorEstimate::Pair { fifth, .. } => fifth,
        },
        THIRD => match tableau.error {
            ErrorEstimate::Pair { third, .. } => third,
            _ => &[],
        },
        EXTRA..DENSE => entry(tableau.dense.rows, row - EXTRA),
        DENSE.. => entry(tableau.dense.weights, row - DENSE),
        _ => entry(tableau.rows, row),
    }
}

const fn entry(rows: &'static [&'static [Term]], index: usize) -> &'static [Term] {
    if index < rows.len() { rows[index] } else { &[] }
}

const fn terms(tableau: &'static Tableau, number: usize) -> usize {
    row(tableau, number).len()
}

/// Term `index` of a row; nothing, where the row is shorter (such a term is never used).
const fn term(tableau: &'static Tableau, number: usize, index: usize) -> Term {
    let row = row(tableau, number);
    if index < row.len() { row[index] } else { (0, 0.0) }
}

/// Where a step starts and how long it is, lane by lane.
#[derive(Clone, Copy, Debug)]
pub struct LaneStep<'u, B, const D: usize> {
    /// Time at its start.
    pub t: B,
    /// Step size.
    pub h: B,
    /// State at its start.
    pub u: &'u [B; D],
}

impl<B: Bundle, const D: usize> StepSlopes<B, D> {
    /// Room for the slopes of a step.
    #[inline(always)]
    pub fn zero() -> Self {
        Self { k: [[B::splat(0.0); D]; SLOPES], dim: std::hint::black_box(D) }
    }

    /// `sum_j c_j k_j` of one component over the terms of row `ROW`, in their order.
    #[inline(always)]
    fn sum<M: Method, const ROW: usize>(&self, component: usize) -> B {
        let (stage, coefficient) = const { term(M::TABLEAU, ROW, 0) };
        let mut sum = self.k[stage][component] * coefficient;
        macro_rules! add {
            ($($index:literal)*) => {$(
                if const { $index < terms(M::TABLEAU, ROW) } {
                    let (stage, coefficient) = const { term(M::TABLEAU, ROW, $index) };
                    sum = self.k[stage][component].mul_add(B::splat(coefficient), sum);
                }
            )*};
        }
        add!(1 2 3 4 5 6 7 8 9 10 11);
        sum
    }

    /// `u + h sum_j c_j k_j` over the terms of row `ROW`.
    #[inline(always)]
    fn advanced<M: Method, const ROW: usize>(&self, at: &LaneStep<'_, B, D>, new: &mut [B; D]) {
        for i in 0..self.dim.min(D) {
            new[i] = at.u[i].add_scaled(self.sum::<M, ROW>(i), at.h);
        }
    }

    /// One step: `u_new = u + h sum_i b_i k_i`. Slope 0 must hold `f(t, u)`.
    #[inline(always)]
    pub fn step<M: Method, F: VectorField<B>>(&mut self, field: &F, at: &LaneStep<'_, B, D>) -> [B; D] {
        let mut new = *at.u;
        for stage in 1..std::hint::black_box(const { M::TABLEAU.stages() }) {
            macro_rules! rows {
                ($($row:literal)*) => {
                    match stage {
                        $($row if const { $row < M::TABLEAU.stages() } => self.advanced::<M, $row>(at, &mut new),)*
                        _ => {}
                    }
                };
            }
            rows!(1 2 3 4 5 6 7 8 9 10 11);
            let node = M::TABLEAU.nodes[stage];
            field.eval(at.t + at.h * node, &new, &mut self.k[stage % SLOPES]);
        }
        self.advanced::<M, WEIGHTS>(at, &mut new);
        new
    }

    /// Evaluates the slope at the end of the step.
    #[inline(always)]
    pub fn end<M: Method, F: VectorField<B>>(&mut self, field: &F, t: B, new: &[B; D]) {
        field.eval(t, new, &mut self.k[M::TABLEAU.stages()]);
    }

    /// The mean square of the estimated error, and of the second estimate of a pair, of a step to `new`.
    #[inline(always)]
    pub(crate) fn errors<M: Method>(&self, tolerance: Tolerance, u: &[B; D], new: &[B; D]) -> [B; 2] {
        let (mut first, mut third) = (B::splat(0.0), B::splat(0.0));
        for i in 0..self.dim.min(D) {
            let weight = tolerance.weight(u[i], new[i]);
            first += Tolerance::square(self.sum::<M, ERROR>(i), weight);
            if const { matches!(M::TABLEAU.error, ErrorEstimate::Pair { .. }) } {
                third += Tolerance::square(self.sum::<M, THIRD>(i), weight);
            }
        }
        [first * (1.0 / D as f64), third * (1.0 / D as f64)]
    }

    /// Evaluates the extra stages of dense output; the slope at the end must be there.
    #[inline(always)]
    pub(crate) fn extra<M: Method, F: VectorField<B>>(&mut self, field: &F, at: &LaneStep<'_, B, D>) {
        let dense = &M::TABLEAU.dense;
        let mut argument = *at.u;
        for extra in 0..dense.rows.len() {
            match extra {
                0 => self.advanced::<M, EXTRA>(at, &mut argument),
                1 => self.advanced::<M, { EXTRA + 1 }>(at, &mut argument),
                _ => self.advanced::<M, { EXTRA + 2 }>(at, &mut argument),
            }
            let to = M::TABLEAU.stages() + 1 + extra;
            field.eval(at.t + at.h * dense.nodes[extra], &argument, &mut self.k[to % SLOPES]);
        }
    }

    /// The coefficients of dense output after the third (see [`super::tableau::Dense`]); as many as the method has are
    /// filled in.
    #[inline(always)]
    pub(crate) fn dense<M: Method>(&self, h: B, coefficients: &mut [[B; D]]) {
        macro_rules! rows {
            ($($m:literal)*) => {$(
                if const { $m < M::TABLEAU.dense.weights.len() } {
                    for i in 0..self.dim.min(D) {
                        coefficients[$m][i] = self.sum::<M, { DENSE + $m }>(i) * h;
                    }
                }
            )*};
        }
        rows!(0 1 2 3);
    }
}
