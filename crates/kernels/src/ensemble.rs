//! Orbits of tensor models from their starts to given times, in lanes.

use motiform_dynamics::Watch;
use motiform_dynamics::ensemble::{Member, Propagation, Queue, propagate};
use motiform_models::tensor::Tensor;
use motiform_models::tensor::fourier::{DIM, FourierField, terms};

/// Shape and position.
pub const STATE: usize = DIM + 2;

/// A tensor model, and the initial state of its orbit.
#[derive(Clone, Copy)]
pub struct TensorStart {
    /// The key that is returned with its states.
    pub key: usize,
    /// The model, which must be such that [`has_ensemble`].
    pub tensor: Tensor,
    /// Shape and position at time 0.
    pub start: [f64; STATE],
}

/// Whether a model's orbits run in lanes: it has only the common terms.
#[must_use]
pub fn has_ensemble(tensor: &Tensor) -> bool {
    tensor.terms() & !terms::COMMON == 0
}

/// Runs the orbits that `next` gives, on this thread; `done` gets the states of each at all times, or `None` where a single orbit has to
/// say what happened. `false`, without any work, on a machine without lanes. See [`propagate`].
pub fn propagate_tensors(
    how: &Propagation<'_>,
    next: &mut dyn FnMut() -> Option<TensorStart>,
    done: &mut dyn FnMut(usize, Option<Vec<[f64; STATE]>>),
    watch: &dyn Watch,
) -> bool {
    let mut member = || {
        let TensorStart { key, tensor, start } = next()?;
        Some(Member { key, field: FourierField::<f64, { terms::COMMON }>(tensor.field().0), start })
    };
    propagate(how, Queue { next: &mut member, done, watch })
}
