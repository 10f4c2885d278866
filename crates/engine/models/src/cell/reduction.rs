//! Galerkin reduction: the active cell model with three modes *is* the tensor model, its coefficients given by L.
//!
//! With `phi_n = i^(n-1) w_n` all coefficients of the mode equations are real. For `Q(p, q) = g5 k^5 p^2 q^2 - g4 k^3 p q`,
//!
//! `w_n' = sigma_n w_n + (n/2) sum_{p+q=n; p,q>0} Q(p,q) w_p w_q - n sum_{m>0} Q(n+m,-m) w_{n+m} w_m*`.
//!
//! Three modes give (Z1), (Z2), (Z3) with gamma, kappa2, kappa3, e11, e13, e21, e22, e32. The paper asserts the form
//! ('essentially the same structures'); the coefficients are ours. Stable modes can be slaved: on the invariant manifold
//! `w3 = c3 w1 w2`, `w4 = c4 w2^2 + c13 w1 w3`, to quadratic order, which gives the cubic terms d_ij as well.

use super::{CellField, CellParameters};
use crate::tensor::Coefficients;

/// The modes of a cell that follow the others at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slaved {
    /// None: modes 1, 2, 3, truncated.
    Nothing,
    /// Mode 4 follows modes 1, 2, 3.
    Fourth,
    /// Modes 3 and 4 follow modes 1 and 2: near length = 4 pi. (Mode 3 then decays by itself, uncoupled.)
    ThirdAndFourth,
}

/// The tensor model's Fourier coefficients for this cell, for `w_n = i^(1-n) phi_n`.
///
/// The amplitudes are modes of the normal angle: `w_1` is not the velocity.
pub fn reduce(p: &CellParameters, slaved: Slaved) -> Coefficients<f64> {
    let mut c = truncated(p);
    let (sigma4, kernel) = (CellField::new(p, 4).rates()[3], Kernel::new(p));
    // w4' = sigma4 w4 + 2 Q(2,2) w2^2 + 4 Q(1,3) w1 w3; w_n' gains -n Q(4, n-4) w4 w_{4-n}*
    let pair = 2.0 * kernel.at(2.0, 2.0) / (-2.0 * c.kappa2 - sigma4); // w4 = pair w2^2 + mixed w1 w3
    let mixed = 4.0 * kernel.at(1.0, 3.0) / (c.gamma - c.kappa3 - sigma4);
    let back = [-kernel.at(4.0, -3.0), -2.0 * kernel.at(4.0, -2.0), -3.0 * kernel.at(4.0, -1.0)];
    match slaved {
        Slaved::Nothing => {}
        Slaved::Fourth => {
            (c.e14, c.d13) = (back[0] * pair, back[0] * mixed);
            (c.d22, c.e23) = (back[1] * pair, back[1] * mixed);
            (c.e33, c.d31) = (back[2] * pair, back[2] * mixed);
        }
        Slaved::ThirdAndFourth => {
            // w3 = c3 w1 w2 with (sigma1 + sigma2) c3 = sigma3 c3 + e32
            let c3 = c.e32 / (c.gamma - c.kappa2 + c.kappa3);
            (c.d12, c.d21, c.d22) = (c.e13 * c3, c.e22 * c3, back[1] * pair);
            (c.e13, c.e22, c.e32) = (0.0, 0.0, 0.0);
        }
    }
    c
}

/// Modes 1, 2 and 3 alone.
fn truncated(p: &CellParameters) -> Coefficients<f64> {
    let field = CellField::new(p, 3);
    let (sigma, kernel) = (field.rates(), Kernel::new(p));
    let mut c = Coefficients::from(&crate::tensor::TensorParameters::default()).map(|_| 0.0);
    (c.gamma, c.kappa2, c.kappa3) = (sigma[0], -sigma[1], -sigma[2]);
    (c.e11, c.e13) = (-kernel.at(2.0, -1.0), -kernel.at(3.0, -2.0));
    (c.e21, c.e22) = (kernel.at(1.0, 1.0), -2.0 * kernel.at(3.0, -1.0));
    c.e32 = 3.0 * kernel.at(1.0, 2.0);
    c
}

/// `Q(p, q) = g5 k^5 p^2 q^2 - g4 k^3 p q`.
struct Kernel {
    bending: f64,
    stretching: f64,
}

impl Kernel {
    fn new(p: &CellParameters) -> Self {
        let k = p.wavenumber();
        Self { bending: p.g5 * k * k * k * k * k, stretching: p.g4 * k * k * k }
    }

    fn at(&self, p: f64, q: f64) -> f64 {
        self.bending * (p * q) * (p * q) - self.stretching * p * q
    }
}

/// `w_n = i^(1-n) phi_n` for the first three modes of a shape: the tensor model's state.
pub fn amplitudes(shape: &[f64]) -> [f64; 6] {
    [shape[0], shape[1], shape[3], -shape[2], -shape[4], -shape[5]]
}

/// The first three modes of phi for a state of the tensor model: the inverse of [`amplitudes`].
pub fn modes(w: &[f64; 6]) -> [f64; 6] {
    [w[0], w[1], -w[3], w[2], -w[4], -w[5]]
}
