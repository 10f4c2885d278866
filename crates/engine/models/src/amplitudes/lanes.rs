//! Amplitude equations in lanes.

use super::{Amplitudes, Known};
use motiform_dynamics::ensemble::{InLanes, LaneTangent};
use motiform_dynamics::scalar::MOST_LANES;
use motiform_dynamics::{Bundle, Scalar, Shape, System, VectorField};

/// The equations of `N / 2` amplitudes with their coefficients: numbers, or one set per lane.
///
/// The equations are data: one kernel for every list of products with this number of amplitudes.
#[derive(Clone, Debug)]
pub struct AmplitudesField<P, const N: usize> {
    known: &'static Known,
    rates: Box<[[P; 2]]>,
    velocity: Box<[[P; 2]]>,
}

impl Amplitudes {
    /// The field for kernels over other scalars; `None` unless there are `N` unknowns.
    pub fn field<const N: usize>(&self) -> Option<AmplitudesField<f64, N>> {
        let (rates, velocity) = (self.rates.clone(), self.velocity.clone());
        (self.dim() == N).then_some(AmplitudesField { known: self.known, rates, velocity })
    }
}

impl<P, const N: usize> System for AmplitudesField<P, N> {
    fn dim(&self) -> usize {
        N
    }

    #[inline(always)]
    fn kept(&self) -> u64 {
        self.known.equations.kept
    }
}

impl<T: Scalar<Real = P>, P: Scalar<Real = P>, const N: usize> VectorField<T> for AmplitudesField<P, N> {
    #[inline(always)]
    fn eval(&self, _t: P, u: &[T], du: &mut [T]) {
        self.known.equations.program.eval(&self.rates, u, du);
    }
}

impl<T: Scalar<Real = P>, P: Scalar<Real = P>, const N: usize> Shape<T> for AmplitudesField<P, N> {
    #[inline(always)]
    fn velocity(&self, shape: &[T]) -> [T; 2] {
        self.known.velocity(&self.velocity, shape)
    }
}

/// The same coefficients in every lane.
fn splat<B: Bundle>(values: &[[f64; 2]]) -> Box<[[B; 2]]> {
    let mut lanes = Vec::with_capacity(values.len());
    for &[re, im] in values {
        lanes.push([B::splat(re), B::splat(im)]);
    }
    lanes.into()
}

/// Puts coefficients into one lane, as plain copies: this is called by code without vector instructions.
fn put<B: Bundle>(values: &[[f64; 2]], lane: usize, lanes: &mut [[B; 2]]) {
    let mut all = [0.0; MOST_LANES];
    for (to, from) in lanes.as_flattened_mut().iter_mut().zip(values.as_flattened()) {
        to.store(&mut all);
        all[lane] = *from;
        *to = B::load(&all);
    }
}

/// All fields of a bundle must have the same equations; their parameters may differ.
impl<const N: usize> InLanes for AmplitudesField<f64, N> {
    /// Most models have two or three modes.
    const WIDE: bool = N == 4 || N == 6;

    type Field<B: Bundle> = AmplitudesField<B, N>;
    type Tangent<B: Bundle, const K: usize> = LaneTangent<AmplitudesField<B, N>, N, K>;

    #[inline(always)]
    fn tangent<B: Bundle, const K: usize>(field: AmplitudesField<B, N>) -> Self::Tangent<B, K> {
        LaneTangent(field)
    }

    #[inline(always)]
    fn spin<B: Bundle>(field: &AmplitudesField<B, N>, shape: &[B], out: &mut [B]) {
        field.known.spin(shape, out);
    }

    fn bundle<B: Bundle>(&self) -> AmplitudesField<B, N> {
        AmplitudesField { known: self.known, rates: splat(&self.rates), velocity: splat(&self.velocity) }
    }

    fn put<B: Bundle>(&self, lane: usize, field: &mut AmplitudesField<B, N>) {
        debug_assert!(std::ptr::eq(self.known, field.known), "lanes have one list of products");
        put(&self.rates, lane, &mut field.rates);
        put(&self.velocity, lane, &mut field.velocity);
    }
}
