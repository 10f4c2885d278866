//! Derivatives of a frame's likelihood and of the state after it, by a block of parameters.
//!
//! ```text
//! dN = d(s^2) R + dc diag(1, 1, 0, ..)
//! dnu = -H dm,   dS = H dP H^T + dN,   e = L^-1 dnu,   G = L^-1 dS L^-T,   w = S^-1 nu
//! dl  = -w^T dnu + w^T dS w/2 - tr G/2
//! dm <- (I - K H)(dm + dP H^T w) - K dN w
//! dP <- (I - K H) dP (I - K H)^T + K dN K^T       (the gain is the best one, so its change has no first-order effect)
//! expected information of two parameters: e . e' + tr(G G')/2
//! ```

use super::correction::Correction;
use super::seen;
use super::tangent::Tangent;
use motiform_dynamics::Bundle;
use motiform_dynamics::simd::Kernel;

/// The information in a frame on a block of parameters: the score, and marks, whose products with those of
/// another parameter are the information.
pub(crate) struct Marks<B, const SHAPE: usize> {
    pub(crate) score: B,
    /// `e`.
    pub(crate) mean: [B; SHAPE],
    /// The lower triangle of `G`, with the weights of its entries.
    pub(crate) covariance: [[B; SHAPE]; SHAPE],
}

/// Number of marks.
pub(crate) const fn marks_of(shape: usize) -> usize {
    shape + shape * (shape + 1) / 2
}

impl<B: Bundle, const SHAPE: usize> Marks<B, SHAPE> {
    #[inline(always)]
    fn zero() -> Self {
        let zero = B::splat(0.0);
        Self { score: zero, mean: [zero; SHAPE], covariance: [[zero; SHAPE]; SHAPE] }
    }
}

/// Derivatives of the errors of observation by a block of parameters.
#[derive(Clone, Copy)]
pub(crate) struct Errors<B> {
    /// Of `ln s^2`.
    pub(crate) s: B,
    /// Of the variance `c` of the centre's own noise.
    pub(crate) centre: B,
}

type Square<B, const SHAPE: usize> = [[B; SHAPE]; SHAPE];

/// `dS`.
#[inline(always)]
fn innovation_covariance<B: Bundle, const SHAPE: usize, const STATE: usize>(
    tangent: &Tangent<B, STATE>,
    correction: &Correction<SHAPE, STATE>,
    errors: Errors<B>,
) -> Square<B, SHAPE> {
    let mut ds = [[B::splat(0.0); SHAPE]; SHAPE];
    for i in 0..SHAPE {
        for j in 0..SHAPE {
            ds[i][j] = tangent.between(seen(i), seen(j)) + errors.s * B::splat(correction.noise[i][j]);
        }
    }
    // the noise holds c, which s does not multiply
    let own = errors.centre - errors.s * B::splat(correction.centre);
    ds[0][0] += own;
    ds[1][1] += own;
    ds
}

/// Score and marks.
#[inline(always)]
fn marks<B: Bundle, const SHAPE: usize, const STATE: usize>(
    tangent: &Tangent<B, STATE>,
    correction: &Correction<SHAPE, STATE>,
    ds: &Square<B, SHAPE>,
) -> Marks<B, SHAPE> {
    let zero = B::splat(0.0);
    let (l, w) = (&correction.whiten, &correction.weighted);
    let mut found = Marks::zero();
    let mut half = [[zero; SHAPE]; SHAPE]; // L^-1 dS
    for i in 0..SHAPE {
        let mut by_w = zero;
        for k in 0..SHAPE {
            by_w += ds[i][k] * B::splat(w[k]);
        }
        found.score += (tangent.m[seen(i)] + by_w * B::splat(0.5)) * B::splat(w[i]);
        for k in 0..=i {
            found.mean[i] -= tangent.m[seen(k)] * B::splat(l[i][k]);
            for j in 0..SHAPE {
                half[i][j] += ds[k][j] * B::splat(l[i][k]);
            }
        }
    }
    for i in 0..SHAPE {
        for j in 0..=i {
            let mut g = zero;
            for k in 0..=j {
                g += half[i][k] * B::splat(l[j][k]);
            }
            if i == j {
                found.score -= g * B::splat(0.5);
            }
            let weight = if i == j { std::f64::consts::FRAC_1_SQRT_2 } else { 1.0 };
            found.covariance[i][j] = g * B::splat(weight);
        }
    }
    found
}

/// The derivatives of the mean after a frame.
#[inline(always)]
fn mean<B: Bundle, const SHAPE: usize, const STATE: usize, const FULL: bool>(
    tangent: &mut Tangent<B, STATE>,
    correction: &Correction<SHAPE, STATE>,
    errors: Errors<B>,
) {
    let w = &correction.weighted;
    let mut moved = tangent.m;
    let mut shown = [B::splat(0.0); SHAPE];
    for j in 0..SHAPE {
        if FULL {
            for i in 0..STATE {
                moved[i] += tangent.between(i, seen(j)) * B::splat(w[j]);
            }
        }
        let mut by_w = 0.0;
        for k in 0..SHAPE {
            by_w += correction.noise[j][k] * w[k];
        }
        shown[j] = errors.s * B::splat(by_w);
    }
    let own = errors.centre - errors.s * B::splat(correction.centre);
    shown[0] += own * B::splat(w[0]);
    shown[1] += own * B::splat(w[1]);
    for j in 0..SHAPE {
        shown[j] += moved[seen(j)];
    }
    for i in 0..STATE {
        for j in 0..SHAPE {
            moved[i] -= shown[j] * B::splat(correction.gain[i][j]);
        }
    }
    tangent.m = moved;
}

/// The derivatives of the covariance after a frame.
///
/// With `X = dP H^T` and `D = H dP H^T + dN`:  dP - K X^T - X K^T + K D K^T = dP - Y K^T - K X^T,  Y = X - K D.
#[inline(always)]
fn covariance<B: Bundle, const SHAPE: usize, const STATE: usize>(
    tangent: &mut Tangent<B, STATE>,
    correction: &Correction<SHAPE, STATE>,
    ds: &Square<B, SHAPE>,
) {
    let old = *tangent;
    for i in 0..STATE {
        let mut y = [B::splat(0.0); SHAPE];
        for j in 0..SHAPE {
            y[j] = old.between(i, seen(j));
            for k in 0..SHAPE {
                y[j] -= ds[k][j] * B::splat(correction.gain[i][k]);
            }
        }
        for j in i..STATE {
            let mut sum = old.p[i][j];
            for k in 0..SHAPE {
                sum -= y[k] * B::splat(correction.gain[j][k]);
                sum -= old.between(j, seen(k)) * B::splat(correction.gain[i][k]);
            }
            tangent.p[i][j] = sum;
        }
    }
}

/// Score and marks where the covariances are taken as fixed: `dS = 0`.
#[inline(always)]
fn marks_of_mean<B: Bundle, const SHAPE: usize, const STATE: usize>(
    tangent: &Tangent<B, STATE>,
    correction: &Correction<SHAPE, STATE>,
) -> Marks<B, SHAPE> {
    let (l, w) = (&correction.whiten, &correction.weighted);
    let mut found = Marks::zero();
    for i in 0..SHAPE {
        found.score += tangent.m[seen(i)] * B::splat(w[i]);
        for k in 0..=i {
            found.mean[i] -= tangent.m[seen(k)] * B::splat(l[i][k]);
        }
    }
    found
}

/// Takes a frame in. Without `FULL` the covariances are taken as fixed.
#[inline(always)]
pub(crate) fn correct<B: Bundle, const SHAPE: usize, const STATE: usize, const FULL: bool>(
    tangent: &mut Tangent<B, STATE>,
    correction: &Correction<SHAPE, STATE>,
    errors: Errors<B>,
) -> Marks<B, SHAPE> {
    B::apart(Correct::<B, SHAPE, STATE, FULL> { tangent, correction, errors })
}

/// See [`correct`]: a function of its own, compiled once.
struct Correct<'c, B, const SHAPE: usize, const STATE: usize, const FULL: bool> {
    tangent: &'c mut Tangent<B, STATE>,
    correction: &'c Correction<SHAPE, STATE>,
    errors: Errors<B>,
}

impl<B: Bundle, const SHAPE: usize, const STATE: usize, const FULL: bool> Kernel
    for Correct<'_, B, SHAPE, STATE, FULL>
{
    type Output = Marks<B, SHAPE>;

    #[inline(always)]
    fn run(self) -> Marks<B, SHAPE> {
        let Self { tangent, correction, errors } = self;
        if !FULL {
            let found = marks_of_mean(tangent, correction);
            mean::<B, SHAPE, STATE, FULL>(tangent, correction, errors);
            return found;
        }
        let ds = innovation_covariance(tangent, correction, errors);
        let found = marks(tangent, correction, &ds);
        mean::<B, SHAPE, STATE, FULL>(tangent, correction, errors);
        covariance(tangent, correction, &ds);
        found
    }
}
