//! The models that run in lanes, and the kernel that each needs.

use motiform_dynamics::Model;
use motiform_dynamics::ensemble::InLanes;
use motiform_models::amplitudes::{Amplitudes, AmplitudesField};
use motiform_models::tensor::Tensor;
use motiform_models::tensor::fourier::{FourierField, terms};

/// A kernel: what is compiled for lanes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kernel {
    /// The tensor model with the terms of the paper's planes.
    CommonTensor,
    /// The tensor model with all terms.
    Tensor,
    /// Amplitude equations with this number of modes, whatever their terms are.
    Amplitudes(usize),
}

/// The largest number of modes for which there is a kernel: each number is compiled separately.
pub const MOST_MODES: usize = 4;

impl Kernel {
    /// The smallest kernel that computes this model; `None` if it does not run in lanes.
    #[must_use]
    pub fn of(model: &dyn Model) -> Option<Self> {
        let any = model.as_any()?;
        if let Some(tensor) = any.downcast_ref::<Tensor>() {
            let common = tensor.terms() & !terms::COMMON == 0;
            return Some(if common { Self::CommonTensor } else { Self::Tensor });
        }
        let modes = any.downcast_ref::<Amplitudes>()?.equations().definition().modes.len();
        (modes <= MOST_MODES).then_some(Self::Amplitudes(modes))
    }

    /// The same for its classification: lanes watch the size of the shape, which says nothing of a body whose flow has no rotations.
    #[must_use]
    pub fn of_classification(model: &dyn Model) -> Option<Self> {
        Self::of(model).filter(|_| model.symmetry().rotations)
    }

    /// The smallest kernel that computes what either computes, for models of one kind.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        if self == Self::CommonTensor { other } else { self }
    }

    /// The smallest kernel that computes all of these models, which must be of one kind; `None` if some do not run in lanes.
    pub fn of_all<'m>(models: impl IntoIterator<Item = &'m dyn Model>) -> Option<Self> {
        let mut kernels = models.into_iter().map(Self::of);
        let first = kernels.next()??;
        kernels.try_fold(first, |kernel, next| Some(kernel.and(next?)))
    }

    /// Whether it computes this model.
    #[must_use]
    pub fn computes(self, model: &dyn Model) -> bool {
        Self::of(model).is_some_and(|needed| needed.and(self) == self)
    }
}

/// A field for lanes that is taken from a model.
pub(crate) trait FromModel: InLanes + Clone {
    /// The field; `None` for another kind of model.
    fn from_model(model: &dyn Model) -> Option<Self>;
}

impl<const TERMS: u32> FromModel for FourierField<f64, TERMS> {
    fn from_model(model: &dyn Model) -> Option<Self> {
        Some(Self(model.as_any()?.downcast_ref::<Tensor>()?.field().0))
    }
}

impl<const N: usize> FromModel for AmplitudesField<f64, N> {
    fn from_model(model: &dyn Model) -> Option<Self> {
        model.as_any()?.downcast_ref::<Amplitudes>()?.field()
    }
}

/// The tensor model with the terms of the paper's planes.
pub(crate) type Common = FourierField<f64, { terms::COMMON }>;
/// The tensor model with all terms.
pub(crate) type General = FourierField<f64, { terms::ALL }>;
/// Amplitude equations with `N` unknowns.
pub(crate) type Text<const N: usize> = AmplitudesField<f64, N>;
