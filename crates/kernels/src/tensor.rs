//! The tensor model, classified in lanes.

use motiform_analysis::Result;
use motiform_analysis::regime::{Candidate, Settings, Verdict, classify_in_lanes};
use motiform_dynamics::{Model, Watch};
use motiform_models::tensor::Tensor;
use motiform_models::tensor::fourier::{DIM, FourierField, terms};

/// One body to classify.
pub struct TensorRow {
    /// The key that is returned with its verdict.
    pub key: usize,
    /// The body.
    pub body: Box<dyn Model>,
    /// The same, for its coefficients.
    pub tensor: Tensor,
    /// Its shape at the start.
    pub start: [f64; DIM],
}

/// The smallest set of terms (see [`terms`]) for which there is a kernel with all of `needed`.
#[must_use]
pub fn covering(needed: u32) -> u32 {
    if needed & !terms::COMMON == 0 { terms::COMMON } else { terms::ALL }
}

/// Classifies the motion of all rows that `next` gives, whose terms must be within `covering` (a set that [`covering()`]
/// gave); each verdict goes to `done` with the row's key. Verdicts are those of [`motiform_analysis::classify`] to the
/// last bit. When `watch` stops it, the rest is left.
pub fn classify_tensors(
    covering: u32,
    settings: &Settings,
    next: &mut dyn FnMut() -> Option<TensorRow>,
    done: &mut dyn FnMut(usize, Result<Option<Verdict>>),
    watch: &dyn Watch,
) {
    if covering == terms::COMMON {
        classify::<{ terms::COMMON }>(settings, next, done, watch);
    } else {
        classify::<{ terms::ALL }>(settings, next, done, watch);
    }
}

fn classify<const TERMS: u32>(
    settings: &Settings,
    next: &mut dyn FnMut() -> Option<TensorRow>,
    done: &mut dyn FnMut(usize, Result<Option<Verdict>>),
    watch: &dyn Watch,
) {
    let mut candidate = || {
        let TensorRow { key, body, tensor, start } = next()?;
        Some(Candidate { key, body, field: FourierField::<f64, TERMS>(tensor.field().0), start })
    };
    classify_in_lanes::<_, DIM, { 2 * DIM }>(settings, &mut candidate, done, watch);
}
