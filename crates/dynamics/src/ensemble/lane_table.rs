//! The coefficients of an exponential method, a step size and a linear part per lane.

use crate::Bundle;
use crate::steppers::ExponentialTableau;
use crate::steppers::exponential::{ExponentialTerm, Node, PhiValues};

/// The coefficients of a method for each lane's step size and linear part.
pub(super) struct LaneTable<B> {
    /// Entries of the state that share a number: 1 or 2.
    parts: usize,
    /// Numbers in a row.
    width: usize,
    /// Rows: `e^{z/2}`, `e^z`, then `h` times the coefficient of each term.
    values: Vec<B>,
}

impl<B: Bundle> LaneTable<B> {
    #[inline(always)]
    pub(super) fn new(method: &ExponentialTableau, dim: usize, parts: usize) -> Self {
        let width = dim / parts;
        let rows = 2 + method.step_terms().count();
        Self { parts, width, values: vec![B::splat(0.0); rows * width] }
    }

    /// Computes the coefficients of one lane.
    #[inline(always)]
    pub(super) fn fill(&mut self, lane: usize, method: &ExponentialTableau, lambda: &[f64], h: f64) {
        for (i, &rate) in lambda.iter().step_by(self.parts).enumerate() {
            let values = PhiValues::at(h * rate);
            self.set(lane, i, values.half[0]);
            self.set(lane, self.width + i, values.full[0]);
            for (row, (_, coefficient)) in method.step_terms().enumerate() {
                self.set(lane, (2 + row) * self.width + i, h * coefficient(&values));
            }
        }
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, place: usize, value: f64) {
        self.values[place] = self.values[place].with_lane(lane, value);
    }

    /// `e u + sum_j c_j N_j` over `terms`, whose coefficients start at `row`, in the order of a single orbit.
    #[inline(always)]
    pub(super) fn combine(
        &self,
        (node, row, terms): (Node, usize, &[ExponentialTerm]),
        (u, stages): (&[B], &[B]),
        out: &mut [B],
    ) {
        let propagator = if node == Node::Full { self.width } else { 0 };
        let rows = (propagator, (2 + row) * self.width);
        if self.parts == 2 {
            self.combine_parts::<2>(rows, terms, (u, stages), out);
        } else {
            self.combine_parts::<1>(rows, terms, (u, stages), out);
        }
    }

    #[inline(always)]
    fn combine_parts<const PARTS: usize>(
        &self,
        (propagator, first): (usize, usize),
        terms: &[ExponentialTerm],
        (u, stages): (&[B], &[B]),
        out: &mut [B],
    ) {
        for i in 0..self.width {
            let place = i * PARTS;
            let (e, u) = (self.values[propagator + i], &u[place..place + PARTS]);
            let mut sums = [e; PARTS];
            for part in 0..PARTS {
                sums[part] = e * u[part];
            }
            let mut at = first + i;
            for &(stage, _) in terms {
                let c = self.values[at];
                let slope = &stages[stage * out.len() + place..][..PARTS];
                for part in 0..PARTS {
                    sums[part] = c.mul_add(slope[part], sums[part]);
                }
                at += self.width;
            }
            out[place..place + PARTS].copy_from_slice(&sums);
        }
    }
}
