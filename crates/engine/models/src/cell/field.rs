//! The shape equation (C) in Fourier modes: the form used for computation.
//!
//! `phi(s) = sum_n phi_n exp(i k_n s)` with `phi_{-n} = conj(phi_n)`: only `n >= 1` is kept, so phi is real by
//! construction and no anti-Hermitian part can grow. The mean `phi_0` is constant in time, because every term of (C)
//! is a derivative: it is not an unknown (see [`super::Cell::with_mean`]). With `k = k_1`, exactly dealiased:
//!
//! `phi_n' = sigma_n phi_n + (i n/2) sum_{p+q=n} (g5 k^5 p^2 q^2 - g4 k^3 p q) phi_p phi_q`,
//! `sigma_n = -g1 k_n^2 + g2 k_n^4 - g3 k_n^6`.
//!
//! Source: paper, the equation for phi_t with g1 .. g5.

use super::CellParameters;
use super::convolution::in_rows;
use motiform_dynamics::simd::{self, Kernel};
use motiform_dynamics::{Lanes, Scalar, Semilinear, System, VectorField};

/// Maximum number of modes (a convolution keeps its operands on the stack).
pub const MAX_MODES: usize = 128;

/// The shape field: state `(Re phi_1, Im phi_1, Re phi_2, Im phi_2, ...)`.
#[derive(Clone, Debug, PartialEq)]
pub struct CellField<P> {
    /// `sigma_n`, `n = 1 ..`.
    rates: Vec<P>,
    /// `g5 k^5 / 2`.
    bending: P,
    /// `-g4 k^3 / 2`, if the term is there.
    stretching: Option<P>,
}

impl CellField<f64> {
    /// The field with `modes` modes.
    pub fn new(p: &CellParameters, modes: usize) -> Self {
        let k = p.wavenumber();
        let rate = |n: usize| {
            let square = (n as f64 * k) * (n as f64 * k);
            -p.g1 * square + p.g2 * square * square - p.g3 * square * square * square
        };
        let cube = k * k * k;
        Self {
            rates: (1..=modes).map(rate).collect(),
            bending: 0.5 * p.g5 * cube * k * k,
            stretching: (p.g4 != 0.0).then_some(-0.5 * p.g4 * cube),
        }
    }
}

impl<const N: usize> CellField<Lanes<N>> {
    /// One field per lane; all must have the same number of modes.
    pub fn bundle(each: &[CellField<f64>; N]) -> Self {
        let gather =
            |get: &dyn Fn(&CellField<f64>) -> f64| Lanes::from(std::array::from_fn(|lane| get(&each[lane])));
        let stretched = each.iter().any(|field| field.stretching.is_some());
        Self {
            rates: (0..each[0].rates.len()).map(|n| gather(&|field| field.rates[n])).collect(),
            bending: gather(&|field| field.bending),
            stretching: stretched.then(|| gather(&|field| field.stretching.unwrap_or(0.0))),
        }
    }
}

impl<P> CellField<P> {
    /// Number of modes.
    pub fn modes(&self) -> usize {
        self.rates.len()
    }

    /// Growth rates `sigma_n` of the modes, `n = 1 ..` (inverse model time).
    pub fn rates(&self) -> &[P] {
        &self.rates
    }
}

impl<P> System for CellField<P> {
    fn dim(&self) -> usize {
        2 * self.rates.len()
    }
}

impl<T: Scalar<Real = P>, P: Scalar<Real = P>> VectorField<T> for CellField<P> {
    #[inline(always)]
    fn eval(&self, t: P, u: &[T], du: &mut [T]) {
        self.nonlinear(t, u, du);
        for ((rates, modes), &sigma) in du.chunks_exact_mut(2).zip(u.chunks_exact(2)).zip(&self.rates) {
            rates[0] += modes[0].scale(sigma); // (C), g1, g2, g3
            rates[1] += modes[1].scale(sigma);
        }
    }
}

impl<T: Scalar<Real = P>, P: Scalar<Real = P>> Semilinear<T> for CellField<P> {
    fn linear(&self, lambda: &mut [P]) {
        for (pair, &sigma) in lambda.chunks_exact_mut(2).zip(&self.rates) {
            pair.fill(sigma);
        }
    }

    #[inline(always)]
    fn nonlinear(&self, _t: P, u: &[T], du: &mut [T]) {
        let quadratic = Quadratic { field: self, u, du };
        if T::IN_KERNEL { quadratic.run() } else { simd::run(quadratic) }
    }
}

/// The quadratic terms of (C).
struct Quadratic<'a, T, P> {
    field: &'a CellField<P>,
    u: &'a [T],
    du: &'a mut [T],
}

impl<T: Scalar<Real = P>, P: Scalar<Real = P>> Kernel for Quadratic<'_, T, P> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        in_rows((self.field.bending, self.field.stretching), self.u, self.du);
    }
}
