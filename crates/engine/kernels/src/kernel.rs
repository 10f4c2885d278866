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
    Tensor,
    /// Amplitude equations with this number of modes, whatever their terms are; among them, the tensor model with other terms.
    Amplitudes(usize),
}

/// `true` if amplitude equations have kernels. In the module of a page, whose registers hold two lanes, they would gain little and make
/// half a megabyte of it. A constant that guards the arm of a `match` keeps what the arm calls from being compiled at all.
pub(crate) const TEXT: bool = !cfg!(target_family = "wasm");

/// The largest number of modes for which there is a kernel: each number is compiled separately.
pub const MOST_MODES: usize = 4;

impl Kernel {
    /// The kernel that computes this model; `None` if it does not run in lanes.
    pub fn of(model: &dyn Model) -> Option<Self> {
        if let Some(tensor) = model.as_any()?.downcast_ref::<Tensor>()
            && tensor.listed().is_none()
        {
            return Some(Self::Tensor);
        }
        let modes = listed(model)?.equations().definition().modes.len();
        Some(Self::Amplitudes(modes)).filter(|_| TEXT && modes <= MOST_MODES)
    }

    /// The kernel that computes all of these models, which must be of one kind; `None` if no single one does.
    pub fn of_all<'m>(models: impl IntoIterator<Item = &'m dyn Model>) -> Option<Self> {
        let mut kernels = models.into_iter().map(Self::of);
        let first = kernels.next()??;
        kernels.all(|kernel| kernel == Some(first)).then_some(first)
    }

    /// The kernel that computes most of these models, which must be of one kind; `None` if none of them runs in lanes.
    pub fn of_most<'m>(models: impl IntoIterator<Item = &'m dyn Model>) -> Option<Self> {
        let mut counts: Vec<(Self, usize)> = Vec::new();
        for kernel in models.into_iter().filter_map(Self::of) {
            match counts.iter_mut().find(|(known, _)| *known == kernel) {
                Some((_, count)) => *count += 1,
                None => counts.push((kernel, 1)),
            }
        }
        counts.into_iter().max_by_key(|&(_, count)| count).map(|(kernel, _)| kernel)
    }

    /// Returns `true` if it computes this model.
    pub fn computes(self, model: &dyn Model) -> bool {
        Self::of(model) == Some(self)
    }
}

/// The list of products that a model is computed by, if it is.
fn listed(model: &dyn Model) -> Option<&Amplitudes> {
    let any = model.as_any()?;
    any.downcast_ref::<Amplitudes>().or_else(|| any.downcast_ref::<Tensor>()?.listed())
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
        listed(model)?.field()
    }
}

/// The tensor model with the terms of the paper's planes.
pub(crate) type Common = FourierField<f64, { terms::COMMON }>;
/// Amplitude equations with `N` unknowns.
pub(crate) type Text<const N: usize> = AmplitudesField<f64, N>;
