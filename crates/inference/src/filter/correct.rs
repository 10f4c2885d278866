//! Derivatives of a frame's likelihood and of the state after it, by a block of parameters.
//!
//! ```text
//! dnu = -H dm,   dS = H dP H^T + d(s^2) R,   e = L^-1 dnu,   G = L^-1 dS L^-T,   w = S^-1 nu
//! dl  = -w^T dnu + w^T dS w/2 - tr G/2
//! dm <- (I - K H)(dm + dP H^T w) - K d(s^2) R w
//! dP <- (I - K H) dP (I - K H)^T + K d(s^2) R K^T       (the gain is the best one, so its change has no first-order effect)
//! expected information of two parameters: e . e' + tr(G G')/2
//! ```

use super::base::Correction;
use super::tangent::Tangent;
use super::{AT, SEEN, STATE};
use crate::observation::OBSERVED;
use motiform_dynamics::Bundle;

/// Numbers of a parameter whose products with those of another one are the information of a frame: `e` and the triangle of `G`.
pub(crate) const MARKS: usize = OBSERVED + OBSERVED * (OBSERVED + 1) / 2;

/// What a frame says about a block of parameters.
pub(crate) struct Marks<B> {
    pub(crate) score: B,
    pub(crate) marks: [B; MARKS],
}

type Square<B> = [[B; OBSERVED]; OBSERVED];

/// `dS`.
#[inline(always)]
fn innovation_covariance<B: Bundle>(tangent: &Tangent<B>, correction: &Correction, s: B) -> Square<B> {
    let mut ds = [[B::splat(0.0); OBSERVED]; OBSERVED];
    for i in 0..OBSERVED {
        for j in 0..OBSERVED {
            ds[i][j] = tangent.p[AT[SEEN[i]][SEEN[j]]] + s * B::splat(correction.noise[i][j]);
        }
    }
    ds
}

/// Score and marks.
#[inline(always)]
fn marks<B: Bundle>(tangent: &Tangent<B>, correction: &Correction, ds: &Square<B>) -> Marks<B> {
    let zero = B::splat(0.0);
    let (l, w) = (&correction.whiten, &correction.weighted);
    let mut found = Marks { score: zero, marks: [zero; MARKS] };
    let mut half = [[zero; OBSERVED]; OBSERVED]; // L^-1 dS
    for i in 0..OBSERVED {
        let mut by_w = zero;
        for k in 0..OBSERVED {
            by_w += ds[i][k] * B::splat(w[k]);
        }
        found.score += (tangent.m[SEEN[i]] + by_w * B::splat(0.5)) * B::splat(w[i]);
        for k in 0..=i {
            found.marks[i] -= tangent.m[SEEN[k]] * B::splat(l[i][k]);
            for j in 0..OBSERVED {
                half[i][j] += ds[k][j] * B::splat(l[i][k]);
            }
        }
    }
    let mut next = OBSERVED;
    for i in 0..OBSERVED {
        for j in 0..=i {
            let mut g = zero;
            for k in 0..=j {
                g += half[i][k] * B::splat(l[j][k]);
            }
            if i == j {
                found.score -= g * B::splat(0.5);
            }
            let weight = if i == j { std::f64::consts::FRAC_1_SQRT_2 } else { 1.0 };
            found.marks[next] = g * B::splat(weight);
            next += 1;
        }
    }
    found
}

/// The derivatives of the mean after a frame.
#[inline(always)]
fn mean<B: Bundle, const FULL: bool>(tangent: &mut Tangent<B>, correction: &Correction, s: B) {
    let w = &correction.weighted;
    let mut moved = tangent.m;
    let mut seen = [B::splat(0.0); OBSERVED];
    for j in 0..OBSERVED {
        if FULL {
            for i in 0..STATE {
                moved[i] += tangent.p[AT[i][SEEN[j]]] * B::splat(w[j]);
            }
        }
        let mut by_w = 0.0;
        for k in 0..OBSERVED {
            by_w += correction.noise[j][k] * w[k];
        }
        seen[j] = s * B::splat(by_w);
    }
    for j in 0..OBSERVED {
        seen[j] += moved[SEEN[j]];
    }
    for i in 0..STATE {
        for j in 0..OBSERVED {
            moved[i] -= seen[j] * B::splat(correction.gain[i][j]);
        }
    }
    tangent.m = moved;
}

/// The derivatives of the covariance after a frame.
///
/// With `X = dP H^T` and `D = H dP H^T + d(s^2) R`:  dP - K X^T - X K^T + K D K^T = dP - Y K^T - K X^T,  Y = X - K D.
#[inline(always)]
fn covariance<B: Bundle>(tangent: &mut Tangent<B>, correction: &Correction, ds: &Square<B>) {
    let old = tangent.p;
    for i in 0..STATE {
        let mut y = [B::splat(0.0); OBSERVED];
        for j in 0..OBSERVED {
            y[j] = old[AT[i][SEEN[j]]];
            for k in 0..OBSERVED {
                y[j] -= ds[k][j] * B::splat(correction.gain[i][k]);
            }
        }
        for j in i..STATE {
            let mut sum = old[AT[i][j]];
            for k in 0..OBSERVED {
                sum -= y[k] * B::splat(correction.gain[j][k]);
                sum -= old[AT[j][SEEN[k]]] * B::splat(correction.gain[i][k]);
            }
            tangent.p[AT[i][j]] = sum;
        }
    }
}

/// Score and marks where the covariances are taken as fixed: `dS = 0`.
#[inline(always)]
fn marks_of_mean<B: Bundle>(tangent: &Tangent<B>, correction: &Correction) -> Marks<B> {
    let zero = B::splat(0.0);
    let (l, w) = (&correction.whiten, &correction.weighted);
    let mut found = Marks { score: zero, marks: [zero; MARKS] };
    for i in 0..OBSERVED {
        found.score += tangent.m[SEEN[i]] * B::splat(w[i]);
        for k in 0..=i {
            found.marks[i] -= tangent.m[SEEN[k]] * B::splat(l[i][k]);
        }
    }
    found
}

/// Takes a frame in; `s` is the derivative of `ln s^2` by each parameter. Without `FULL` the covariances are taken as fixed.
#[inline(always)]
pub(crate) fn correct<B: Bundle, const FULL: bool>(
    tangent: &mut Tangent<B>,
    correction: &Correction,
    s: B,
) -> Marks<B> {
    if !FULL {
        let found = marks_of_mean(tangent, correction);
        mean::<B, FULL>(tangent, correction, s);
        return found;
    }
    let ds = innovation_covariance(tangent, correction, s);
    let found = marks(tangent, correction, &ds);
    mean::<B, FULL>(tangent, correction, s);
    covariance(tangent, correction, &ds);
    found
}
