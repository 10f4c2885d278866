//! The equations of the stages, each with its own Jacobian, eliminated stage by stage.

use super::product::{add_product, inverse, product};
use super::tableau::{STAGES, Tableau};
use nalgebra::DMatrix;

/// Stages that are eliminated by the pattern of the equations; the others as they come.
const LEADING: usize = 2;
const REST: usize = STAGES - LEADING;

/// The residual that a solution may leave, as part of the terms of its equations: digits that a small pivot would cost.
const LEFT: f64 = 1e-10;

/// The equations `sum_j a'_ij W_j - h J_i W_i = R_i`, with the inverse `a'` of the matrix of the weights. Outside the diagonal their
/// blocks are multiples of the identity: the first stage is eliminated by one inverse, the second by another and three products, and
/// what is left are three stages. That takes half as many products of blocks as the elimination of all entries, and they are products
/// of small matrices that stay in the nearest cache.
///
/// The inverse of the matrix of a Radau method is positive definite in the weights of its quadrature, and so are the pivots as long as
/// the Jacobians do not grow by more than that within a step: no exchange of stages is needed. [`Blocks::last_stage`] tests what it
/// finds.
pub(super) struct Blocks<'j> {
    h: f64,
    /// Column by column.
    jacobians: &'j [Vec<f64>],
    dim: usize,
}

/// The factors after the elimination of the first two stages.
struct Leading {
    /// `B = S_00^-1` and `X = S_11^-1` of the pivots, and their products.
    b: DMatrix<f64>,
    x: DMatrix<f64>,
    bx: DMatrix<f64>,
    xb: DMatrix<f64>,
    bxb: DMatrix<f64>,
}

/// The triangle that is left for one right side.
struct Eliminated {
    leading: Leading,
    rest: Vec<Vec<DMatrix<f64>>>,
    /// The inverses of the last pivots.
    pivots: Vec<DMatrix<f64>>,
    sides: Vec<DMatrix<f64>>,
}

impl Eliminated {
    /// All stages, where the last one is known.
    fn solution(mut self, last: DMatrix<f64>) -> Vec<DMatrix<f64>> {
        let (a, dim) = (&Tableau::get().inverse, last.nrows());
        let mut w = vec![DMatrix::zeros(dim, 1); STAGES];
        w[STAGES - 1] = last;
        for p in (0..REST - 1).rev() {
            for k in p + 1..REST {
                add_product(&mut self.sides[LEADING + p], -1.0, &self.rest[p][k], &w[LEADING + k]);
            }
            w[LEADING + p] = product(&self.pivots[p], &self.sides[LEADING + p]);
        }
        let Leading { b, x, .. } = &self.leading;
        let mut through = DMatrix::zeros(dim, 1);
        for k in LEADING..STAGES {
            add(&mut self.sides[1], -a[1][k], &w[k]);
            add(&mut through, a[1][0] * a[0][k], &w[k]);
        }
        add_product(&mut self.sides[1], 1.0, b, &through);
        w[1] = product(x, &self.sides[1]);
        for k in 1..STAGES {
            add(&mut self.sides[0], -a[0][k], &w[k]);
        }
        w[0] = product(b, &self.sides[0]);
        w
    }
}

impl<'j> Blocks<'j> {
    /// For a step of `h` and the Jacobians of its stages.
    pub(super) fn new(h: f64, jacobians: &'j [Vec<f64>]) -> Self {
        Self { h, jacobians, dim: jacobians[0].len().isqrt() }
    }

    /// `W` of the last stage; `None` where a pivot has no inverse, or too few digits are left.
    pub(super) fn last_stage(&self, right: &[DMatrix<f64>]) -> Option<DMatrix<f64>> {
        let mut sides = right.to_vec();
        let leading = self.leading(&mut sides)?;
        let mut rest = self.rest(&leading);
        let mut pivots = Vec::new();
        for p in 0..REST {
            let pivot = inverse(rest[p][p].clone())?;
            let (above, below) = rest.split_at_mut(p + 1);
            let (known, below_sides) = sides.split_at_mut(LEADING + p + 1);
            for (row, side) in below.iter_mut().zip(below_sides) {
                let factor = product(&row[p], &pivot);
                for k in p + 1..REST {
                    add_product(&mut row[k], -1.0, &factor, &above[p][k]);
                }
                add_product(side, -1.0, &factor, &known[LEADING + p]);
            }
            pivots.push(pivot);
        }
        let last = product(&pivots[REST - 1], &sides[STAGES - 1]);
        let probe = last.ncols().checked_sub(1)?;
        let column = |of: &DMatrix<f64>| of.columns(probe, 1).into_owned();
        let eliminated = Eliminated { leading, rest, pivots, sides: sides.iter().map(column).collect() };
        let whole = eliminated.solution(column(&last));
        let right: Vec<_> = right.iter().map(column).collect();
        self.is_solved(&whole, &right).then_some(last)
    }

    /// True where a solution leaves nothing but round-off.
    fn is_solved(&self, w: &[DMatrix<f64>], right: &[DMatrix<f64>]) -> bool {
        let a = &Tableau::get().inverse;
        (0..STAGES).all(|i| {
            (0..self.dim).all(|row| {
                let by_stage = (0..STAGES).map(|j| a[i][j] * w[j][row]);
                let by_rate =
                    (0..self.dim).map(|k| -self.h * self.jacobians[i][k * self.dim + row] * w[i][k]);
                let terms = by_stage.chain(by_rate).chain([-right[i][row]]);
                let (sum, size) = terms.fold((0.0, 0.0), |(sum, size), x: f64| (sum + x, size + x.abs()));
                sum.abs() <= LEFT * size
            })
        })
    }

    /// `a'_ii - h J_i`.
    fn diagonal(&self, i: usize) -> DMatrix<f64> {
        let own = Tableau::get().inverse[i][i];
        let mut block = DMatrix::from_column_slice(self.dim, self.dim, &self.jacobians[i]) * -self.h;
        (0..self.dim).for_each(|k| block[(k, k)] += own);
        block
    }

    /// Eliminates the first two stages.
    fn leading(&self, sides: &mut [DMatrix<f64>]) -> Option<Leading> {
        let a = &Tableau::get().inverse;
        let b = inverse(self.diagonal(0))?;
        let known = product(&b, &sides[0]);
        for j in 1..STAGES {
            add(&mut sides[j], -a[j][0], &known);
        }
        let mut pivot = self.diagonal(1);
        add(&mut pivot, -a[1][0] * a[0][1], &b);
        let x = inverse(pivot)?;
        let known = product(&x, &sides[1]);
        let again = product(&b, &known);
        for j in LEADING..STAGES {
            add(&mut sides[j], -a[j][1], &known);
            add(&mut sides[j], a[j][0] * a[0][1], &again);
        }
        let (bx, xb) = (product(&b, &x), product(&x, &b));
        let bxb = product(&bx, &b);
        Some(Leading { b, x, bx, xb, bxb })
    }

    /// The blocks of the last stages after that.
    fn rest(&self, of: &Leading) -> Vec<Vec<DMatrix<f64>>> {
        let a = &Tableau::get().inverse;
        let block = |j: usize, k: usize| {
            let mut block = if j == k {
                self.diagonal(j)
            } else {
                DMatrix::from_diagonal_element(self.dim, self.dim, a[j][k])
            };
            add(&mut block, -a[j][0] * a[0][k], &of.b);
            add(&mut block, -a[j][1] * a[1][k], &of.x);
            add(&mut block, a[j][1] * a[1][0] * a[0][k], &of.xb);
            add(&mut block, a[j][0] * a[0][1] * a[1][k], &of.bx);
            add(&mut block, -a[j][0] * a[0][1] * a[1][0] * a[0][k], &of.bxb);
            block
        };
        (LEADING..STAGES).map(|j| (LEADING..STAGES).map(|k| block(j, k)).collect()).collect()
    }
}

#[inline(never)]
fn add(to: &mut DMatrix<f64>, factor: f64, by: &DMatrix<f64>) {
    // slices: the iterators of matrices are four times slower
    to.as_mut_slice().iter_mut().zip(by.as_slice()).for_each(|(to, by)| *to += factor * by);
}
