//! All derivatives, in blocks of as many parameters as a vector register has lanes.

use super::STATE;
use super::base::{Correction, Stage, State};
use super::correct;
use super::evaluate::Want;
use super::problem::Problem;
use super::sums::Sums;
use super::tangent::{self, FORCING, Tangent, depth};
use super::{AT, SEEN};
use crate::field::{Field, Part, SHAPE};
use motiform_dynamics::Bundle;

/// Blocks of coefficients, then those of `ln s`, `ln eta_v` and `ln eta_shape`.
pub(crate) struct Blocks<B> {
    tangents: Vec<Tangent<B>>,
    /// Derivatives of the process noise, for each block.
    q: Vec<[B; STATE]>,
    /// Derivative of `ln s^2`, for each block.
    s: Vec<B>,
    /// Forcing of each stage and block.
    forcing: Vec<f64>,
    coefficients: usize,
    /// Number of blocks of coefficients.
    first_noise: usize,
}

impl<B: Bundle> Blocks<B> {
    #[inline(always)]
    pub(crate) fn new(coefficients: usize, wanted: bool, q: &[f64; STATE]) -> Self {
        let first_noise = coefficients.div_ceil(B::LANES);
        let noise = if wanted { 3_usize.div_ceil(B::LANES) } else { 0 };
        let (blocks, zero) = (first_noise + noise, B::splat(0.0));
        let mut made = Self {
            tangents: vec![Tangent::zero(); blocks],
            q: vec![[zero; STATE]; blocks],
            s: vec![zero; blocks],
            forcing: vec![0.0; 4 * blocks * FORCING * B::LANES],
            coefficients,
            first_noise,
        };
        for parameter in 0..if wanted { 3 } else { 0 } {
            let (block, lane) = (first_noise + parameter / B::LANES, parameter % B::LANES);
            if parameter == 0 {
                made.s[block] = made.s[block].with_lane(lane, 2.0);
            }
            for i in 2..STATE {
                if (parameter == 1 && i < 4) || (parameter == 2 && i >= 4) {
                    made.q[block][i] = made.q[block][i].with_lane(lane, 2.0 * q[i]);
                }
            }
        }
        made
    }

    #[inline(always)]
    pub(crate) fn len(&self) -> usize {
        self.tangents.len()
    }

    /// Derivatives at the first frame: the covariance of what is observed is proportional to `s^2`.
    #[inline(always)]
    pub(crate) fn start(&mut self, state: &State) {
        for block in 0..self.len() {
            self.tangents[block] = Tangent::zero();
            for i in SEEN {
                for j in SEEN {
                    self.tangents[block].p[AT[i][j]] = self.s[block] * B::splat(state.p[i][j]);
                }
            }
        }
    }

    /// Writes what forces the derivatives by the coefficients at each stage.
    #[inline(always)]
    fn force(&mut self, field: &Field, stages: &[Stage; 4], parts: &[Part]) {
        let (lanes, blocks) = (B::LANES, self.len());
        for (number, stage) in stages.iter().enumerate() {
            for (parameter, part) in parts.iter().enumerate() {
                let own = (number * blocks + parameter / lanes) * FORCING * lanes + parameter % lanes;
                let (row, values) = (2 * field.equation(part.term), &stage.values);
                let forcing = &mut self.forcing[own..];
                let rate = turned(values.monomials[part.term], part.imaginary);
                forcing[row * lanes] = rate[0];
                forcing[(row + 1) * lanes] = rate[1];
                for k in 0..SHAPE {
                    let by = turned(values.gradients[part.term][k], part.imaginary);
                    forcing[(SHAPE + row * SHAPE + k) * lanes] = by[0];
                    forcing[(SHAPE + (row + 1) * SHAPE + k) * lanes] = by[1];
                }
            }
        }
    }

    /// A step of the integration with these stages.
    #[inline(always)]
    pub(crate) fn step(&mut self, stages: &[Stage; 4], problem: &Problem, want: Want, h: f64) {
        if self.len() == 0 {
            return;
        }
        self.force(&problem.field, stages, &problem.parts);
        let (size, blocks) = (FORCING * B::LANES, self.len());
        for block in 0..blocks {
            let (a, b) = (block * size, (blocks + block) * size);
            let (c, d) = ((2 * blocks + block) * size, (3 * blocks + block) * size);
            let f = &self.forcing;
            let forcing = [&f[a..a + size], &f[b..b + size], &f[c..c + size], &f[d..d + size]];
            let tangent = &mut self.tangents[block];
            let q = &self.q[block];
            match (want, block >= self.first_noise) {
                (Want::Exact, _) => tangent::step::<B, { depth::ALL }>(tangent, stages, forcing, q, h),
                (_, true) => tangent::step::<B, { depth::NOISE }>(tangent, stages, forcing, q, h),
                (_, false) => tangent::step::<B, { depth::MEAN }>(tangent, stages, forcing, q, h),
            }
        }
    }

    /// Takes a frame in.
    #[inline(always)]
    pub(crate) fn correct(&mut self, correction: &Correction, want: Want, sums: &mut Sums<B>) {
        for block in 0..self.len() {
            let tangent = &mut self.tangents[block];
            let found = if want == Want::Exact || block >= self.first_noise {
                correct::correct::<B, true>(tangent, correction, self.s[block])
            } else {
                correct::correct::<B, false>(tangent, correction, self.s[block])
            };
            sums.note(block, &found);
        }
    }

    /// Where each parameter is among the padded ones.
    pub(crate) fn places(&self) -> Vec<usize> {
        let noise = self.first_noise * B::LANES;
        let three = if self.len() == 0 { 0 } else { 3 };
        (0..self.coefficients).chain(noise..noise + three).collect()
    }

    /// A vector over the padded parameters without the padding.
    pub(crate) fn unpadded(&self, padded: &[f64]) -> Vec<f64> {
        self.places().into_iter().map(|place| padded[place]).collect()
    }
}

/// The number, or `i` times it.
#[inline(always)]
fn turned(z: motiform_dynamics::Complex<f64>, imaginary: bool) -> [f64; 2] {
    if imaginary { [-z.im, z.re] } else { [z.re, z.im] }
}
