//! The likelihood of a model through an extended Kalman filter, with its exact gradient.
//!
//! State `u = (x, y, z1, z2, z3)`, mean `m` and covariance `P`:
//!
//! ```text
//! between frames   dm/dt = f(m)          x' = Re z1, y' = -Im z1, z_n' = sum_k c_k M_k
//!                  dP/dt = A P + P A^T + Q,   A = df/du(m),  Q = diag(0, 0, eta_v^2 (2), eta_shape^2 (4))
//! at a frame       nu = y - H m,  S = H P H^T + s^2 R,  K = P H^T S^-1
//!                  m <- m + K nu,  P <- (I - K H) P (I - K H)^T + K s^2 R K^T          (Joseph)
//! log-likelihood   - sum (nu^T S^-1 nu + ln det S + 6 ln 2 pi)/2
//! ```
//!
//! Both are integrated by the classical Runge-Kutta method, so that the gradient is exact for the numbers computed: the derivatives of `m`
//! and `P` by every parameter are carried through the same steps ([`tangent`], [`correct`]), several parameters at a time in vector
//! registers. Where frames are missing the filter goes on; after a longer gap ([`LONGEST_GAP`], [`LONGEST_STRIDE`]) it starts again from the next frame.
//!
//! Source: Jazwinski (1970), Stochastic Processes and Filtering Theory, ch. 8; Bucy and Joseph (1968); Gupta and Mehra (1974), IEEE Trans.
//! Autom. Control 19, 774 (gradient and information matrix).

mod base;
mod blocks;
mod correct;
mod evaluate;
mod problem;
mod sums;
mod tangent;

pub(crate) use evaluate::{Evaluation, Want, evaluate};
pub(crate) use problem::{Frame, Problem, Theta};

use crate::field::SHAPE;
use crate::observation::OBSERVED;

/// Entries of the state.
pub(crate) const STATE: usize = SHAPE + 2;
/// Distinct entries of its covariance.
pub(crate) const PACKED: usize = STATE * (STATE + 1) / 2;
/// Longest step of the integration, in natural units of time. At 0.25 the factor `s` of the measurement errors came out 6 % too large
/// (chaotic motion, process noise 0.02), at 0.125 it agrees with that of 0.05.
pub(crate) const LONGEST_STEP: f64 = 0.125;
/// Longest gap that the filter goes on through, in natural units of time: where it is longer, what is predicted is no longer near enough to a
/// linear law, and fits of real cells ended at equations that blow up in gaps.
pub(crate) const LONGEST_GAP: f64 = 2.0;
/// The same in usual intervals between frames: one missing frame is gone through at any sampling.
pub(crate) const LONGEST_STRIDE: f64 = 2.5;

/// The entry of the state that each observed number is.
pub(crate) const SEEN: [usize; OBSERVED] = [0, 1, 4, 5, 6, 7];

/// A symmetric matrix over the state.
pub(crate) type Covariance = [[f64; STATE]; STATE];

/// Place of an entry of a symmetric matrix in its packed form.
pub(crate) const AT: [[usize; STATE]; STATE] = {
    let mut at = [[0; STATE]; STATE];
    let (mut i, mut next) = (0, 0);
    while i < STATE {
        let mut j = i;
        while j < STATE {
            at[i][j] = next;
            at[j][i] = next;
            next += 1;
            j += 1;
        }
        i += 1;
    }
    at
};
