//! One step of an explicit Runge-Kutta method on states of fixed length, in lanes.
//!
//! The same sums in the same order as [`super::runge_kutta`], so the same bits. All is written out by the compiler, which
//! knows the table. Slopes stay in memory and are read where they are needed, some components at a time: left to itself the
//! compiler keeps them in registers, runs out of these and moves them to and fro (docs/records/lanes.md).

use super::DOP853;
use super::tableau::{ErrorEstimate, Tableau, Term};
use crate::control::{Layout, Tolerance};
use crate::simd::Kernel;
use crate::{Bundle, VectorField};
use std::marker::PhantomData;

/// A method, as a type.
pub trait Method: Copy + Send + Sync + 'static {
    /// Its table.
    const TABLEAU: &'static Tableau;
}

/// [`DOP853`] as a type.
#[derive(Clone, Copy, Debug)]
pub struct Dop853;
impl Method for Dop853 {
    const TABLEAU: &'static Tableau = &DOP853;
}

/// Most slopes that a step may hold.
const SLOPES: usize = 16;

/// After the slopes: the state at the start of the step, and the argument of a stage, at last the new state.
const START: usize = 16;
const NEW: usize = 17;
const ROWS: usize = 18;

/// States up to this length have their stages written out; in longer ones (tangent flows) the field is compiled once, not once
/// per stage: a kernel would take minutes to compile, and gain little.
const WRITTEN_OUT: usize = 8;

/// Components whose sums are held in registers together: the largest divisor of `dim` up to 8.
const fn block(dim: usize) -> usize {
    let mut size = if dim < 8 { dim } else { 8 };
    while size > 1 && !dim.is_multiple_of(size) {
        size -= 1;
    }
    size
}

/// The slopes of a step. Slope `stages()` is the one at its end.
#[derive(Clone, Copy, Debug)]
pub struct StepSlopes<B, const D: usize> {
    /// The slopes.
    pub k: [[B; D]; ROWS],
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

/// The node of a stage; nothing, where there is no such stage.
const fn node(tableau: &'static Tableau, stage: usize) -> f64 {
    if stage < tableau.nodes.len() { tableau.nodes[stage] } else { 0.0 }
}

/// The starts and sizes of a step, lane by lane.
#[derive(Clone, Copy, Debug)]
pub struct LaneStep<'u, B, const D: usize> {
    /// Time at its start.
    pub t: B,
    /// Step size.
    pub h: B,
    /// State at its start.
    pub u: &'u [B; D],
}

/// A step to make, see [`StepSlopes::step`].
struct Step<'s, M, B, F, const D: usize> {
    slopes: &'s mut StepSlopes<B, D>,
    field: &'s F,
    at: &'s LaneStep<'s, B, D>,
    method: PhantomData<M>,
}

impl<M: Method, B: Bundle, F: VectorField<B>, const D: usize> Kernel for Step<'_, M, B, F, D> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        self.slopes.make_step::<M, F>(self.field, self.at);
    }
}

impl<B: Bundle, const D: usize> StepSlopes<B, D> {
    /// Room for the slopes of a step.
    #[inline(always)]
    pub fn zero() -> Self {
        Self { k: [[B::splat(0.0); D]; ROWS] }
    }

    /// The state at the end of the step.
    #[inline(always)]
    pub fn arrival(&self) -> &[B; D] {
        &self.k[NEW]
    }

    /// `sum_j c_j k_j` over the terms of row `ROW`, in their order, of a block of components from `first` on.
    #[inline(always)]
    fn sums<M: Method, const ROW: usize>(&self, first: usize) -> [B; 8] {
        // Hidden, so that nothing read for another row is kept for this one.
        let k = std::hint::black_box(self).k.as_flattened();
        let (stage, coefficient) = const { term(M::TABLEAU, ROW, 0) };
        let mut sums = [B::splat(0.0); 8];
        for i in 0..const { block(D) } {
            sums[i] = k[stage * D + first + i] * coefficient;
        }
        macro_rules! add {
            ($($index:literal)*) => {$(
                if const { $index < terms(M::TABLEAU, ROW) } {
                    let (stage, coefficient) = const { term(M::TABLEAU, ROW, $index) };
                    for i in 0..const { block(D) } {
                        sums[i] = k[stage * D + first + i].mul_add(B::splat(coefficient), sums[i]);
                    }
                }
            )*};
        }
        add!(1 2 3 4 5 6 7 8 9 10 11);
        sums
    }

    /// `u + h sum_j c_j k_j` over the terms of row `ROW`.
    #[inline(always)]
    fn advance<M: Method, const ROW: usize>(&mut self, h: B) {
        for first in (0..D).step_by(const { block(D) }) {
            let sums = self.sums::<M, ROW>(first);
            for i in 0..const { block(D) } {
                self.k[NEW][first + i] = self.k[START][first + i].add_scaled(sums[i], h);
            }
        }
    }

    /// Evaluates the field where the last [`Self::advance`] has come.
    #[inline(always)]
    fn evaluate<F: VectorField<B>>(&mut self, field: &F, t: B, slope: usize) {
        let (slopes, states) = self.k.split_at_mut(SLOPES);
        field.eval(t, &states[NEW - SLOPES], &mut slopes[slope % SLOPES]);
    }

    /// One step: `u_new = u + h sum_i b_i k_i`. Slope 0 must hold `f(t, u)`.
    ///
    /// A function of its own, compiled once for all kernels of this field: it is the longest part of each.
    #[inline(always)]
    pub fn step<M: Method, F: VectorField<B>>(&mut self, field: &F, at: &LaneStep<'_, B, D>) {
        B::apart(Step::<M, B, F, D> { slopes: self, field, at, method: PhantomData });
    }

    #[inline(always)]
    fn make_step<M: Method, F: VectorField<B>>(&mut self, field: &F, at: &LaneStep<'_, B, D>) {
        self.k[START] = *at.u;
        let this = std::hint::black_box(self);
        macro_rules! advance {
            ($stage:expr, $($row:literal)*) => {
                match $stage {
                    $($row if const { $row < M::TABLEAU.stages() } => this.advance::<M, $row>(at.h),)*
                    _ => {}
                }
            };
        }
        macro_rules! written_out {
            ($($row:literal)*) => {$(
                if const { $row < M::TABLEAU.stages() } {
                    this.advance::<M, $row>(at.h);
                    this.evaluate(field, at.t + at.h * const { node(M::TABLEAU, $row) }, $row);
                }
            )*};
        }
        if const { D <= WRITTEN_OUT } {
            written_out!(1 2 3 4 5 6 7 8 9 10 11);
        } else {
            for stage in 1..std::hint::black_box(const { M::TABLEAU.stages() }) {
                advance!(stage, 1 2 3 4 5 6 7 8 9 10 11);
                this.evaluate(field, at.t + at.h * M::TABLEAU.nodes[stage], stage);
            }
        }
        this.advance::<M, WEIGHTS>(at.h);
    }

    /// Evaluates the slope at the end of the step.
    #[inline(always)]
    pub fn end<M: Method, F: VectorField<B>>(&mut self, field: &F, t: B) {
        self.evaluate(field, t, const { M::TABLEAU.stages() });
    }

    /// The mean square of the estimated error, and of the second estimate of a pair.
    #[inline(always)]
    pub(crate) fn errors<M: Method>(&self, tolerance: Tolerance, layout: Layout) -> [B; 2] {
        let (mut first, mut third) = (B::splat(0.0), B::splat(0.0));
        let mut weights = [B::splat(0.0); D];
        tolerance.weights(layout, &self.k[START], &self.k[NEW], &mut weights);
        for start in (0..D).step_by(const { block(D) }) {
            let fifth = self.sums::<M, ERROR>(start);
            for i in 0..const { block(D) } {
                first += Tolerance::square(fifth[i], weights[start + i]);
            }
            if const { matches!(M::TABLEAU.error, ErrorEstimate::Pair { .. }) } {
                let sums = self.sums::<M, THIRD>(start);
                for i in 0..const { block(D) } {
                    third += Tolerance::square(sums[i], weights[start + i]);
                }
            }
        }
        [first * (1.0 / D as f64), third * (1.0 / D as f64)]
    }

    /// Evaluates the extra stages of dense output; the slope at the end must be there.
    #[inline(always)]
    pub(crate) fn extra<M: Method, F: VectorField<B>>(&mut self, field: &F, at: &LaneStep<'_, B, D>) {
        let dense = &M::TABLEAU.dense;
        self.k[START] = *at.u;
        for extra in 0..dense.rows.len() {
            match extra {
                0 => self.advance::<M, EXTRA>(at.h),
                1 => self.advance::<M, { EXTRA + 1 }>(at.h),
                _ => self.advance::<M, { EXTRA + 2 }>(at.h),
            }
            self.evaluate(field, at.t + at.h * dense.nodes[extra], M::TABLEAU.stages() + 1 + extra);
        }
    }

    /// The coefficients of dense output after the third (see [`super::tableau::Dense`]); as many as the method has are
    /// filled in.
    #[inline(always)]
    pub(crate) fn dense<M: Method>(&self, h: B, coefficients: &mut [[B; D]]) {
        macro_rules! rows {
            ($($m:literal)*) => {$(
                if const { $m < M::TABLEAU.dense.weights.len() } {
                    for first in (0..D).step_by(const { block(D) }) {
                        let sums = self.sums::<M, { DENSE + $m }>(first);
                        for i in 0..const { block(D) } {
                            coefficients[$m][first + i] = sums[i] * h;
                        }
                    }
                }
            )*};
        }
        rows!(0 1 2 3);
    }
}
