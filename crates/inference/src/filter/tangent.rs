//! Derivatives of mean and covariance by a block of parameters, one in each lane, through a Runge-Kutta step.
//!
//! ```text
//! d(dm)/dt = A dm + df/dc          dA = (d2f/du2) dm + dA/dc
//! d(dP)/dt = (A dP + dA P) + (A dP + dA P)^T + dQ
//! ```
//!
//! No closure in here: it would be compiled without the vector instructions of the kernel.

use super::base::Stage;
use super::{AT, PACKED, STATE};
use crate::field::SHAPE;
use motiform_dynamics::Bundle;

/// Numbers of a parameter that force its derivatives at a stage: `df/dc` and `dA/dc`.
pub(crate) const FORCING: usize = SHAPE + SHAPE * SHAPE;

/// Derivatives of mean and packed covariance.
#[derive(Clone, Copy)]
pub(crate) struct Tangent<B> {
    pub(crate) m: [B; STATE],
    pub(crate) p: [B; PACKED],
}

impl<B: Bundle> Tangent<B> {
    #[inline(always)]
    pub(crate) fn zero() -> Self {
        Self { m: [B::splat(0.0); STATE], p: [B::splat(0.0); PACKED] }
    }

    #[inline(always)]
    fn plus<const DEPTH: u8>(&self, rate: &Self, h: f64) -> Self {
        let (mut sum, h) = (*self, B::splat(h));
        for i in 0..STATE {
            sum.m[i] += rate.m[i] * h;
        }
        if DEPTH > depth::MEAN {
            for i in 0..PACKED {
                sum.p[i] += rate.p[i] * h;
            }
        }
        sum
    }
}

/// `A dP + dA P`, rows of the shape.
type Products<B> = [[B; STATE]; SHAPE];

/// How much of the derivatives is carried.
pub(crate) mod depth {
    /// The mean alone: covariances are taken as fixed.
    pub(crate) const MEAN: u8 = 0;
    /// The covariance too, but not what the mean does to it.
    pub(crate) const NOISE: u8 = 1;
    /// Everything.
    pub(crate) const ALL: u8 = 2;
}

/// `A dP + dA P`.
#[inline(always)]
fn products<B: Bundle, const DEPTH: u8>(stage: &Stage, forcing: &[f64], at: &Tangent<B>) -> Products<B> {
    let mut products = [[B::splat(0.0); STATE]; SHAPE];
    for i in 0..SHAPE {
        for k in 0..SHAPE {
            let a = B::splat(stage.values.jacobian[i][k]);
            for j in 0..STATE {
                products[i][j] += a * at.p[AT[k + 2][j]];
            }
            if DEPTH == depth::ALL {
                let mut da = B::load(&forcing[(SHAPE + i * SHAPE + k) * B::LANES..]);
                for l in 0..SHAPE {
                    da += at.m[l + 2] * B::splat(stage.values.hessian[i][k][l]);
                }
                for j in 0..STATE {
                    products[i][j] += da * B::splat(stage.p[k + 2][j]);
                }
            }
        }
    }
    products
}

/// Rates of the derivatives of the covariance.
#[inline(always)]
fn covariance_rate<B: Bundle>(
    products: &Products<B>,
    q: &[B; STATE],
    at: &Tangent<B>,
    rate: &mut Tangent<B>,
) {
    let p = &at.p;
    rate.p[AT[0][0]] = p[AT[0][2]] + p[AT[0][2]];
    rate.p[AT[0][1]] = p[AT[1][2]] - p[AT[0][3]];
    rate.p[AT[1][1]] = -(p[AT[1][3]] + p[AT[1][3]]);
    for j in 0..SHAPE {
        rate.p[AT[0][j + 2]] = products[j][0] + p[AT[2][j + 2]];
        rate.p[AT[1][j + 2]] = products[j][1] - p[AT[3][j + 2]];
        for i in 0..j {
            rate.p[AT[i + 2][j + 2]] = products[i][j + 2] + products[j][i + 2];
        }
        rate.p[AT[j + 2][j + 2]] = products[j][j + 2] + products[j][j + 2] + q[j + 2];
    }
}

#[inline(always)]
fn rate<B: Bundle, const DEPTH: u8>(
    stage: &Stage,
    forcing: &[f64],
    q: &[B; STATE],
    at: &Tangent<B>,
) -> Tangent<B> {
    let mut rate = Tangent::zero();
    rate.m[0] = at.m[2];
    rate.m[1] = -at.m[3];
    for i in 0..SHAPE {
        let mut sum = B::load(&forcing[i * B::LANES..]);
        for k in 0..SHAPE {
            sum += at.m[k + 2] * B::splat(stage.values.jacobian[i][k]);
        }
        rate.m[i + 2] = sum;
    }
    if DEPTH > depth::MEAN {
        covariance_rate(&products::<B, DEPTH>(stage, forcing, at), q, at, &mut rate);
    }
    rate
}

/// The derivatives after a step with these stages; `forcing` has [`FORCING`] bundles for each stage; `DEPTH` is one of [`depth`].
#[inline(always)]
pub(crate) fn step<B: Bundle, const DEPTH: u8>(
    tangent: &mut Tangent<B>,
    stages: &[Stage; 4],
    forcing: [&[f64]; 4],
    q: &[B; STATE],
    h: f64,
) {
    let k1 = rate::<B, DEPTH>(&stages[0], forcing[0], q, tangent);
    let k2 = rate::<B, DEPTH>(&stages[1], forcing[1], q, &tangent.plus::<DEPTH>(&k1, 0.5 * h));
    let mut sum = tangent.plus::<DEPTH>(&k1, h / 6.0).plus::<DEPTH>(&k2, h / 3.0);
    let k3 = rate::<B, DEPTH>(&stages[2], forcing[2], q, &tangent.plus::<DEPTH>(&k2, 0.5 * h));
    sum = sum.plus::<DEPTH>(&k3, h / 3.0);
    let k4 = rate::<B, DEPTH>(&stages[3], forcing[3], q, &tangent.plus::<DEPTH>(&k3, h));
    *tangent = sum.plus::<DEPTH>(&k4, h / 6.0);
}
