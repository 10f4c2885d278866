//! One step of an explicit Runge-Kutta method, over any scalar.

use super::tableau::{Tableau, Term};
use crate::simd::{self, Kernel};
use crate::{Scalar, VectorField};

/// The slopes `k_i` of a step and room for one state: allocated once, reused by every step.
#[derive(Clone, Debug)]
pub struct Slopes<T> {
    dim: usize,
    values: Vec<T>,
    argument: Vec<T>,
}

impl<T: Scalar> Slopes<T> {
    /// Room for `tableau` on states like `u`.
    pub fn new(tableau: &Tableau, u: &[T]) -> Self {
        let argument: Vec<T> = u.iter().map(|x| x.zero()).collect();
        Self { dim: u.len(), values: argument.repeat(tableau.slopes()), argument }
    }

    /// The slope number `stage`.
    pub fn get(&self, stage: usize) -> &[T] {
        &self.values[stage * self.dim..(stage + 1) * self.dim]
    }

    /// The slope number `stage`, to be written.
    pub fn get_mut(&mut self, stage: usize) -> &mut [T] {
        &mut self.values[stage * self.dim..(stage + 1) * self.dim]
    }

    /// Copies slope `from` over slope `to`.
    pub fn copy(&mut self, from: usize, to: usize) {
        self.values.copy_within(from * self.dim..(from + 1) * self.dim, to * self.dim);
    }

    /// `out = sum_j c_j k_j` over `terms`, summed in their order.
    #[inline]
    pub fn combine(&self, terms: &[Term], out: &mut [T]) {
        self.sum(Sum { slopes: &self.values, dim: self.dim, terms, from: None }, out);
    }

    /// `out = u + h sum_j c_j k_j`, the sum as in [`Self::combine`].
    #[inline]
    fn advance(&self, terms: &[Term], at: &Step<'_, T>, out: &mut [T]) {
        self.sum(Sum { slopes: &self.values, dim: self.dim, terms, from: Some((at.u, at.h)) }, out);
    }

    /// Long sums with the widest instructions of the machine, whose bits are the same.
    #[inline]
    fn sum(&self, sum: Sum<'_, T>, out: &mut [T]) {
        let sum = Summing { sum, out };
        if T::IN_KERNEL || self.dim < WIDE { sum.run() } else { simd::run(sum) }
    }

    /// Evaluates slope number `stage` at `u + h sum_j c_j k_j`, time `t + node h`.
    #[inline]
    fn evaluate<F: VectorField<T> + ?Sized>(
        &mut self,
        field: &F,
        at: &Step<'_, T>,
        node: f64,
        terms: &[Term],
        stage: usize,
    ) {
        let mut argument = std::mem::take(&mut self.argument);
        self.advance(terms, at, &mut argument);
        field.eval(at.t + at.h * node, &argument, self.get_mut(stage));
        self.argument = argument;
    }
}

/// States from this length on are summed with vector instructions.
const WIDE: usize = 16;

/// Sums over slopes, component by component: `sum_j c_j k_j`, or `u + h sum_j c_j k_j` with `from = (u, h)`.
#[derive(Clone, Copy)]
struct Sum<'s, T: Scalar> {
    slopes: &'s [T],
    dim: usize,
    terms: &'s [Term],
    from: Option<(&'s [T], T::Real)>,
}

impl<T: Scalar> Sum<'_, T> {
    /// The sums of `W` components from `first` on, which stay in registers.
    #[inline(always)]
    fn block<const W: usize>(&self, first: usize, out: &mut [T]) {
        let Some(out) = out[first..].first_chunk_mut::<W>() else { return };
        let mut sums = out.map(Scalar::zero);
        for &(stage, coefficient) in self.terms {
            let Some(slope) = self.slopes[stage * self.dim + first..].first_chunk::<W>() else { return };
            for i in 0..W {
                sums[i] += slope[i] * coefficient;
            }
        }
        if let Some((u, h)) = self.from {
            for i in 0..W {
                sums[i] = u[first + i] + sums[i].scale(h);
            }
        }
        *out = sums;
    }
}

/// A [`Sum`] and where it goes.
struct Summing<'s, T: Scalar> {
    sum: Sum<'s, T>,
    out: &'s mut [T],
}

impl<T: Scalar> Kernel for Summing<'_, T> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let (sum, out) = (self.sum, self.out);
        let mut first = 0;
        macro_rules! blocks {
            ($($width:literal)*) => {$(
                while first + ($width - 1) < sum.dim {
                    sum.block::<$width>(first, out);
                    first += $width;
                }
            )*};
        }
        blocks!(24 8 2 1); // of the widest ones six additions of four numbers are under way at once
    }
}

/// The start of a step and its size.
#[derive(Clone, Copy, Debug)]
pub struct Step<'u, T: Scalar> {
    /// Time at its start.
    pub t: T::Real,
    /// Step size.
    pub h: T::Real,
    /// State at its start.
    pub u: &'u [T],
}

/// One step: `u_new = u + h sum_i b_i k_i`, leaving the stages `k_0 .. k_{s-1}` in `slopes`.
///
/// Slope 0 must hold `f(t, u)` on entry (it is the last step's end slope); see [`end_slope`].
#[inline]
pub fn step<T: Scalar, F: VectorField<T> + ?Sized>(
    tableau: &Tableau,
    field: &F,
    at: &Step<'_, T>,
    slopes: &mut Slopes<T>,
    u_new: &mut [T],
) {
    for stage in 1..tableau.stages() {
        slopes.evaluate(field, at, tableau.nodes[stage], tableau.rows[stage], stage);
    }
    slopes.advance(tableau.weights, at, u_new);
}

/// Evaluates the slope at the end of the step, `f(t + h, u_new)`, into slope number `stages()`.
#[inline]
pub fn end_slope<T: Scalar, F: VectorField<T> + ?Sized>(
    tableau: &Tableau,
    field: &F,
    at: &Step<'_, T>,
    slopes: &mut Slopes<T>,
    u_new: &[T],
) {
    field.eval(at.t + at.h, u_new, slopes.get_mut(tableau.stages()));
}

/// Evaluates the extra stages that dense output needs.
pub fn extra_stages<T: Scalar, F: VectorField<T> + ?Sized>(
    tableau: &Tableau,
    field: &F,
    at: &Step<'_, T>,
    slopes: &mut Slopes<T>,
) {
    let dense = &tableau.dense;
    for (extra, (&node, &row)) in dense.nodes.iter().zip(dense.rows).enumerate() {
        slopes.evaluate(field, at, node, row, tableau.stages() + 1 + extra);
    }
}

/// Marches `steps` fixed steps of size `h` from `(t, u)`, in place: the plain loop, for ensembles in lanes.
///
/// Allocates its work space once, nothing per step. States are not corrected ([`crate::System::project`]).
pub fn march<T: Scalar, F: VectorField<T> + ?Sized>(
    tableau: &Tableau,
    field: &F,
    t: T::Real,
    h: T::Real,
    steps: usize,
    u: &mut Vec<T>,
) {
    let mut slopes = Slopes::new(tableau, u);
    let mut u_new = u.clone();
    for index in 0..steps {
        let at = Step { t: t + h * index as f64, h, u };
        field.eval(at.t, at.u, slopes.get_mut(0));
        step(tableau, field, &at, &mut slopes, &mut u_new);
        std::mem::swap(u, &mut u_new);
    }
}
