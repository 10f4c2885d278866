//! Lyapunov exponents of the tensor model, in lanes.

use motiform_analysis::Result;
use motiform_analysis::lyapunov::{
    Lyapunov, LyapunovSettings, TangentMember, lyapunov_in_lanes, runs_in_lanes,
};
use motiform_dynamics::{Equivariant, StepControl, Watch};
use motiform_models::tensor::Tensor;
use motiform_models::tensor::fourier::{DIM, FourierField, terms};

/// A tensor model as a body for exponents.
struct Body(Tensor);

impl AsRef<dyn Equivariant> for Body {
    fn as_ref(&self) -> &(dyn Equivariant + 'static) {
        &self.0
    }
}

/// Whether [`exponents_of_tensor`] is applicable: all exponents, of a model within the common terms, by a method that has lanes.
#[must_use]
pub fn has_exponents(tensor: &Tensor, settings: &LyapunovSettings) -> bool {
    settings.count == DIM && tensor.terms() & !terms::COMMON == 0 && runs_in_lanes(settings)
}

/// All exponents of the orbits of one tensor model with the initial states from `next`; each result is passed to `done` with the start's
/// key. The same bits as [`motiform_analysis::lyapunov()`] gives one by one. When `watch` stops it, the rest is left.
/// Does nothing if [`has_exponents`] is false.
pub fn exponents_of_tensor(
    tensor: &Tensor,
    settings: &LyapunovSettings,
    next: &mut dyn FnMut() -> Option<(usize, [f64; DIM])>,
    done: &mut dyn FnMut(usize, Result<Lyapunov>),
    watch: &dyn Watch,
) {
    let StepControl::Adaptive { rtol, atol } = settings.control else { return };
    if !has_exponents(tensor, settings) {
        return;
    }
    let mut member = || {
        let (key, start) = next()?;
        let field = FourierField::<f64, { terms::COMMON }>(tensor.field().0);
        Some(TangentMember { key, body: Body(*tensor), field, start, settings: *settings })
    };
    lyapunov_in_lanes::<_, _, DIM, DIM, { DIM * (1 + DIM) }>((rtol, atol), &mut member, done, watch);
}
