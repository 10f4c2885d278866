//! The tensor model in lanes.

use super::FourierField;
use motiform_dynamics::Bundle;
use motiform_dynamics::ensemble::InLanes;

impl<const TERMS: u32> InLanes for FourierField<f64, TERMS> {
    type Field<B: Bundle> = FourierField<B, TERMS>;

    #[inline(always)]
    fn bundle<B: Bundle>(&self) -> FourierField<B, TERMS> {
        FourierField(self.0.map(B::splat))
    }

    #[inline(always)]
    fn put<B: Bundle>(&self, lane: usize, field: &mut FourierField<B, TERMS>) {
        field.0.set_lane(lane, &self.0);
    }
}
