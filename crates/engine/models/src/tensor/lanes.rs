//! The tensor model in lanes.

use super::FourierField;
use super::fourier::DIM;
use motiform_dynamics::Bundle;
use motiform_dynamics::ensemble::{InLanes, LaneTangent};

impl<const TERMS: u32> InLanes for FourierField<f64, TERMS> {
    type Field<B: Bundle> = FourierField<B, TERMS>;
    type Tangent<B: Bundle, const K: usize> = LaneTangent<FourierField<B, TERMS>, DIM, K>;

    #[inline(always)]
    fn tangent<B: Bundle, const K: usize>(field: FourierField<B, TERMS>) -> Self::Tangent<B, K> {
        LaneTangent(field)
    }

    #[inline(always)]
    fn spin<B: Bundle>(_field: &FourierField<B, TERMS>, shape: &[B], out: &mut [B]) {
        super::spin(shape, out);
    }

    #[inline(always)]
    fn bundle<B: Bundle>(&self) -> FourierField<B, TERMS> {
        FourierField(self.0.map(B::splat))
    }

    #[inline(always)]
    fn put<B: Bundle>(&self, lane: usize, field: &mut FourierField<B, TERMS>) {
        field.0.set_lane(lane, &self.0);
    }
}
