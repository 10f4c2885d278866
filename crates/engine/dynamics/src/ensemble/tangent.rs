//! The tangent flow in lanes.

use crate::{Bundle, Dual, System, VectorField};

/// `u' = f(u)`, `w_k' = Df(u) w_k` for `K` tangent vectors, in lanes: [`crate::Tangent`], all vectors at once.
///
/// The state is `(u, w_1, .., w_K)`, each of length `N`. The same bits as [`crate::Tangent`].
#[derive(Clone, Copy, Debug)]
pub struct LaneTangent<F, const N: usize, const K: usize>(pub F);

impl<F, const N: usize, const K: usize> AsMut<F> for LaneTangent<F, N, K> {
    fn as_mut(&mut self) -> &mut F {
        &mut self.0
    }
}

impl<F: System, const N: usize, const K: usize> System for LaneTangent<F, N, K> {
    fn dim(&self) -> usize {
        N * (1 + K)
    }

    #[inline(always)]
    fn vectors(&self) -> Option<usize> {
        Some(N)
    }

    #[inline(always)]
    fn kept(&self) -> u64 {
        self.0.kept()
    }
}

impl<B: Bundle, F: VectorField<Dual<B, K>>, const N: usize, const K: usize> VectorField<B>
    for LaneTangent<F, N, K>
{
    #[inline(always)]
    fn eval(&self, t: B, u: &[B], du: &mut [B]) {
        let mut lifted = [Dual::constant_of(t); N];
        for i in 0..N {
            lifted[i].value = u[i];
            for k in 0..K {
                lifted[i].derivative[k] = u[N * (1 + k) + i];
            }
        }
        let mut rates = lifted;
        self.0.eval(t, &lifted, &mut rates);
        for i in 0..N {
            du[i] = rates[i].value;
            for k in 0..K {
                du[N * (1 + k) + i] = rates[i].derivative[k];
            }
        }
    }
}
