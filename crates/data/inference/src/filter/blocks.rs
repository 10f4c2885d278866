//! All derivatives, in blocks of as many parameters as a vector register has lanes.

use super::base::{Stage, State};
use super::correct::{self, marks_of};
use super::correction::Correction;
use super::evaluate::Want;
use super::problem::{NOISES, Problem};
use super::seen;
use super::sums::Sums;
use super::tangent::{self, Forcing, Scratch, Tangent, depth, forcing_of};
use motiform_dynamics::Bundle;

/// Blocks of coefficients, then the noise ([`super::Theta`]): in blocks of its own where covariances are fixed for coefficients,
/// otherwise from the next lane on.
pub(crate) struct Blocks<B, const SHAPE: usize, const STATE: usize> {
    tangents: Vec<Tangent<B, STATE>>,
    /// Derivatives of the process noise, for each block.
    q: Vec<[B; STATE]>,
    /// Derivative of `ln s^2`, for each block.
    s: Vec<B>,
    /// Derivative of the variance of the centre's own noise, for each block.
    centre: Vec<B>,
    /// Forcing of each stage and block.
    forcing: Vec<f64>,
    /// Rows of the equations that the coefficients of each block are in.
    rows: Vec<[usize; 2]>,
    scratch: Scratch<B, STATE>,
    coefficients: usize,
    /// Number of blocks of coefficients alone.
    first_noise: usize,
    /// Place of the first parameter of the noise among the padded ones.
    noise: usize,
}

impl<B: Bundle, const SHAPE: usize, const STATE: usize> Blocks<B, SHAPE, STATE> {
    const FORCING: usize = forcing_of(SHAPE);

    #[inline(always)]
    pub(crate) fn new(problem: &Problem, want: Want, q: &[f64; STATE], by_centre: f64) -> Self {
        let (coefficients, noises) = if want == Want::Value { (0, 0) } else { (problem.parts.len(), NOISES) };
        let own = coefficients.next_multiple_of(B::LANES);
        let noise = if want == Want::Exact { coefficients } else { own };
        let (first_noise, blocks) = (noise / B::LANES, (noise + noises).div_ceil(B::LANES));
        let zero = B::splat(0.0);
        let mut made = Self {
            tangents: vec![Tangent::zero(); blocks],
            q: vec![[zero; STATE]; blocks],
            s: vec![zero; blocks],
            centre: vec![zero; blocks],
            forcing: vec![0.0; 4 * blocks * Self::FORCING * B::LANES],
            rows: (0..blocks).map(|block| rows(problem, block * B::LANES, B::LANES)).collect(),
            scratch: Scratch::new(),
            coefficients,
            first_noise,
            noise,
        };
        for parameter in 0..noises {
            let (block, lane) = ((noise + parameter) / B::LANES, (noise + parameter) % B::LANES);
            if parameter == 0 {
                made.s[block] = made.s[block].with_lane(lane, 2.0);
            }
            if parameter == 3 {
                made.centre[block] = made.centre[block].with_lane(lane, by_centre);
            }
            for i in 2..STATE {
                if parameter == problem.noise[i / 2 - 1].by {
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

    /// Derivatives at the first frame: the covariance of what is observed is `s^2 R`, and that of the centre's own noise.
    #[inline(always)]
    pub(crate) fn start(&mut self, state: &State<STATE>, centre: f64) {
        for block in 0..self.len() {
            self.tangents[block] = Tangent::zero();
            for i in (0..SHAPE).map(seen) {
                for j in (0..SHAPE).map(seen) {
                    self.tangents[block].p[i][j] = self.s[block] * B::splat(state.p[i][j]);
                }
            }
            let own = self.centre[block] - self.s[block] * B::splat(centre);
            for i in 0..2 {
                self.tangents[block].p[i][i] += own;
            }
        }
    }

    /// The numbers of marks of each block that are not 0: where covariances are taken as fixed, those of the
    /// mean alone.
    pub(crate) fn counts(&self, want: Want) -> Vec<usize> {
        let fixed = |block| want != Want::Exact && block < self.first_noise;
        (0..self.len()).map(|block| if fixed(block) { SHAPE } else { marks_of(SHAPE) }).collect()
    }

    /// Writes what forces the derivatives by the coefficients at each stage: `df/dc`, and `dA/dc` for exact ones.
    #[inline(always)]
    fn force(&mut self, problem: &Problem, stages: &[Stage<SHAPE, STATE>; 4], exact: bool) {
        let (lanes, blocks) = (B::LANES, self.len());
        for (number, stage) in stages.iter().enumerate() {
            for (parameter, part) in problem.parts.iter().enumerate() {
                let own = (number * blocks + parameter / lanes) * Self::FORCING * lanes + parameter % lanes;
                let (row, values) = (2 * problem.field.equation(part.term), &stage.values);
                let rate = turned(values.monomials[part.term], part.imaginary);
                self.forcing[own + row * lanes] = rate[0];
                self.forcing[own + (row + 1) * lanes] = rate[1];
                if exact {
                    let first = own + (SHAPE + row * SHAPE) * lanes;
                    let rows = &mut self.forcing[first..first + (2 * SHAPE - 1) * lanes + 1];
                    for (k, by) in values.gradients[part.term].iter().enumerate() {
                        let by = turned(*by, part.imaginary);
                        rows[k * lanes] = by[0];
                        rows[(SHAPE + k) * lanes] = by[1];
                    }
                }
            }
        }
    }

    /// A step of the integration with these stages.
    #[inline(always)]
    pub(crate) fn step(&mut self, stages: &[Stage<SHAPE, STATE>; 4], problem: &Problem, want: Want, h: f64) {
        if self.len() == 0 {
            return;
        }
        self.force(problem, stages, want == Want::Exact);
        let (size, blocks) = (Self::FORCING * B::LANES, self.len());
        for block in 0..blocks {
            let (a, b) = (block * size, (blocks + block) * size);
            let (c, d) = ((2 * blocks + block) * size, (3 * blocks + block) * size);
            let f = &self.forcing;
            let rows = self.rows[block];
            let forcing = [
                Forcing { values: &f[a..a + size], rows },
                Forcing { values: &f[b..b + size], rows },
                Forcing { values: &f[c..c + size], rows },
                Forcing { values: &f[d..d + size], rows },
            ];
            let (tangent, scratch, q) = (&mut self.tangents[block], &mut self.scratch, &self.q[block]);
            match (want, block >= self.first_noise) {
                (Want::Exact, _) => {
                    tangent::step::<B, SHAPE, STATE, { depth::ALL }>(tangent, scratch, stages, forcing, q, h);
                }
                (_, true) => {
                    tangent::step::<B, SHAPE, STATE, { depth::NOISE }>(
                        tangent, scratch, stages, forcing, q, h,
                    );
                }
                (_, false) => {
                    tangent::step::<B, SHAPE, STATE, { depth::MEAN }>(
                        tangent, scratch, stages, forcing, q, h,
                    );
                }
            }
        }
    }

    /// Takes a frame in.
    #[inline(always)]
    pub(crate) fn correct(&mut self, correction: &Correction<SHAPE, STATE>, want: Want, sums: &mut Sums<B>) {
        for block in 0..self.len() {
            let tangent = &mut self.tangents[block];
            let errors = correct::Errors { s: self.s[block], centre: self.centre[block] };
            let found = if want == Want::Exact || block >= self.first_noise {
                correct::correct::<B, SHAPE, STATE, true>(tangent, correction, errors)
            } else {
                correct::correct::<B, SHAPE, STATE, false>(tangent, correction, errors)
            };
            sums.note(block, &found);
        }
    }

    /// The places of the parameters among the padded ones.
    pub(crate) fn places(&self) -> Vec<usize> {
        let noises = if self.len() == 0 { 0 } else { NOISES };
        (0..self.coefficients).chain(self.noise..self.noise + noises).collect()
    }

    /// A vector over the padded parameters without the padding.
    pub(crate) fn unpadded(&self, padded: &[f64]) -> Vec<f64> {
        self.places().into_iter().map(|place| padded[place]).collect()
    }
}

/// The rows of the equations of some coefficients; none of noise, which comes after them.
fn rows(problem: &Problem, first: usize, count: usize) -> [usize; 2] {
    let parts = problem.parts.get(first..(first + count).min(problem.parts.len())).unwrap_or_default();
    let equations = parts.iter().map(|part| problem.field.equation(part.term));
    let (low, high) = (equations.clone().min(), equations.max());
    low.zip(high).map_or([0, 0], |(low, high)| [2 * low, 2 * high + 2])
}

/// The number, or `i` times it.
#[inline(always)]
fn turned(z: motiform_dynamics::Complex<f64>, imaginary: bool) -> [f64; 2] {
    if imaginary { [-z.im, z.re] } else { [z.re, z.im] }
}
