//! The modes of the outline and the tensors.

use super::super::claims::claim;
use super::super::context::Context;
use super::fields::{state, tensors};
use motiform_figures::report::Claim;
use motiform_study::initial::Uniform;
use std::f64::consts::TAU;

pub(super) fn claims(context: &Context<'_>) -> Vec<Claim> {
    vec![ellipse(context), contracted(context)]
}

/// `R0 + 2 a cos(2 theta)` against an ellipse with half axes `R0 +- 2 a`: apart by O(a^2).
fn ellipse(context: &Context<'_>) -> Claim {
    let apart = |a: f64| {
        let (long, short) = (1.0 + 2.0 * a, 1.0 - 2.0 * a);
        let off = |i: u32| {
            let theta = TAU * f64::from(i) / 360.0;
            let (sin, cos) = libm::sincos(theta);
            let ellipse = ((cos / long).powi(2) + (sin / short).powi(2)).sqrt().recip();
            (1.0 + 2.0 * a * libm::cos(2.0 * theta) - ellipse).abs()
        };
        (0..360).map(off).fold(0.0, f64::max)
    };
    let order = context.number((apart(0.01) / apart(0.005)).log2());
    claim(
        &[33],
        "The modes *z*_{±2} represent an elliptical shape of the domain.",
        format!(
            "*R*_0 = 1 with 2|*z*_2| = 0.02 is off an ellipse by {:.1e}, and the difference falls with the power {order:.3} of the size",
            apart(0.01)
        ),
        "largest difference of the radii over 360 directions; an ellipse up to second order, as the paper's weak deformation",
        (order - 2.0).abs() < 0.1,
    )
}

/// `S_ij n_i n_j + U_ijk n_i n_j n_k` against the sum over modes.
fn contracted(context: &Context<'_>) -> Claim {
    let mut random = Uniform::new(8, 0);
    let (mut worst, mut defect): (f64, f64) = (0.0, 0.0);
    for _ in 0..1000 {
        let (z, theta) = (state(&mut random), std::f64::consts::PI * random.draw());
        let t = tensors(z);
        let (sin, cos) = libm::sincos(theta);
        let n = [cos, sin];
        let mut with_tensors = 0.0;
        for i in [0, 1] {
            for j in [0, 1] {
                with_tensors += t.s[i][j] * n[i] * n[j];
                with_tensors += t.u[i][j].iter().zip(n).map(|(u, k)| u * n[i] * n[j] * k).sum::<f64>();
            }
        }
        let wave = |m: usize| {
            let (sin, cos) = libm::sincos((m as f64 + 1.0) * theta);
            2.0 * (z[m].re * cos - z[m].im * sin)
        };
        worst = worst.max((with_tensors - wave(1) - wave(2)).abs());
        defect = defect.max(t.defect());
    }
    let (worst, defect) = (context.number(worst), context.number(defect));
    claim(
        &[34, 35],
        "*S*_{11} = *z*_2 + *z*_{-2}, *S*_{12} = *i*(*z*_2 − *z*_{-2}); *U*_{111} = *z*_3 + *z*_{-3}, *U*_{222} = −*i*(*z*_3 − *z*_{-3}).",
        format!(
            "with these tensors *δR* = *S*_{{ij}}*n*_i*n*_j + *U*_{{ijk}}*n*_i*n*_j*n*_k is the sum over \
            the modes, to {worst:.0e}; they are symmetric and traceless to {defect:.0e}"
        ),
        "1000 random states and directions; below 10^{-13}",
        worst < 1e-13 && defect < 1e-13,
    )
}
