//! Exponential Runge-Kutta methods as data, for `u' = Lambda u + N(t, u)`.

use super::phi_functions::{etdrk4_weights, phi};
use crate::Semilinear;
use crate::simd::{self, Kernel};

/// The functions in the coefficients of a method, at `z = h lambda`.
#[derive(Clone, Copy, Debug)]
pub struct PhiValues {
    /// `phi_0 .. phi_3` at `z / 2`.
    pub half: [f64; 4],
    /// `phi_0 .. phi_3` at `z`.
    pub full: [f64; 4],
    /// `phi1 - 3 phi2 + 4 phi3`, `phi2 - 2 phi3`, `4 phi3 - phi2` at `z`.
    pub weights: [f64; 3],
}

impl PhiValues {
    /// All of them at `z`.
    pub fn at(z: f64) -> Self {
        Self { half: phi(0.5 * z), full: phi(z), weights: etdrk4_weights(z) }
    }
}

/// One term of a combination of stages: `(stage, coefficient)`, the coefficient a function of `h lambda`.
pub type ExponentialTerm = (usize, fn(&PhiValues) -> f64);

/// The position of a stage in the step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Node {
    /// `t + h/2`, reached by `e^{z/2}`.
    Half,
    /// `t + h`, reached by `e^z`.
    Full,
}

/// An explicit exponential Runge-Kutta method: all data of a step.
///
/// With `N_i = N(t + c_i h, U_i)` the stages are `U_i = e^{c_i z} u + h sum_j a_ij(z) N_j` and the step is
/// `u_new = e^z u + h sum_i b_i(z) N_i`, mode by mode with `z = h lambda`. Stage 0 is the start; index `stages()`
/// stands for `N(t + h, u_new)`, the next step's first stage.
#[derive(Debug)]
pub struct ExponentialTableau {
    /// Name on the command line and in files.
    pub name: &'static str,
    /// Order of the global error, if the solution is smooth on the step.
    pub order: u32,
    /// The stages after the first: their positions and rows `a_ij`.
    pub rows: &'static [(Node, &'static [ExponentialTerm])],
    /// Weights `b_i`.
    pub weights: &'static [ExponentialTerm],
    /// Weights of the difference to the embedded method of order `order - 1`, if there is one.
    pub error: Option<&'static [ExponentialTerm]>,
}

impl ExponentialTableau {
    /// Number of stages (evaluations of `N` per step).
    pub const fn stages(&self) -> usize {
        self.rows.len() + 1
    }

    /// Returns `true` if the method can control its step.
    pub const fn is_adaptive(&self) -> bool {
        self.error.is_some()
    }

    /// Order of the dense output (cubic Hermite).
    pub const fn dense_order(&self) -> u32 {
        if self.order < 4 { self.order } else { 4 }
    }

    /// The terms of a step, without the error estimate.
    pub(crate) fn step_terms(&self) -> impl Iterator<Item = &'static ExponentialTerm> {
        self.rows.iter().flat_map(|row| row.1).chain(self.weights)
    }

    /// All terms in the order of [`StepTable`].
    fn terms(&self) -> impl Iterator<Item = &'static ExponentialTerm> {
        self.step_terms().chain(self.error.unwrap_or(&[]))
    }
}

/// The coefficients of a method for one step size: computed once per size, which makes exponential steps cheap.
#[derive(Clone, Debug)]
pub(crate) struct StepTable {
    h: f64,
    dim: usize,
    /// Rows of `dim` numbers: `e^{z/2}`, `e^z`, then `h` times the coefficient of each term.
    values: Vec<f64>,
}

impl StepTable {
    /// Space for the coefficients of `tableau` on `dim` modes.
    pub(crate) fn new(tableau: &ExponentialTableau, dim: usize) -> Self {
        Self { h: f64::NAN, dim, values: vec![0.0; (2 + tableau.terms().count()) * dim] }
    }

    /// Computes the coefficients for step size `h` (unless they are already computed).
    pub(crate) fn fill(&mut self, tableau: &ExponentialTableau, lambda: &[f64], h: f64) {
        if self.h == h {
            return;
        }
        self.h = h;
        let mut known = (f64::NAN, PhiValues::at(0.0));
        for (i, &rate) in lambda.iter().enumerate() {
            if rate != known.0 {
                known = (rate, PhiValues::at(h * rate)); // real and imaginary parts share theirs
            }
            let values = &known.1;
            self.values[i] = values.half[0];
            self.values[self.dim + i] = values.full[0];
            for (row, (_, coefficient)) in tableau.terms().enumerate() {
                self.values[(2 + row) * self.dim + i] = h * coefficient(values);
            }
        }
    }

    fn row(&self, row: usize) -> &[f64] {
        &self.values[row * self.dim..(row + 1) * self.dim]
    }

    fn propagator(&self, node: Node) -> &[f64] {
        self.row(usize::from(node == Node::Full))
    }

    /// `out = base + sum_j c_j N_j` over `terms`, whose coefficients start at `row`.
    #[inline]
    fn combine(
        &self,
        base: Option<[&[f64]; 2]>,
        terms: &[ExponentialTerm],
        row: usize,
        stages: &Stages,
        out: &mut [f64],
    ) {
        let coefficients = &self.values[(2 + row) * self.dim..];
        simd::run(Combination { base, terms, coefficients, slopes: &stages.values, out });
    }
}

/// `out = e u + sum_j c_j N_j`, number by number, or without the first term; summed in the order of the terms.
struct Combination<'a> {
    base: Option<[&'a [f64]; 2]>,
    terms: &'a [ExponentialTerm],
    coefficients: &'a [f64],
    slopes: &'a [f64],
    out: &'a mut [f64],
}

/// Numbers summed at a time: they stay in registers.
const BLOCK: usize = 8;

impl Kernel for Combination<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let whole = self.out.len() / BLOCK * BLOCK;
        for first in (0..whole).step_by(BLOCK) {
            let sums = self.at::<BLOCK>(first);
            self.out[first..first + BLOCK].copy_from_slice(&sums);
        }
        for i in whole..self.out.len() {
            self.out[i] = self.at::<1>(i)[0];
        }
    }
}

impl Combination<'_> {
    /// `N` of the sums.
    #[inline(always)]
    fn at<const N: usize>(&self, first: usize) -> [f64; N] {
        let dim = self.out.len();
        let mut sums = [0.0; N];
        if let Some([factor, u]) = self.base {
            let (factor, u) = (&factor[first..first + N], &u[first..first + N]);
            for i in 0..N {
                sums[i] = factor[i] * u[i];
            }
        }
        for (place, &(stage, _)) in self.terms.iter().enumerate() {
            let (row, slope) = (place * dim + first, stage * dim + first);
            let (c, n) = (&self.coefficients[row..row + N], &self.slopes[slope..slope + N]);
            for i in 0..N {
                sums[i] += c[i] * n[i];
            }
        }
        sums
    }
}

/// The values `N_i` of a step and room for one argument.
#[derive(Clone, Debug)]
pub(crate) struct Stages {
    dim: usize,
    values: Vec<f64>,
    argument: Vec<f64>,
}

impl Stages {
    pub(crate) fn new(tableau: &ExponentialTableau, dim: usize) -> Self {
        Self { dim, values: vec![0.0; (tableau.stages() + 1) * dim], argument: vec![0.0; dim] }
    }

    pub(crate) fn get(&self, stage: usize) -> &[f64] {
        &self.values[stage * self.dim..(stage + 1) * self.dim]
    }

    pub(crate) fn get_mut(&mut self, stage: usize) -> &mut [f64] {
        &mut self.values[stage * self.dim..(stage + 1) * self.dim]
    }

    /// Copies one stage to another step's.
    pub(crate) fn copy_to(&self, stage: usize, other: &mut Self) {
        other.get_mut(stage).copy_from_slice(self.get(stage));
    }

    pub(crate) fn copy(&mut self, from: usize, to: usize) {
        self.values.copy_within(from * self.dim..(from + 1) * self.dim, to * self.dim);
    }
}

/// One step from `u` at time `t` with the coefficients in `table`; stage 0 must hold `N(t, u)` on entry.
#[inline]
pub(crate) fn step<F: Semilinear<f64> + ?Sized>(
    tableau: &ExponentialTableau,
    field: &F,
    t: f64,
    u: &[f64],
    table: &StepTable,
    stages: &mut Stages,
    u_new: &mut [f64],
) {
    let mut argument = std::mem::take(&mut stages.argument);
    let mut row = 0;
    for (before, &(node, terms)) in tableau.rows.iter().enumerate() {
        table.combine(Some([table.propagator(node), u]), terms, row, stages, &mut argument);
        row += terms.len();
        let time = t + if node == Node::Full { table.h } else { 0.5 * table.h };
        field.nonlinear(time, &argument, stages.get_mut(before + 1));
    }
    stages.argument = argument;
    table.combine(Some([table.propagator(Node::Full), u]), tableau.weights, row, stages, u_new);
}

/// The estimated error of the step just made, into `out`; slope number `stages()` must hold `N(t + h, u_new)`.
pub(crate) fn error(tableau: &ExponentialTableau, table: &StepTable, stages: &Stages, out: &mut [f64]) {
    let row = tableau.rows.iter().map(|row| row.1.len()).sum::<usize>() + tableau.weights.len();
    table.combine(None, tableau.error.unwrap_or(&[]), row, stages, out);
}
