//! Everything that has a name: models, parameters, presets, steppers, regimes. The Python side and its stubs are made of it.

use crate::errors::of_json;
use motiform_analysis::regime::{Attractor, Regime};
use motiform_dynamics::steppers::Method;
use motiform_models::{MODELS, ModelInfo};
use motiform_study::figures::regime_mark;
use motiform_study::presets::{PRESETS, find};
use motiform_study::scan::NUMBERS;
use motiform_study::{Study, dataset};
use pyo3::prelude::*;
use serde_json::{Value, json};

/// The registry as JSON.
#[pyfunction]
pub(crate) fn registry() -> PyResult<String> {
    let named = |entries: &[(&str, &str)]| -> Vec<Value> {
        entries.iter().map(|(name, meaning)| json!({ "name": name, "meaning": meaning })).collect()
    };
    let registry = json!({
        "version": dataset::VERSION,
        "models": MODELS.iter().map(model).collect::<Vec<_>>(),
        "presets": PRESETS.iter().filter_map(|preset| {
            let study = find(ModelInfo::find(preset.model).ok()?, preset.name).ok()?;
            let Study { title, about, free, .. } = study;
            Some(json!({ "name": preset.name, "model": preset.model, "title": title, "about": about, "free": free }))
        }).collect::<Vec<_>>(),
        "steppers": Method::names(),
        "regimes": Regime::ALL.map(regime),
        "attractors": Attractor::ALL.map(Attractor::name),
        "numbers": named(&NUMBERS),
    });
    serde_json::to_string(&registry).map_err(of_json)
}

fn model(info: &ModelInfo) -> Value {
    let defaults: Vec<f64> = info.parameters().iter().map(|spec| spec.default).collect();
    json!({
        "name": info.name,
        "title": info.title,
        "equations": info.equations,
        "source": info.source,
        "run": Study::of_model(ModelInfo::find(info.name).unwrap_or(&MODELS[0])).run,
        "look": info.look,
        "budget": info.budget,
        "parameters": info.parameters().iter().map(|spec| json!({
            "name": spec.name,
            "symbol": spec.symbol,
            "default": spec.default,
            "range": spec.range,
            "allowed": spec.allowed,
            "equation": spec.equation,
            "meaning": spec.meaning,
        })).collect::<Vec<_>>(),
        "coordinates": info.coordinates(&defaults).iter()
            .map(|c| json!({ "name": c.name, "meaning": c.meaning })).collect::<Vec<_>>(),
    })
}

fn regime(regime: Regime) -> Value {
    let mark = regime_mark(regime.name());
    json!({ "name": regime.name(), "colour": mark.colour.to_string(), "area": mark.area.to_string(), "glyph": format!("{:?}", mark.glyph) })
}
