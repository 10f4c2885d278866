//! Derivatives of mean and covariance by a block of parameters, one in each lane, through a Runge-Kutta step.
//!
//! ```text
//! d(dm)/dt = A dm + df/dc          dA = (d2f/du2) dm + dA/dc
//! d(dP)/dt = (A dP + dA P) + (A dP + dA P)^T + dQ
//! ```
//!
//! No closure in here: it would be compiled without the vector instructions of the kernel.

use super::base::Stage;
use motiform_dynamics::Bundle;
use motiform_dynamics::simd::Kernel;

/// Numbers of a parameter that force its derivatives at a stage: `df/dc` and `dA/dc`.
pub(crate) const fn forcing_of(shape: usize) -> usize {
    shape + shape * shape
}

/// Derivatives of mean and covariance.
#[derive(Clone, Copy)]
pub(crate) struct Tangent<B, const STATE: usize> {
    pub(crate) m: [B; STATE],
    /// Entries `[i][j]` with `i <= j`; the others are not used.
    pub(crate) p: [[B; STATE]; STATE],
}

impl<B: Bundle, const STATE: usize> Tangent<B, STATE> {
    #[inline(always)]
    pub(crate) fn zero() -> Self {
        Self { m: [B::splat(0.0); STATE], p: [[B::splat(0.0); STATE]; STATE] }
    }

    /// An entry of the symmetric matrix.
    #[inline(always)]
    pub(crate) fn between(&self, i: usize, j: usize) -> B {
        if i < j { self.p[i][j] } else { self.p[j][i] }
    }

    /// Adds `h` times `rate`.
    #[inline(always)]
    fn add<const DEPTH: u8>(&mut self, rate: &Self, h: f64) {
        let h = B::splat(h);
        for i in 0..STATE {
            self.m[i] += rate.m[i] * h;
        }
        if DEPTH > depth::MEAN {
            for i in 0..STATE {
                for j in i..STATE {
                    self.p[i][j] += rate.p[i][j] * h;
                }
            }
        }
    }

    /// Becomes `from + h rate`.
    #[inline(always)]
    fn become_sum<const DEPTH: u8>(&mut self, from: &Self, rate: &Self, h: f64) {
        let h = B::splat(h);
        for i in 0..STATE {
            self.m[i] = from.m[i] + rate.m[i] * h;
        }
        if DEPTH > depth::MEAN {
            for i in 0..STATE {
                for j in i..STATE {
                    self.p[i][j] = from.p[i][j] + rate.p[i][j] * h;
                }
            }
        }
    }
}

/// Storage for the stages of a step, allocated once.
#[derive(Clone, Copy)]
pub(crate) struct Scratch<B, const STATE: usize> {
    at: Tangent<B, STATE>,
    rate: Tangent<B, STATE>,
}

impl<B: Bundle, const STATE: usize> Scratch<B, STATE> {
    #[inline(always)]
    pub(crate) fn new() -> Self {
        Self { at: Tangent::zero(), rate: Tangent::zero() }
    }
}

/// `A dP + dA P`, rows of the shape.
type Products<B, const SHAPE: usize, const STATE: usize> = [[B; STATE]; SHAPE];

/// The depth of the derivatives that are carried.
pub(crate) mod depth {
    /// The mean alone: covariances are taken as fixed.
    pub(crate) const MEAN: u8 = 0;
    /// The covariance too, but not what the mean does to it.
    pub(crate) const NOISE: u8 = 1;
    /// Everything.
    pub(crate) const ALL: u8 = 2;
}

/// The forcing of the derivatives of a block at a stage.
#[derive(Clone, Copy)]
pub(crate) struct Forcing<'f> {
    /// [`forcing_of`] bundles: `df/dc`, then the rows of `dA/dc`.
    pub(crate) values: &'f [f64],
    /// The rows of `dA/dc` that are not 0 in all lanes.
    pub(crate) rows: [usize; 2],
}

/// `A dP + dA P`.
#[inline(always)]
fn products<B: Bundle, const SHAPE: usize, const STATE: usize, const DEPTH: u8>(
    stage: &Stage<SHAPE, STATE>,
    forcing: Forcing<'_>,
    at: &Tangent<B, STATE>,
) -> Products<B, SHAPE, STATE> {
    let mut products = [[B::splat(0.0); STATE]; SHAPE];
    for i in 0..SHAPE {
        let mut row = [B::splat(0.0); STATE]; // in registers
        for k in 0..SHAPE {
            let a = B::splat(stage.values.jacobian[i][k]);
            for j in 0..STATE {
                row[j] += a * at.between(k + 2, j);
            }
            if DEPTH == depth::ALL {
                let dm = at.m[k + 2];
                for j in 0..STATE {
                    row[j] += dm * B::splat(stage.curved[i][k][j]);
                }
            }
        }
        if DEPTH == depth::ALL && (forcing.rows[0]..forcing.rows[1]).contains(&i) {
            for k in 0..SHAPE {
                let da = B::load(&forcing.values[(SHAPE + i * SHAPE + k) * B::LANES..]);
                for j in 0..STATE {
                    row[j] += da * B::splat(stage.p[k + 2][j]);
                }
            }
        }
        products[i] = row;
    }
    products
}

/// Rates of the derivatives of the covariance.
#[inline(always)]
fn covariance_rate<B: Bundle, const SHAPE: usize, const STATE: usize>(
    products: &Products<B, SHAPE, STATE>,
    q: &[B; STATE],
    at: &Tangent<B, STATE>,
    rate: &mut Tangent<B, STATE>,
) {
    let p = &at.p;
    rate.p[0][0] = p[0][2] + p[0][2];
    rate.p[0][1] = p[1][2] - p[0][3];
    rate.p[1][1] = -(p[1][3] + p[1][3]);
    for j in 0..SHAPE {
        rate.p[0][j + 2] = products[j][0] + at.between(2, j + 2);
        rate.p[1][j + 2] = products[j][1] - at.between(3, j + 2);
        for i in 0..j {
            rate.p[i + 2][j + 2] = products[i][j + 2] + products[j][i + 2];
        }
        rate.p[j + 2][j + 2] = products[j][j + 2] + products[j][j + 2] + q[j + 2];
    }
}

/// The rates at `at`. A function of its own: written out for each stage, it would be most of a program that takes long to compile.
#[inline(always)]
fn rate<B: Bundle, const SHAPE: usize, const STATE: usize, const DEPTH: u8>(
    stage: &Stage<SHAPE, STATE>,
    forcing: Forcing<'_>,
    q: &[B; STATE],
    at: &Tangent<B, STATE>,
    rate: &mut Tangent<B, STATE>,
) {
    B::apart(Rate::<B, SHAPE, STATE, DEPTH> { stage, forcing, q, at, rate });
}

/// See [`rate`].
struct Rate<'r, B, const SHAPE: usize, const STATE: usize, const DEPTH: u8> {
    stage: &'r Stage<SHAPE, STATE>,
    forcing: Forcing<'r>,
    q: &'r [B; STATE],
    at: &'r Tangent<B, STATE>,
    rate: &'r mut Tangent<B, STATE>,
}

impl<B: Bundle, const SHAPE: usize, const STATE: usize, const DEPTH: u8> Kernel
    for Rate<'_, B, SHAPE, STATE, DEPTH>
{
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { stage, forcing, q, at, rate } = self;
        rate.m[0] = at.m[2];
        rate.m[1] = -at.m[3];
        for i in 0..SHAPE {
            let mut sum = B::load(&forcing.values[i * B::LANES..]);
            for k in 0..SHAPE {
                sum += at.m[k + 2] * B::splat(stage.values.jacobian[i][k]);
            }
            rate.m[i + 2] = sum;
        }
        if DEPTH > depth::MEAN {
            covariance_rate(&products::<B, SHAPE, STATE, DEPTH>(stage, forcing, at), q, at, rate);
        }
    }
}

/// The derivatives after a step with these stages; `DEPTH` is one of [`depth`].
#[inline(always)]
pub(crate) fn step<B: Bundle, const SHAPE: usize, const STATE: usize, const DEPTH: u8>(
    tangent: &mut Tangent<B, STATE>,
    scratch: &mut Scratch<B, STATE>,
    stages: &[Stage<SHAPE, STATE>; 4],
    forcing: [Forcing<'_>; 4],
    q: &[B; STATE],
    h: f64,
) {
    let start = *tangent;
    let Scratch { at, rate: found } = scratch;
    rate::<B, SHAPE, STATE, DEPTH>(&stages[0], forcing[0], q, &start, found);
    tangent.add::<DEPTH>(found, h / 6.0);
    at.become_sum::<DEPTH>(&start, found, 0.5 * h);
    rate::<B, SHAPE, STATE, DEPTH>(&stages[1], forcing[1], q, at, found);
    tangent.add::<DEPTH>(found, h / 3.0);
    at.become_sum::<DEPTH>(&start, found, 0.5 * h);
    rate::<B, SHAPE, STATE, DEPTH>(&stages[2], forcing[2], q, at, found);
    tangent.add::<DEPTH>(found, h / 3.0);
    at.become_sum::<DEPTH>(&start, found, h);
    rate::<B, SHAPE, STATE, DEPTH>(&stages[3], forcing[3], q, at, found);
    tangent.add::<DEPTH>(found, h / 6.0);
}
