//! The state inside a step, in lanes.

use super::lane::Stepped;
use crate::steppers::unrolled::{LaneStep, Method};
use crate::{Bundle, VectorField};

/// The interpolant of a step ([`crate::steppers::tableau::Dense`]), lane by lane; over `f64` that of one lane.
#[derive(Clone, Copy, Debug)]
pub struct LaneDense<B, const D: usize> {
    old: [B; D],
    new: [B; D],
    terms: [[B; D]; 7],
    count: usize,
}

impl<B: Bundle, const D: usize> LaneDense<B, D> {
    /// The interpolant of the step just made by method `M`.
    #[inline(always)]
    pub fn of<M: Method, F: VectorField<B>>(step: &mut Stepped<'_, B, D, F>, field: &F) -> Self {
        // As a single orbit has it: what the clock shows, which is the size tried up to rounding.
        let h = step.t - step.t_old;
        let at = LaneStep { t: step.t_old, h, u: step.u_old };
        step.slopes.extra::<M, F>(field, &at);
        let (old, new) = (*step.u_old, *step.u);
        let mut terms = [[B::splat(0.0); D]; 7];
        for i in 0..D {
            let (first, last) = (step.slopes.k[0][i], step.slopes.k[step.end][i]);
            let difference = new[i] - old[i];
            terms[0][i] = difference;
            terms[1][i] = h * first - difference;
            terms[2][i] = difference * 2.0 - h * (first + last);
        }
        step.slopes.dense::<M>(h, &mut terms[3..]);
        Self { old, new, terms, count: const { M::TABLEAU.dense.terms() } }
    }

    /// The state at fraction `x` of the step, `0 <= x < 1`.
    #[inline(always)]
    pub fn at(&self, x: B) -> [B; D] {
        let other = B::splat(1.0) - x;
        let mut out = [B::splat(0.0); D];
        for i in 0..D {
            let mut value = B::splat(0.0);
            for term in (0..self.count).rev() {
                let factor = if term % 2 == 0 { x } else { other };
                value = (value + self.terms[term][i]) * factor;
            }
            out[i] = value + self.old[i];
        }
        out
    }

    /// The state at the end of the step.
    #[inline(always)]
    pub fn end(&self) -> &[B; D] {
        &self.new
    }

    /// The interpolant of one lane.
    pub fn lane(&self, lane: usize) -> LaneDense<f64, D> {
        let one = |from: &[B; D]| {
            let mut to = [0.0; D];
            for i in 0..D {
                to[i] = from[i].lane(lane);
            }
            to
        };
        let mut terms = [[0.0; D]; 7];
        for (to, from) in terms.iter_mut().zip(&self.terms) {
            *to = one(from);
        }
        LaneDense { old: one(&self.old), new: one(&self.new), terms, count: self.count }
    }
}
