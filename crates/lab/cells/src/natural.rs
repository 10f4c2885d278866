//! A fitted model in natural units, in which every number is of order 1: its equations and its noise.

use motiform_dynamics::{Model, Noise};
use motiform_inference::{Fit, equations};
use motiform_models::amplitudes::info;

/// Longest step of the noise, in natural times.
pub(crate) const STEP: f64 = 0.125;

/// The equations with these coefficients in natural units. The names of the model are kept once per set of terms: its values are given
/// apart.
pub(crate) fn model(fit: &Fit, coefficients: &[f64]) -> Option<Box<dyn Model>> {
    let values = equations(&fit.library, fit.handed, coefficients);
    let names = info(&equations(&fit.library, fit.handed, &[])).ok()?;
    let values: Vec<f64> = values.parameters.iter().map(|parameter| parameter.default).collect();
    names.build(&values).ok()
}

/// Its fitted noise.
pub(crate) fn noise(fit: &Fit, model: &dyn Model, step: f64) -> Noise {
    let [_, eta_v, eta_shape, _] = fit.natural.logs.map(libm::exp);
    let mut noise = Noise::on(model, eta_v, eta_shape, step);
    for (own, variance) in noise.amplitudes.chunks_exact_mut(2).zip(fit.scales.noise_of_modes()) {
        own.iter_mut().for_each(|amplitude| *amplitude *= variance.sqrt());
    }
    noise
}
