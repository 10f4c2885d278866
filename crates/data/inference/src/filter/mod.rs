//! The likelihood of a model through an extended Kalman filter, with its exact gradient.
//!
//! State `u = (x, y, z1, z2, z3)`, with two modes without z3, with four also z4, mean `m` and covariance `P`:
//!
//! ```text
//! between frames   dm/dt = f(m)          x' = Re z1, y' = -Im z1, z_n' = sum_k c_k M_k
//!                  dP/dt = A P + P A^T + Q,   A = df/du(m),  Q = diag(0, 0, eta_v^2 (2), eta_shape^2 (4, or 6))
//! at a frame       N = s^2 R + c diag(1, 1, 0, ..)        errors of the contour, and a variance c of the centre alone
//!                  nu = y - H m,  S = H P H^T + N,  K = P H^T S^-1
//!                  m <- m + K nu,  P <- (I - K H) P (I - K H)^T + K N K^T          (Joseph)
//! log-likelihood   - sum (nu^T S^-1 nu + ln det S + N ln 2 pi)/2,  N = 6 (8)
//! ```
//!
//! Both are integrated by the classical Runge-Kutta method, so that the gradient is exact for the numbers computed: the derivatives of `m`
//! and `P` by every parameter are carried through the same steps ([`tangent`], [`correct`]), several parameters at a time in vector
//! registers. Where frames are missing the filter goes on; after a longer gap ([`LONGEST_GAP`],
//! [`LONGEST_STRIDE`]) it starts again from the next frame.
//!
//! Sizes are known when it is compiled: the amplitudes are `SHAPE` real numbers, 4, 6 or 8; as many are
//! observed (the position instead of z1); the state has `STATE = SHAPE + 2`.
//!
//! Source: Jazwinski (1970), Stochastic Processes and Filtering Theory, ch. 8; Bucy and Joseph (1968); Gupta and Mehra (1974), IEEE Trans.
//! Autom. Control 19, 774 (gradient and information matrix).

mod base;
mod blocks;
mod correct;
mod correction;
mod evaluate;
mod problem;
mod sums;
mod tangent;

pub(crate) use evaluate::{Evaluation, Want, evaluate};
pub(crate) use problem::{
    ETA_SHAPE, ETA_V, Frame, NO_CENTRE_NOISE, NOISES, Problem, ProcessNoise, Theta, UNSEEN,
};

/// Longest step of the integration, in natural units of time. At 0.25 the factor `s` of the measurement errors came out 6 % too large
/// (chaotic motion, process noise 0.02), at 0.125 it agrees with that of 0.05.
pub(crate) const LONGEST_STEP: f64 = 0.125;
/// Longest gap that the filter goes on through, in natural units of time: where it is longer, what is
/// predicted is no longer near enough to a linear law, and fits of real cells ended at equations that blow up
/// in gaps.
pub(crate) const LONGEST_GAP: f64 = 2.0;
/// The same in usual intervals between frames: one missing frame is gone through at any sampling.
pub(crate) const LONGEST_STRIDE: f64 = 2.5;

/// The entry of the state that an observed number is: all but the velocity are seen.
#[inline(always)]
pub(crate) const fn seen(observed: usize) -> usize {
    if observed < 2 { observed } else { observed + 2 }
}
